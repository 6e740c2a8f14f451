#include "app/window/session.h"

#include "app/curves/chart.h"
#include "app/window/document/open_document.h"
#include "core/base/error.h"
#include "core/base/target.h"
#include "core/scene/scene.h"
#include "core/system/processors.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace tyndall {
Session::Session(const WindowOptions& options, const std::function<void()>& wake, std::function<void()> on_frame,
                 UiLog* log)
    : log_(log),
      isa_(options.isa),
      messages_(log),
      limits_(options.limits),
      accuracy_(wake),
      renderers_(thread_count(options.threads).count, options.isa, std::move(on_frame)),
      editor_(options.scene, reload_of(options),
              {[this] { timer_.on_change(input_time_ > 0 ? input_time_ : clock_seconds()); },
               [this] { accuracy_.clear(), set_split(false); },
               [isa = options.isa](const LoadedScene& loaded) { return read_opened_film(loaded, isa); },
               [this](std::shared_ptr<Film> film) {
                 opened_film_ = std::move(film);
                 timer_.on_change(clock_seconds());
               },
               wake},
              loading_, messages_, log),
      kept_(state_folder(), wake),
      picture_(options.picture),
      function_(options.function),
      references_(
          editor_,
          [this] {
            return Document{*rendered_scene(), editor_.document().origin};
          },
          accuracy_, messages_, wake),
      snapshots_({".png", ".exr"}, saving_, messages_, log),
      charts_({".csv", ".svg"}, saving_, messages_, log),
      loading_(wake),
      saving_(wake) {
  wanted_.threads = thread_count(options.threads).count;
  read_preferences_file();
  if (!options.scene.is_picture) restore_edits(options);
  timer_.on_change(clock_seconds());
  submit(clock_seconds());
  if (isa_.empty() && !slow_build_warning().empty()) messages_.say_until_done(slow_build_warning());
  if (options.scene.source.empty()) editor_.open_film(options.scene);
  if (picture_) picture_->start(wake);
  if (function_) function_->set_on_news(wake);
}

/// Reads the first scene again, as long as the window is open; empty: cannot be read again.
std::function<LoadedScene()> Session::reload_of(const WindowOptions& options) {
  if (!options.reload) return {};
  return [this, reload = options.reload] { return reload([this] { return !closing_; }); };
}

/// The scene as the renderers get it.
std::shared_ptr<const Scene> Session::rendered_scene() {
  std::shared_ptr<const Scene> scene = editor_.shared();
  if (!picture_size_ || *picture_size_ == PictureSize{scene->width, scene->height}) return scene;
  auto sized = std::make_shared<Scene>(*scene);
  sized->width = picture_size_->width, sized->height = picture_size_->height;
  return sized;
}

void Session::set_picture_size(std::optional<PictureSize> size) {
  if (size == picture_size_) return;
  picture_size_ = size;
  wanted_.refine_first = {};  // its pixels are others now
  timer_.on_change(clock_seconds());
}

Session::~Session() {
  closing_ = true;
  if (picture_) picture_->stop();
  if (function_) function_->set_on_news({});
}

std::string Session::finish_files() {
  closing_ = true;
  const int errors = messages_.errors();
  std::string problems;
  while (!saving_.idle()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const int before = messages_.errors();
    saving_.collect();
    if (messages_.errors() > before) problems += (problems.empty() ? "" : "; ") + messages_.current().text;
  }
  return messages_.errors() > errors ? problems : "";
}

bool Session::send(double now, bool scene_too) {
  keep_edits();
  const std::uint64_t edit = renderers_.edit(Half::current);
  const auto frame = renderers_.latest(Half::current);
  const bool seen = edit == 0 || (frame && frame->edit >= edit);
  const bool due = scene_too && timer_.due(seen, now);
  due ? submit(now) : static_cast<void>(ask());
  return due;
}

