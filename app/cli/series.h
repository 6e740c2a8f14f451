#pragma once
#include "app/cli/render_setup.h"
#include "app/text/progress.h"
#include "core/system/signals.h"

#include <cstddef>
#include <functional>
#include <set>
#include <string>

/// The pictures that a command renders, one after the other: a render is a list of one.
namespace tyndall {

/// Checks the names of the outputs, before any file is read.
void check_names(const CommandRequest& command);
/// Finds everything else that can be wrong before the first sample, and where the render begins.
void prepare(RenderJob& job);
/// Lets a job that is prepared start with a whole film, to which nothing is added.
void take_film(RenderJob& job, Film film);

/// What a render has come to, at its end or when it is asked for in between.
struct RenderOutcome {
  const RenderResult& result;
  FinishedPicture picture;
  bool unfinished = false;  ///< more samples are to come
};

/// What a command does beside rendering and writing a picture. All may be empty.
struct PictureSteps {
  std::function<void(const RenderOutcome&)> rendered;  ///< before anything is written, also of what is unfinished
  std::function<void()> writing;                       ///< before the files of a whole picture are written
  std::function<void(const RenderOutcome&, bool written)> made;  ///< of a whole picture, at the end
};

/// Renders and writes each, and tells how far all of them are.
class Series {
 public:
  /// count: of pictures that are to be rendered.
  Series(ProgressStyle style, std::size_t count) : report_(style), count_(count) {}

  /// Makes the picture of a job that is prepared. name: "frame 12"; "": it is the only one. False if something could
  /// not be written.
  bool make(RenderJob& job, const std::string& name, const PictureSteps& steps);
  void finish(const std::string& summary) { report_.finish(summary); }

  /// The signal that asked for an end; 0: none did.
  int signal() const { return signals_.received(); }
  std::size_t made() const { return made_; }   ///< pictures that are whole
  double seconds() const { return seconds_; }  ///< of rendering
  std::size_t left() const { return count_ - made_; }

 private:
  RenderResult render(RenderJob& job, const std::string& name);
  void warn(const RenderJob& job, const RenderOutcome& outcome, const std::string& name);

  SignalWatch signals_;
  ProgressReport report_;
  std::size_t count_, begun_ = 0, made_ = 0;
  double seconds_ = 0;
  std::set<std::string> told_;
};

}  // namespace tyndall
