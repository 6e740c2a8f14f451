#pragma once
#include "core/system/guard.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tyndall {

/// A program to be run, in a session of its own, without input and with no file open but those named here.
struct ChildPlan {
  std::vector<std::string> command;      ///< the program, by its path or as PATH finds it, and its arguments
  std::filesystem::path folder;          ///< where it runs
  std::vector<std::string> environment;  ///< "NAME=VALUE", in addition to this program's own
  int channel = -1;                      ///< a descriptor of this process's that it gets, too; -1: none
  double seconds = 60;                   ///< after which it is ended
  std::size_t max_errors = 65536;        ///< bytes of its standard error that are kept
  bool keep_last_errors = false;         ///< the last bytes, else the first
  std::function<bool()> go_on;           ///< asked now and then; false ends it; may be empty
  std::size_t max_memory = 0;            ///< bytes of address space; 0: no limit
  std::size_t max_file = 0;              ///< bytes of a file that it writes; 0: no limit
  GuardLayers guard;                     ///< those that act
  std::filesystem::path own_folder;      ///< all that a guarded program may change; a whole path without links
};

/// How it ended.
struct ChildEnd {
  int exit_code = 0;
  int signal = 0;              ///< that ended it; 0: none
  int start_error = 0;         ///< why it could not be started, an error number; 0: it was
  bool timed_out = false;      ///< it took too long, and was ended
  bool awaited_input = false;  ///< it read standard input, where nothing ever comes, and was ended
  bool given_up = false;       ///< go_on said so, and it was ended
  std::string errors;          ///< what it wrote on standard error

  bool succeeded() const { return exit_code == 0 && signal == 0 && start_error == 0 && !ended(); }
  bool ended() const { return timed_out || awaited_input || given_up; }
};

/// Whether programs can be run at all.
bool runs_children();

/// Runs it to its end, or ends it. In any case all that it has started is gone when this returns, or ends with this
/// process if that is killed; without a guard only what has not left its process group. Standard output goes nowhere.
ChildEnd run_child(const ChildPlan& plan);

}  // namespace tyndall
