#include "app/window/main_window.h"

#include "app/text/standard_streams.h"
#include "app/window/document/document.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/system/process.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace tyndall {
namespace {

/// Lets freed memory go back to the system, so that a window that is kept open does not grow. Left to itself, glibc
/// takes ever larger blocks from its heap, where what is freed stays between what is used: after a quarter of an hour
/// of random input a small window took 174 MB, and takes 152 MB this way. The price is 300 new pages, or 0.7 ms, for
/// each picture while the camera is dragged in a window of 1280 x 720. And it gives each thread a heap of its own, with
/// holes of its own: they grew by 3 to 5 MB in half an hour, and do not in one heap for all. Called before the first
/// thread starts.
void give_freed_memory_back() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 256 * 1024);
  mallopt(M_ARENA_MAX, 1);
#endif
}

}  // namespace

int MainWindow::run() {
  while (step()) {
  }
  platform_->hide();  // a comparison or a snapshot may still take a second
  // Says what becomes of edits that no file has, which there are where a signal ends the window.
  const int signal = signals_ ? signals_->received() : 0;
  session_.wanted.paused = true;
  session_.send(clock_seconds(), false);
  if (const std::string edits = session_.flush_edits(); !edits.empty()) complain(printable(edits, 2000));
  if (const std::string files = session_.finish_files(); !files.empty()) complain(printable(files, 2000));
  return signal == 0 ? 0 : 128 + signal;
}

/// Asks the renderers for what is wanted now, see Session.
void MainWindow::send(double now, bool scene_too) {
  if (scene_too) picture_.note_shown();  // of the drawing before: the workers begin with a newer scene, if one is sent
  session_.send(now, scene_too);
  const std::uint64_t edit = session_.renderers.edit(Half::current);
  if (edit != paced_edit_) session_.pacing.on_edit(paced_edit_ = edit, now);
}

bool MainWindow::picture_due(double now) const {
  const auto frame = picture_.unseen();
  if (!frame || now < session_.pacing.next_drawing()) return false;
  return now >= session_.pacing.picture_due() || frame->finished;
}

bool MainWindow::hidden() const {
  const WindowSize size = platform_->size();
  return size.framebuffer_width <= 0 || size.framebuffer_height <= 0;
}

double MainWindow::waiting_time(double now) {
  if (takes_in_again_) return 0;
  const double sends = std::max(0.0, session_.timer.latest() - now);
  if (hidden()) {  // nothing to draw until an event shows the window again
    frame_due_ = std::numeric_limits<double>::infinity();
    return sends;
  }
  // The order matters: a frame that comes from here on, after its time, wakes the window. One that came before is seen
  // below. One that comes in between is seen when its time has come.
  const double due = std::max(session_.pacing.picture_due(), session_.pacing.next_drawing());
  frame_due_ = due;
  const auto frame = picture_.unseen();
  double wait = std::max(session_.pacing.wait(now), awaits_until_ - now);
  if (frame)
    wait = std::min(wait, std::max(0.0, (frame->finished ? session_.pacing.next_drawing() : due) - now));
  else if (due > now)
    wait = std::min(wait, due - now);
  return std::min(wait, sends);
}

bool MainWindow::step() {
  if (commands_.closed() || (signals_ && signals_->received() != 0)) return false;
  // Asked first: a picture that comes later is not missed.
  const bool at_rest =
      log_ && session_.at_rest() && !picture_tools_.inspector.busy() && gallery_.thumbnails.idle() && strip_.at_rest();
  const double wait = waiting_time(clock_seconds());
  if (at_rest && wait >= 1) log_->rest();
  platform_->wait(wait);
  frame_rang_ = false;
  const InputEvents events = platform_->take_events();
  if (events.closes) commands_.ask_to_close();
  if (input_since_ <= 0) input_since_ = events.first;
  const bool looked = picture_tools_.inspector.collect(session_.renderers), came = gallery_.collect(),
             varied = strip_.collect();
  if (events.any || session_.collect() || looked || came || varied) session_.pacing.on_event();
  for (const KeyPress& press : events.keys)
    if (log_ && press.character == '\0') log_->line("key " + std::to_string(press.key));
  commands_.take(events);
  const double now = clock_seconds();
  if (session_.accuracy.collect()) session_.pacing.wake_at(now);
  const bool due = picture_due(now), again = std::exchange(takes_in_again_, false);
  if (!due && !again) send(now);
  if (due || again || (session_.pacing.wait(now) <= 0 && now >= awaits_until_)) draw(now);
  return true;
}

void MainWindow::rest(bool rests) {
  bool& paused = session_.wanted.paused;
  if (rests) paused_before_ = paused;
  paused = rests || paused_before_;
  session_.send(clock_seconds(), false);
}

int run_window(const WindowOptions& options) {
  if (!options.hosted) give_freed_memory_back();
  // GLFW is not touched without a display: its error would say less.
  if (!has_display()) throw IoError("no display: neither DISPLAY nor WAYLAND_DISPLAY is set");
  std::shared_ptr<const Reference> reference;
  if (!options.reference.empty())
    reference = std::make_shared<const Reference>(read_reference(options.reference, document_of(options.scene)));
  const Scene& scene = options.scene.scene;
  MainWindow window(options, std::move(reference), open_platform(scene.width, scene.height));
  if (options.hosted) return window.run();
  end_when_display_is_lost([&window] { return printable(window.flush_edits(), 2000); });
  const int code = window.run();
  end_when_display_is_lost({});  // what is left is gone soon
  return code;
}

}  // namespace tyndall
