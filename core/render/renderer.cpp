#include "core/render/renderer.h"

#include "core/accuracy/estimate.h"
#include "core/base/error.h"
#include "core/base/seconds.h"
#include "core/scene/scene.h"

#include <exception>
#include <new>
#include <utility>

namespace tyndall {
namespace {

constexpr double pass_budget = 0.15;   // from one picture to the next while a picture converges
constexpr double picture_pause = 0.5;  // the same where a pass takes longer, as a source of samples is slow

ProgressionOptions progression_options(const Scene& scene, int coarse_step, const Region& first) {
  ProgressionOptions options;
  options.first = first;
  options.adaptive = scene.render.adaptive;
  options.coarse_step = coarse_step;
  options.length = {.growth = 1, .maximum = 64, .seconds = pass_budget};
  options.estimates = {.seconds = 0.4, .growth = 0, .each_below = 16};
  return options;
}

}  // namespace

Renderer::Renderer(const Options& options, std::function<void()> on_frame)
    : kernels_(kernels_of(options.isa)),
      on_frame_(std::move(on_frame)),
      thread_pool_(std::make_unique<ThreadPool>(options.threads)),
      clean_(kernels_),
      thread_([this] { run(); }) {}

Renderer::~Renderer() {
  mail_.stop();
  thread_.reset();
  for (auto& request : mail_.take_film_requests()) request.set_value({});  // so that no caller waits forever
}

Renderer::Pick Renderer::pick(int x, int y) const {
  const std::shared_ptr<const PreparedScene> prepared = mail_.prepared();
  if (!prepared) return {};
  const RenderScene* scene = &prepared->columns();
  if (x < 0 || y < 0 || x >= scene->width || y >= scene->height) return {};
  FirstHit hit;
  scalar_kernels().first_hits(prepared->view(), {x, y, x + 1, y + 1}, &hit);
  if (hit.element < 0) return {};
  const auto column = static_cast<double>(x) + 0.5, row = static_cast<double>(y) + 0.5;
  const CameraColumns& c = scene->camera;
  const Vec3d offset = to_double(c.corner) + column * to_double(c.du) + row * to_double(c.dv);
  const double scale = static_cast<double>(hit.depth) / dot(offset, to_double(c.axis));
  return {scene->object_of(hit.element), static_cast<double>(hit.depth),
          scene->origin + to_double(c.center) + scale * offset};
}

/// Renders until a stop is requested.
void Renderer::run() {
  while (mail_.wait([this](std::uint32_t limit) { return !stalled_ && (unfinished(limit) || clean_is_due()); })) {
    stalled_ = false;
    try {
      const ReceivedRequest next = mail_.take();
      tell_if_it_fails(next.edit, [&] { follow(next); });
      if (mail_.stops()) return;
      tell_if_it_fails(shown_.edit, [this] { go_on(); });
    } catch (...) {  // not even the message fits into memory: the next request is a new attempt
      stalled_ = true;
    }
  }
}

void Renderer::go_on() {
  if (stalled_) return;
  const std::uint32_t limit = request_.limit();
  if (unfinished(limit) && run_pass(limit)) finish_pass();
  // An urgent request interrupts the filter; it is tried again later.
  if (clean_is_due() && !mail_.give_up() && clean_.make(picture_, engine(), mail_.give_up())) publish();
}

/// Returns whether a pass is complete. With a source of samples, which may be slow, it breaks off a pass now and then
/// to show what all pixels have by then; the next call continues it.
bool Renderer::run_pass(std::uint32_t limit) {
  const Limits limits{.spp = limit};
  if (!shown_.samples) return picture_.run_pass(engine(), limits, mail_.give_up());
  const Clock::time_point start = Clock::now();
  std::atomic<bool> pause = false;
  const auto look = [&] { pause = mail_.give_up() || seconds_since(start) >= picture_pause; };
  if (picture_.run_pass(engine(), limits, pause, look)) return true;
  if (!mail_.give_up() && (picture_.taken() > 0 || picture_.is_filling())) publish();
  return false;
}

/// Memory can run out at any step. Then the callers get a RenderProblem, the pictures so far stay, and nothing is tried
/// again until the next request.
void Renderer::tell_if_it_fails(std::uint64_t edit, const std::function<void()>& step) {
  try {
    step();
  } catch (const std::exception& error) {
    stalled_ = true;
    tell(edit, error);
    answer_films();
  }
}

void Renderer::tell(std::uint64_t edit, const std::exception& error) {
  const bool memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
  mail_.post(RenderProblem{edit, memory ? "not enough memory" + memory_limit_text() : error.what()});
  if (on_frame_) on_frame_();
}

/// The only place that compares the new request with the one before.
void Renderer::follow(const ReceivedRequest& next) {
  const RequestChange change = change_between(request_, next);
  request_ = next;
  const RenderRequest& wanted = request_.wanted;
  clean_.set_wanted(wanted.clean);
  picture_.set_first(wanted.refine_first);
  if (change.threads && wanted.threads > 0 && wanted.threads != thread_pool_->size())
    tell_if_it_fails(next.edit, [&] { thread_pool_ = std::make_unique<ThreadPool>(wanted.threads); });
  bool goes_on = false;
  if (change.scene) {
    goes_on = take_scene();
  } else if (change.restart && shown_.prepared) {
    shown_.submitted = next.since;
    start_over(budget_);
  }
  answer_films();
  const bool redraws = change.drawing || change.limit || goes_on;
  if (redraws && shown_.prepared && picture_.has_picture()) publish();
  if (change.pixel) report_pixel();
}

/// Makes the requested scene the one that is rendered. If it cannot be compiled, everything stays as it was, and the
/// mailbox gets a RenderProblem. Returns whether the picture continues a film.
bool Renderer::take_scene() {
  bool goes_on = false;
  try {
    ShownScene next{prepare(request_.wanted.scene, shown_.prepared.get()), request_.wanted.samples, request_.edit,
                    request_.since};
    const bool camera_only =
        shown_.prepared && !change_between(shown_.prepared->scene(), next.prepared->scene()).others;
    const double budget = picture_budget(camera_only, seconds_between(shown_.submitted, next.submitted));
    std::swap(shown_, next);
    try {
      goes_on = go_on_from(request_.wanted.film.get());
      if (!goes_on) start_over(budget);
    } catch (...) {
      std::swap(shown_, next);
      throw;
    }
    budget_ = budget;
    views_.change_scene(shown_.prepared);
    clean_.change_scene();
    mail_.post(shown_.prepared);
    if (goes_on) picture_.estimate_now(engine(), mail_.give_up());
  } catch (const std::exception& e) {
    tell(request_.edit, e);
  }
  return goes_on;
}

/// Takes over the samples of a film of the scene. Returns false if there are none, or if the film is of another size.
bool Renderer::go_on_from(Film* film) {
  const RenderScene& scene = shown_.prepared->columns();
  const Region whole{0, 0, scene.width, scene.height};
  if (!film || film->width != scene.width || film->height != scene.height || !(film->region == whole) ||
      film->first_sample != 0 || film->quantum != scene.film_quantum)
    return false;
  picture_.go_on(std::move(*film), progression_options(shown_.prepared->scene(), 1, request_.wanted.refine_first));
  begin_picture();
  return true;
}

void Renderer::start_over(double budget) {
  const RenderScene& scene = shown_.prepared->columns();
  const auto pixels = static_cast<std::int64_t>(scene.width) * scene.height;
  const int step = shown_.samples ? source_coarse_step(pixels, first_pictures_.paths_per_second(), budget)
                                  : first_pictures_.step_for(pixels, budget, request_.wanted.shown_pixels);
  ProgressionOptions options = progression_options(shown_.prepared->scene(), step, request_.wanted.refine_first);
  if (shown_.samples) {
    options.quantum = source_quantum;
    options.clear = is_slow_source(pixels, first_pictures_.paths_per_second());
  }
  picture_.start(scene, {0, 0, scene.width, scene.height}, 0, options);
  begin_picture();
}

/// Forgets what was known of the previous picture.
void Renderer::begin_picture() {
  rare_paths_ = false;
  clean_.start_over();
  first_picture_ms_.reset();
}

void Renderer::finish_pass() {
  if (picture_.taken() <= 1) first_pictures_.note_pass(picture_.tally().last_paths_per_second);
  if (picture_.taken() >= min_rare_spp && picture_.estimate_is_new())
    rare_paths_ = has_rare_bright_paths(picture_.estimate(), picture_.taken(), shown_.prepared->caustic_chance());
  const bool first = !first_picture_ms_;
  report_pixel();
  publish();
  if (!first) return;
  // Until the first picture of an edit is on the screen, the processors are left to it.
  if (const auto seconds = mail_.wait_until_shown(frames_)) first_pictures_.note_showing(*seconds);
  make_coarse_clean();
}

/// Reports what is known of the watched pixel.
void Renderer::report_pixel() {
  const auto& pixel = request_.wanted.watched_pixel;
  if (!pixel || !shown_.prepared) return;
  PixelReport report{.x = pixel->first, .y = pixel->second, .edit = shown_.edit};
  if (picture_.taken() > 0) look_at_pixel(picture_.film(), report);
  mail_.post(report);
  if (on_frame_) on_frame_();
}

/// Shows what the picture will look like once it has samples to filter. A request that cannot wait interrupts this.
/// The samples for it are taken through a camera of larger pixels, which a source of samples has not.
void Renderer::make_coarse_clean() {
  if (shown_.samples || request_.limit() < min_clean_spp || picture_.taken() >= min_clean_spp) return;
  if (!clean_.make_coarse(picture_.film(), first_pictures_.paths_per_second(), engine(), mail_.give_up())) return;
  publish();
  mail_.wait_until_shown(frames_);
}

void Renderer::publish() {
  const std::shared_ptr<Frame> frame = frame_memory_.take(picture_.film().pixels.size());
  const Clock::time_point start = Clock::now();
  const View view = request_.wanted.view;
  frame->clean = clean_.latest();
  if (view != View::beauty && picture_.taken() > 0)
    views_.draw(View::beauty, picture_, nullptr, engine(), mail_.give_up(), frame->beauty);
  frame->grid = views_.draw(view, picture_, frame->clean.get(), engine(), mail_.give_up(), frame->rgba);
  const Clock::time_point drawn = Clock::now();
  first_pictures_.note_drawing(seconds_between(start, drawn));
  if (!first_picture_ms_) first_picture_ms_ = 1000 * seconds_between(shown_.submitted, drawn);
  const Film& film = picture_.film();
  const PassTally tally = picture_.tally();
  frame->edit = shown_.edit;
  frame->pass = ++frames_;
  frame->width = film.width, frame->height = film.height;
  frame->view = view;
  frame->white = views_.white();
  frame->awaits_clean = clean_is_due();
  frame->step = picture_.step();
  frame->max_spp = picture_.max_taken();
  frame->spp = picture_.taken();
  frame->relative_error = picture_.error();
  frame->rare_bright_paths = rare_paths_ || (frame->clean && frame->clean->doubtful);
  frame->seconds = tally.seconds;
  frame->mrays_per_s = tally.last_mrays_per_s;
  frame->first_picture_ms = *first_picture_ms_;
  frame->samples = tally.samples, frame->rejected = tally.rejected, frame->truncated = tally.truncated;
  frame->reuses_paths = shown_.prepared->reuses_paths();
  frame->guide_lobes = shown_.prepared->guide().lobes();
  frame->guide_ms = shown_.prepared->guide().milliseconds;
  frame->cut_throughput = picture_.cut_throughput();
  frame->film_bytes = film.pixels.size() * bytes_per_pixel(!film.emission.empty());
  frame->isa = kernels_.isa;
  frame->lanes = kernels_.lanes, frame->threads = thread_pool_->size();
  mail_.post(frame);
  if (on_frame_) on_frame_();
}

/// Gives a copy of the film to callers who wait for one. Within a pass some pixels lack samples that others have, so an
/// interrupted pass is finished first. If the renderer is paused, has reached its limit or has failed, nothing would
/// finish the pass: then the film is given as it is; and so it is where a source of samples may take long to finish it.
void Renderer::answer_films() {
  if (picture_.within_pass() && unfinished(request_.limit()) && !stalled_ && !shown_.samples) return;
  for (auto& request : mail_.take_film_requests()) {
    try {
      request.set_value(picture_.taken() > 0 ? picture_.film() : Film{});
    } catch (const std::bad_alloc&) {
      request.set_exception(std::current_exception());
    }
  }
}

}  // namespace tyndall
