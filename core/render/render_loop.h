#pragma once
#include "core/render/clean_film.h"
#include "core/render/mailbox.h"
#include "core/render/preview.h"
#include "core/render/progression.h"
#include "core/render/views.h"

#include <functional>
#include <memory>
#include <optional>

/// The inside of Renderer: the thread that takes requests from the mailbox, renders pass by pass, and publishes frames.
namespace tyndall {

/// The scene being rendered.
struct ShownScene {
  std::shared_ptr<const PreparedScene> prepared;  ///< null: none came yet
  std::shared_ptr<const SampleSource> samples;    ///< see RenderRequest
  std::uint64_t edit = 0;
  Clock::time_point submitted;  ///< when the edit or its newest restart was requested
};

class RenderLoop {
 public:
  /// on_frame: see Renderer.
  RenderLoop(Mailbox& mail, Kernels kernels, int threads, std::function<void()> on_frame);

  /// Renders until a stop is requested.
  void run(const StopToken& stop);

 private:
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

  Mailbox& mail_;
  Kernels kernels_;
  std::function<void()> on_frame_;
  std::unique_ptr<ThreadPool> thread_pool_;

  ShownScene shown_;
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
};

}  // namespace tyndall
