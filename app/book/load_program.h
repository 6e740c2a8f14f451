#pragma once
#include "app/book/compile_program.h"
#include "app/book/own_program.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

/// Programs of readers of "Ray Tracing in One Weekend", compiled with their own headers.
namespace tyndall {

/// Whether the name is a C++ source file's: it ends in .cc, .cpp or .cxx.
bool is_program(const std::string& name);

struct ProgramRequest {
  ProgramSources sources;       ///< as the user named them
  std::string compiler{};       ///< see ProgramTask
  double seconds = 20;          ///< that the program may run before its first ray
  std::function<bool()> go_on;  ///< asked now and then; false gives up; may be empty
  bool watch_signals = true;    ///< see ProgramTask; false where a window watches them
  bool trusted = false;         ///< see ProgramTask
};

/// What a program shows: a scene, or samples of its own.
struct ProgramScene {
  std::string json;                          ///< a scene file's text, with size, samples and depth; "": there is none
  std::string reason;                        ///< why there is none, in one sentence
  int width = 0, height = 0, samples = 0;    ///< of its picture
  std::vector<std::string> notes;            ///< what the user should know, a line each
  std::vector<std::filesystem::path> files;  ///< of the reader's, that were read
  std::shared_ptr<OwnProgram> own;           ///< computes what it would
  bool fuzz_on_sphere = false;               ///< its metals are those of the fourth edition
  bool matt_in_sphere = false;               ///< its matt surfaces are those of the first edition
  bool short_frame = false;                  ///< it divides by width - 1 and height - 1
  bool draws_by_pdf = false;                 ///< it draws directions as the third book does, from mixtures
  bool has_noise = false;                    ///< it has textures of noise, whose lattice is its own
  bool has_images = false;                   ///< it has textures of images, which it reads by a curve of its own
};

/// Compiles the program and runs it in its folder until it asks for the colour of its first ray; then its world is
/// read. It can change nothing outside a temporary folder, unless there is no guard and it is trusted. This runs the
/// reader's code: only for files that the user has named. Throws UsageError where there is nothing to show, IoError
/// where the system fails, ProgramInterrupted; all in one line.
ProgramScene load_program(const ProgramRequest& request);

}  // namespace tyndall
