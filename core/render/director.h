#pragma once
#include "core/compile/compile.h"
#include "core/render/frame.h"
#include "core/render/pass.h"
#include "core/render/pictures.h"

#include <chrono>
#include <condition_variable>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

/// The inside of Renderer: what its callers and its one thread share, and what that thread owns.
namespace tyndall {

using Clock = std::chrono::steady_clock;

/// Shared by the callers' threads and the director; everything but the flag is guarded by `mutex`.
struct Mailbox {
  std::mutex mutex;
  std::condition_variable_any wake;
  std::atomic<bool> give_up = false;  ///< asks the crew to leave the current pass

  // in
  std::unique_ptr<Scene> scene;  ///< not yet taken
  Scene newest;                  ///< last submitted
  std::uint64_t edit = 0;        ///< of the newest scene; 0: none yet
  Clock::time_point submitted;
  bool restart = false, paused = false;
  bool frame_outdated = false;  ///< view or limit changed: the same samples are to be published anew
  View view = View::beauty;
  std::uint32_t limit = 0;                ///< samples a pixel at which to stop
  int threads = 0;                        ///< wanted
  std::vector<std::promise<Film>> films;  ///< asked for, not yet answered

  // out
  std::shared_ptr<const Frame> latest;
  std::shared_ptr<const RenderProblem> problem;
  std::shared_ptr<const RenderScene> compiled;
};

/// The thread that takes scenes from the mailbox, drives the crew pass by pass and publishes frames.
class Director {
 public:
  Director(Mailbox& mail, Kernels kernels, int threads, std::function<void()> on_frame);

  /// Until stop is requested.
  void run(const std::stop_token& stop);

 private:
  bool wait_for_work(const std::stop_token& stop);
  void take_orders();
  void take_scene(Scene scene, Clock::time_point before);
  void start_over();
  void answer_films();
  Pass& current_pass();
  std::unique_ptr<Pass> further_pass();
  void finish_pass(double seconds);
  void publish();
  void look_for_rare_paths();
  void find_due_costs();
  void draw(std::vector<float>& rgba);
  bool has_work() const;
  std::int64_t pixels() const { return static_cast<std::int64_t>(compiled_->width) * compiled_->height; }

  Mailbox& mail_;
  Kernels kernels_;
  std::function<void()> on_frame_;
  std::unique_ptr<Crew> crew_;

  // the scene that is shown
  Scene scene_;
  std::shared_ptr<const RenderScene> compiled_;
  std::unique_ptr<SceneViewOf> scene_view_;
  std::uint64_t edit_ = 0;
  Clock::time_point submitted_;
  double budget_ = 0;
  std::uint32_t limit_ = 0;
  View view_ = View::beauty;
  std::optional<double> chance_of_caustics_;  ///< of this scene, once it was asked for
  bool rare_bright_paths_ = false;
  std::uint32_t next_rare_check_ = 0;  ///< samples at which to look for them again
  std::vector<FirstHit> first_hits_;   ///< found when a view asks
  std::vector<float> costs_;           ///< likewise; an older scene's while costs_due_
  bool costs_due_ = true;

  // its samples
  Film film_;
  std::unique_ptr<Pass> pass_;  ///< null between passes
  bool pass_is_coarse_ = false;
  int step_ = 1;                ///< of the coarse pass
  std::uint32_t taken_ = 0;     ///< samples that every pixel has; after rounds of adaptive sampling, their mean
  std::uint32_t pass_end_ = 0;  ///< what it is after the pass that is under way
  bool coarse_done_ = false;
  double seconds_ = 0, mrays_per_s_ = 0, error_ = 0, first_picture_ms_ = 0;
  double paths_per_second_ = 0;        ///< of the last pass
  double first_paths_per_second_ = 0;  ///< of the last passes of one sample: sets the next edit's coarseness
  double picture_seconds_ = 0;         ///< from the film to the last picture
  bool first_picture_due_ = false;
  double pass_seconds_ = 0;
  std::uint64_t frames_ = 0, rejected_ = 0, truncated_ = 0;
  Clock::time_point next_estimate_;
  FrameMemory frame_memory_;
};

}  // namespace tyndall
