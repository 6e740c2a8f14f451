#pragma once
#include "app/window/document/document.h"
#include "app/window/document/job_queue.h"
#include "app/window/document/message.h"
#include "core/render/renderer.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// Files that the window writes without asking for a name: showroom-001.png, showroom-002.png, and so on; and
/// snapshots, the picture on the screen as such files.
namespace tyndall {

/// FOLDER/STEM-001, or with the first number from `minimum` on for which no file with one of the endings exists.
/// Without its ending.
std::filesystem::path numbered_base(const std::filesystem::path& folder, const std::string& stem, int minimum,
                                    const std::vector<const char*>& endings);

/// The number in a name from numbered_base().
int number_of(const std::filesystem::path& base);

/// Writes files of one kind into the current folder, in the background: numbered, never replacing one, and never giving
/// a number twice.
class NumberedFiles {
 public:
  /// jobs: may be constructed later, and ends before this. log: may be null.
  NumberedFiles(std::vector<const char*> endings, JobQueue& jobs, MessageLine& messages, UiLog* log)
      : endings_(std::move(endings)), jobs_(jobs), messages_(messages), log_(log) {}

  /// The next name: STEM-001, without its ending. Files that are still to be written count as written.
  std::filesystem::path next_base(const std::string& stem);
  /// Runs work(base) in the background: it writes the files of that base and returns what to tell the user, or throws.
  /// If another window or program has written files of that name meanwhile, work() gets the next free name.
  void write(const std::filesystem::path& base, std::function<std::string(const std::filesystem::path& base)> work);

 private:
  std::vector<const char*> endings_;
  JobQueue& jobs_;
  MessageLine& messages_;
  UiLog* log_;
  int last_ = 0;
};

struct Snapshot {
  Document document;
  std::filesystem::path base;  ///< the files' names without their endings
  std::string isa;             ///< of the kernel that renders
  int threads = 1;
  bool has_scene = true;  ///< the files hold the scene, and the EXR what it is made of; else the picture alone
};

/// Writes BASE.png and BASE.exr (in builds with OpenEXR) from a film. Returns what to tell the
/// user. Throws ImageFileError.
std::string write_snapshot(const Snapshot& snapshot, Film film);

/// Waits until every pixel of the film has a sample, and returns the film. film: returns it as it is at present. Gives
/// up, with an empty film, after 20 seconds, as soon as current() is false because the picture was edited meanwhile, or
/// as soon as patient() is false because the window is closing.
Film wait_for_film(const std::function<Film()>& film, const std::function<bool()>& current,
                   const std::function<bool()>& patient);

}  // namespace tyndall
