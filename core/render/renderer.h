#pragma once
#include "core/render/clean_film.h"
#include "core/render/mailbox.h"
#include "core/render/preview.h"
#include "core/render/progression.h"
#include "core/render/views.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Interactive rendering, for the window.
namespace tyndall {

/// Renders progressively on its own threads: requests go in (the newest one counts), frames come out. No call but
/// film() waits for rendering. The picture of a scene does not depend on what was shown before.
class Renderer {
 public:
  struct Options {
    int threads = 0;  ///< 0: see thread_count()
    std::string isa;  ///< "": the best
  };
  /// on_frame: called from a thread of the renderer after each frame; must be quick (for example, wake an event loop).
  explicit Renderer(const Options& options, std::function<void()> on_frame = {});
  ~Renderer();

  /// Replaces the request, and returns the number of the edit that it shows. A scene that renders to the same picture
  /// as the one before (equal but for names and display) restarts nothing and keeps its number.
  std::uint64_t request(RenderRequest request) { return mail_.request(std::move(request)); }
  /// The results so far.
  RenderReply reply() const { return mail_.reply(); }
  std::shared_ptr<const Frame> latest() const { return reply().frame; }
  /// Reports that the frame of that pass is on the screen. After the first such call the renderer gives way to the
  /// screen: after the first frame of an edit it waits until that was shown, at most 50 ms.
  void note_shown(std::uint64_t pass) { mail_.note_shown(pass); }

  /// A copy of the film, for example for snapshots. Waits for the end of the current pass, so that all pixels have
  /// their full number of samples. Empty before the first full pass.
  Film film() const { return mail_.ask_for_film().get(); }
  /// The first hit at a pixel of the newest compiled scene: the object as a path of indices into Scene::objects (one
  /// for each group that it is in; empty: nothing), its depth along the camera's axis, and the point, in world space.
  struct Pick {
    std::vector<int> object;
    double depth = 0;
    Vec3d point;
  };
  Pick pick(int x, int y) const;

 private:
  // The thread that takes requests from the mailbox, renders pass by pass, and publishes frames.
  void run();
  void go_on();
  bool run_pass(std::uint32_t limit);
  void tell_if_it_fails(std::uint64_t edit, const std::function<void()>& step);
  void tell(std::uint64_t edit, const std::exception& error);
  void follow(const ReceivedRequest& next);
  bool take_scene();
  bool go_on_from(Film* film);
  void start_over(double budget);
  void begin_picture();
  void answer_films();
  void finish_pass();
  void report_pixel();
  void publish();
  void make_coarse_clean();
  bool clean_is_due() const { return shown_.prepared && clean_.is_due(picture_, !unfinished(request_.limit())); }
  bool unfinished(std::uint32_t limit) const { return shown_.prepared && picture_.taken() < limit; }
  RenderEngine engine() const {
    return {*thread_pool_, kernels_, shown_.prepared->view(), shown_.samples.get(), &mail_.give_up()};
  }

  mutable Mailbox mail_;
  Kernels kernels_;
  std::function<void()> on_frame_;
  std::unique_ptr<ThreadPool> thread_pool_;

  /// The scene being rendered.
  struct ShownScene {
    std::shared_ptr<const PreparedScene> prepared;  ///< null: none came yet
    std::shared_ptr<const SampleSource> samples;    ///< see RenderRequest
    std::uint64_t edit = 0;
    Clock::time_point submitted;  ///< when the edit or its newest restart was requested
  } shown_;
  Progression picture_;
  FirstPictures first_pictures_;
  Views views_;
  LiveClean clean_;
  FrameMemory frame_memory_;

  ReceivedRequest request_;  ///< the request being followed
  bool rare_paths_ = false;  ///< the estimated error is too small, because only rare paths carry some of the light
  bool stalled_ = false;     ///< a step failed; nothing is done until the next request
  double budget_ = 0;        ///< seconds for the first picture of the newest edit
  std::uint64_t frames_ = 0;
  std::optional<double> first_picture_ms_;  ///< absent until the newest edit or restart has its first picture
  std::optional<JoinedThread> thread_;      ///< declared last, so that it ends before the members that it uses
};

}  // namespace tyndall
