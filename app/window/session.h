#pragma once
#include "app/files/watch.h"
#include "app/window/accuracy/fair_share.h"
#include "app/window/accuracy/live_accuracy.h"
#include "app/window/document/history.h"
#include "app/window/document/job_queue.h"
#include "app/window/system/ui_log.h"
#include "app/window/window.h"
#include "core/render/renderer.h"

#include <atomic>
#include <memory>
#include <optional>
#include <string>

namespace tyndall {

/// What the user is told, one line.
struct Message {
  std::string text;  ///< "": none
  bool error = false;
  double until = 0;  ///< clock second at which it goes; errors stay until something is done about them
};

/// Whether both scenes render to the same picture: equal but for what is applied when it is shown.
bool same_picture(const Scene& a, const Scene& b);

/// The open document, its history, the renderer, files: all that a window does but for drawing and input. Used by the
/// main thread only; never waits for rendering or for files.
class Session {
 public:
  /// wake: called from any thread when collect() has something to do; on_frame: from the renderer's, after each frame;
  /// log: may be null.
  Session(const WindowOptions& options, std::function<void()> wake, std::function<void()> on_frame, UiLog* log);
  /// Finishes what is being saved.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  const Document& document() const { return history_.current(); }
  const Scene& scene() const { return history_.current().scene; }
  /// Takes an edited scene: checks it, remembers it, submits it if its picture differs. What is broken is refused with
  /// a message.
  void edit(Scene scene, std::uint64_t gesture);
  void undo();
  void redo();

  /// Opens what load_scene takes, in the background.
  void open(const std::string& what);
  /// A file that was dropped: a scene, an image with a scene in it, or an image that becomes the reference.
  void open_dropped(const std::filesystem::path& file);
  /// Writes the scene to its own file, or to another one; says how it went. An existing file is replaced.
  void save(std::filesystem::path file);
  /// Writes the picture as numbered files into the current folder, in the background.
  void snapshot();
  /// Writes the chart's curves as numbered files beside the snapshots, in the background.
  void export_chart();

  void pause(bool paused);
  bool paused() const { return paused_; }
  void restart();
  void set_threads(int threads);
  int threads() const { return threads_; }
  /// error: a picture of differences instead of the view.
  void set_view(View view, ErrorView error);
  Renderer::Pick pick(int x, int y) const { return renderer_.pick(x, y); }

  std::shared_ptr<const Frame> latest() const { return renderer_.latest(); }
  /// Of the left half of a split view; null: there is none.
  std::shared_ptr<const Frame> latest_kept() const { return second_ ? second_->latest() : nullptr; }
  /// A frame is on the screen: for the chart.
  void shown(Half half, const std::shared_ptr<const Frame>& frame);
  /// Number of the newest edit that went to the renderer.
  std::uint64_t edit_number() const { return edit_; }
  /// Hands the newest scene to the renderer once the one before it has been seen: while something is dragged, each
  /// scene that is begun is shown, instead of all being given up for the next. Whether it did.
  bool send(double now);
  /// When send() will not wait any longer for a picture; infinite: nothing is to be sent.
  double send_time() const;

  // session_accuracy.cpp
  const LiveAccuracy& accuracy() const { return accuracy_; }
  /// Reads an image, in the background, that errors are measured against.
  void open_reference(const std::filesystem::path& file);
  void set_reference(std::shared_ptr<const Reference> reference);
  /// The picture that is on the screen becomes the reference.
  void keep_as_reference();
  void drop_reference();
  /// Side by side: on the left the settings that the scene has now, on the right those that it will have, each for as
  /// many core-seconds. Both start anew.
  void set_split(bool split);
  bool split() const { return second_ != nullptr; }
  /// Of the left half, and of the right half or the only picture.
  std::string method(Half half) const;
  /// Whether there is something to measure the picture against.
  bool can_show_errors() const;

  /// Takes what was measured in the background. Whether it is to be shown before the next picture comes.
  bool collect_errors() { return accuracy_.collect(); }
  /// Takes what the background has done, a changed file, a problem of the renderer. Whether anything came.
  bool collect();

  void say(const std::string& text, bool error = false);
  const Message& message() const { return message_; }
  void dismiss() { message_ = {}; }

 private:
  void show(Document document, bool own_file);
  void picture_changed();
  void submit(double now);
  void submit_kept();
  bool resting() const;
  void watch();
  void reload();
  void read_in_background(const std::function<JobQueue::Result()>& read);

  std::function<LoadedScene()> reload_;
  std::string isa_;
  std::filesystem::path reloads_;  ///< the file that reload_ reads
  UiLog* log_;
  std::function<void()> wake_, on_frame_;
  History history_;
  LiveAccuracy accuracy_;
  Message message_;
  int threads_ = 1, snapshots_ = 0, charts_ = 0;
  std::atomic<std::uint64_t> edit_ = 0;
  std::uint64_t problem_edit_ = 0;
  bool paused_ = false;
  View view_ = View::beauty;
  RenderSettings kept_;          ///< of the left half of a split view
  std::uint64_t kept_edit_ = 0;  ///< number of its newest edit
  double changed_at_ = -1;       ///< since when the picture differs from what was sent; < 0: it does not
  double sent_at_ = 0;
  std::atomic<bool> file_changed_ = false, came_ = false, closing_ = false;
  std::filesystem::path watched_;
  FairShare share_{renderer_};
  Renderer renderer_;
  std::shared_ptr<Renderer> second_;  ///< of the left half; null: there is no split view
  std::unique_ptr<FileWatch> watch_;
  JobQueue loading_, saving_;  // last: their jobs use the others
};

}  // namespace tyndall