/// The edited scene is wanted from now on.
void Session::submit(double now) {
  if (std::exchange(limited_edit_, 0) > 0) wanted_.paused = false;
  const auto before = std::exchange(wanted_.scene, rendered_scene());
  wanted_.film = std::exchange(opened_film_, nullptr);
  wanted_.samples = source();
  if (wanted_.film && !same_picture(*wanted_.scene, editor_.document().origin->saved))
    wanted_.film = nullptr;  // it was edited meanwhile
  if (split()) kept_scene_ = with_kept_settings(*wanted_.scene);
  const double changed_at = timer_.changed_at();
  timer_.on_send(now);
  if (!ask() || !log_) return;
  const bool camera_only = before && !change_between(*before, *wanted_.scene).others;
  log_->submitted(renderers_.edit(Half::current), changed_at, camera_only);
}

/// The one place where the renderers are asked for anything. Returns whether the current half begins another picture.
bool Session::ask() {
  wanted_.clean = clean();
  RenderRequest kept = wanted_;
  kept.scene = kept_scene_;
  kept.film = nullptr;
  RendererPair::Begun begun = renderers_.request(wanted_, kept);
  if (begun.current) accuracy_.set_scene(Half::current, wanted_.scene);
  if (begun.kept) accuracy_.set_scene(Half::kept, kept_scene_);
  if (begun.ended)
    saving_.run([second = std::move(begun.ended)]() mutable -> JobQueue::Result {
      second.reset();
      return {};
    });
  accuracy_.set_threads(wanted_.threads);
  accuracy_.set_resting(renderers_.resting());
  return begun.current;
}

/// A scene as the left half of the split view renders it.
std::shared_ptr<const Scene> Session::with_kept_settings(const Scene& scene) const {
  auto kept = std::make_shared<Scene>(scene);
  kept->render = kept_scene_->render;
  kept->render.spp = scene.render.spp;
  return kept;
}

void Session::shown(Half half, const std::shared_ptr<const Frame>& frame) {
  accuracy_.shown(half, frame, method(half), frame->edit == renderers_.edit(half));
  if (half == Half::current) pause_at_limits(*frame);
}

/// Pauses a picture once where the command line said so; another edit, or Space, goes on.
void Session::pause_at_limits(const Frame& frame) {
  const bool good = limits_.error > 0 && frame.relative_error <= limits_.error;
  const bool reached = frame.seconds >= limits_.seconds || good;
  if (!reached || frame.spp == 0 || frame.finished || frame.edit == limited_edit_ || wanted_.paused) return;
  limited_edit_ = frame.edit;
  wanted_.paused = true;
  messages_.say(frame.seconds >= limits_.seconds ? "paused at the time limit; Space goes on"
                                                 : "paused at the error that was asked for; Space goes on");
}

bool Session::collect() {
  bool came = loading_.collect();
  came = saving_.collect() || came;
  came = editor_.collect() || came;
  came = references_.collect() || came;
  came = tell_of_keeping() || came;
  came = collect_rows() || came;
  came = collect_problem() || came;
  const auto problem = renderers_.reply().problem;
  if (problem == told_problem_) return came;
  told_problem_ = problem;
  if (problem) messages_.say(problem->what, true);
  return true;
}

bool Session::at_rest() const {
  const bool known = !timer_.waits() && !editor_.file_changed() && (!picture_ || arrival_.ended);
  return known && renderers_.finished() && !references_.busy() && loading_.idle() && saving_.idle() &&
         !accuracy_.busy();
}

void Session::set_view(View view, ErrorView error) {
  wanted_.view = view;
  accuracy_.set_view(error);
}

namespace {

/// aside: where a damaged file was put; empty: it could not be moved.
std::string fate_of(const std::filesystem::path& aside) {
  return aside.empty() ? ", and the file cannot be moved out of the way"
                       : ", the file is now " + aside.filename().string();
}

}  // namespace

/// A damaged file is told of once, if it can be set aside.
void Session::read_preferences_file() {
  const std::filesystem::path file = preferences_file();
  const auto read = read_preferences(file);
  if (read)
    preferences_ = *read;
  else
    messages_.say(file.string() + " is damaged; the window begins with its defaults" + fate_of(set_aside(file)));
}

void Session::set_preferences(const Preferences& preferences) {
  if (preferences == preferences_) return;
  preferences_ = preferences;
  saving_.run([preferences]() -> JobQueue::Result {
    write_preferences(preferences_file(), preferences);
    return {};
  });
}

void Session::set_clean(bool clean) {
  Preferences changed = preferences_;
  changed.clean = clean;
  set_preferences(changed);
}

void Session::set_clean_beside_raw(bool beside) {
  beside_ = beside;
  if (beside) set_clean(true);
}

void Session::set_split(bool split) {
  if (split == this->split()) return;
  accuracy_.set_split(split);
  kept_scene_ = split ? std::make_shared<const Scene>(*rendered_scene()) : nullptr;
  if (split) ++wanted_.restarts;
}

void Session::keep_half(Half half) {
  Scene scene = half == Half::kept ? *with_kept_settings(editor_.scene()) : editor_.scene();
  set_split(false);
  editor_.edit(std::move(scene), 0);
}

std::string Session::method(Half half) const {
  if (shows_picture()) return editor_.document().origin->title;
  const RenderSettings& settings = half == Half::kept && split() ? kept_scene_->render : editor_.scene().render;
  return method_of(settings, editor_.document().origin->saved.render);
}

bool Session::can_show_errors() const {
  return accuracy_.split() || (accuracy_.reference() && accuracy_.fit(Half::current) != ReferenceFit::other_size);
}

void Session::render_reference() {
  const auto frame = renderers_.latest(Half::current);
  const bool newest = frame && frame->edit == renderers_.edit(Half::current) && !timer_.waits();
  if (!newest || frame->spp == 0) return messages_.say("there is no picture yet");
  constexpr std::uint32_t minimum = 64;
  const std::shared_ptr<const Scene> scene = rendered_scene();
  references_.render({*scene, std::max(minimum, frame->spp), wanted_.threads, isa_, "", *scene});
}

void Session::snapshot() {
  if (timer_.waits()) submit(clock_seconds());  // so that the snapshot shows the newest edit
  Document document = editor_.document();
  document.scene = *rendered_scene();
  const std::string stem = shows_picture() ? "image" : stem_of(document.origin->title);
  Snapshot snapshot{document, snapshots_.next_base(stem), isa_, wanted_.threads, !shows_picture()};
  messages_.say_until_done("saving " + snapshot.base.filename().string() + " …");
  const std::filesystem::path base = snapshot.base;
  const std::uint64_t edit = renderers_.edit(Half::current);
  snapshots_.write(base, [this, snapshot = std::move(snapshot), edit](const std::filesystem::path& free) mutable {
    Film film =
        wait_for_film([this] { return renderers_.film(); },
                      [this, edit] { return renderers_.edit(Half::current) == edit; }, [this] { return !closing_; });
    if (film.pixels.empty()) throw IoError("no snapshot: the picture was edited before it had a sample everywhere");
    snapshot.base = free;
    return write_snapshot(snapshot, std::move(film));
  });
}

void Session::export_chart() {
  const bool against = accuracy_.is_true();
  const std::shared_ptr<const Scene> scene = rendered_scene();
  const std::string stem = stem_of(editor_.document().origin->title);
  Chart chart;
  chart.curves = copies_of(accuracy_.named_curves());
  if (chart.curves.empty()) return messages_.say("there is no curve yet");
  chart.title = stem + (against ? ": true error against " + accuracy_.reference()->about : ": estimated error");
  const int threads = wanted_.threads;
  chart.subtitle = std::to_string(scene->width) + "x" + std::to_string(scene->height) + ", " + std::to_string(threads) +
                   (threads == 1 ? " thread" : " threads") +
                   (against ? "" : "; estimated from two halves of each pixel");
  const std::filesystem::path base = charts_.next_base(stem + "-chart");
  charts_.write(base, [chart = std::move(chart)](const std::filesystem::path& free) {
    write_chart(chart, free.string() + ".svg");
    return "saved " + free.filename().string() + ".csv and .svg";
  });
}

}  // namespace tyndall
