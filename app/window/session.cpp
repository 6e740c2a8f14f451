#include "app/window/session.h"

#include "app/curves/chart.h"
#include "app/window/accuracy/views.h"
#include "app/window/document/document.h"
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
                 UiLog* log_of_window)
    : isa_(options.isa),
      limits_(options.limits),
      kept_(state_folder(), wake),
      picture_(options.picture),
      function_(options.function),
      log(log_of_window),
      messages(log),
      accuracy(wake),
      renderers(thread_count(options.threads).count, options.isa, std::move(on_frame)),
      editor(
          options.scene,
          !options.reload ? std::function<LoadedScene()>()
                          : [this, reload = options.reload] { return reload([this] { return !closing_; }); },
          {[this] { timer.on_change(input_time > 0 ? input_time : clock_seconds()); },
           [this] { accuracy.clear(), set_split(false); },
           [isa = options.isa](const LoadedScene& loaded) { return read_opened_film(loaded, isa); },
           [this](std::shared_ptr<Film> film) {
             opened_film_ = std::move(film);
             timer.on_change(clock_seconds());
           },
           wake},
          loading_, messages, log),
      references(
          editor,
          [this] {
            return Document{*rendered_scene(), editor.document().origin};
          },
          accuracy, messages, wake),
      snapshots_({".png", ".exr"}, saving, messages, log),
      charts_({".csv", ".svg"}, saving, messages, log),
      loading_(wake),
      saving(wake) {
  wanted.threads = thread_count(options.threads).count;
  read_preferences_file();
  if (!options.scene.is_picture) restore_edits(options);
  timer.on_change(clock_seconds());
  submit(clock_seconds());
  if (isa_.empty() && !slow_build_warning().empty()) messages.say_until_done(slow_build_warning());
  if (options.scene.source.empty()) editor.open_film(options.scene);
  if (picture_) picture_->start(wake);
  if (function_) function_->set_on_news(wake);
}

/// The scene as the renderers get it.
std::shared_ptr<const Scene> Session::rendered_scene() {
  std::shared_ptr<const Scene> scene = editor.shared();
  if (!picture_size_ || *picture_size_ == PictureSize{scene->width, scene->height}) return scene;
  auto sized = std::make_shared<Scene>(*scene);
  sized->width = picture_size_->width, sized->height = picture_size_->height;
  return sized;
}

void Session::set_picture_size(std::optional<PictureSize> size) {
  if (size == picture_size_) return;
  picture_size_ = size;
  wanted.refine_first = {};  // its pixels are others now
  timer.on_change(clock_seconds());
}

Session::~Session() {
  closing_ = true;
  if (picture_) picture_->stop();
  if (function_) function_->set_on_news({});
}

std::string Session::finish_files() {
  closing_ = true;
  const int errors = messages.errors();
  std::string problems;
  while (!saving.idle()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const int before = messages.errors();
    saving.collect();
    if (messages.errors() > before) problems += (problems.empty() ? "" : "; ") + messages.current().text;
  }
  return messages.errors() > errors ? problems : "";
}

bool Session::send(double now, bool scene_too) {
  const std::uint64_t edit = renderers.edit(Half::current);
  const auto frame = renderers.latest(Half::current);
  const bool seen = edit == 0 || (frame && frame->edit >= edit);
  const bool due = scene_too && timer.due(seen, now);
  due ? submit(now) : static_cast<void>(ask());
  keep_edits();
  return due;
}

/// The edited scene is wanted from now on.
void Session::submit(double now) {
  if (std::exchange(limited_edit_, 0) > 0) wanted.paused = false;
  const auto before = std::exchange(wanted.scene, rendered_scene());
  wanted.film = std::exchange(opened_film_, nullptr);
  wanted.samples = source();
  if (wanted.film && !same_picture(*wanted.scene, editor.document().origin->saved))
    wanted.film = nullptr;  // it was edited meanwhile
  if (split()) kept_scene_ = with_kept_settings(*wanted.scene);
  const double changed_at = timer.changed_at();
  timer.on_send(now);
  if (!ask() || !log) return;
  const bool camera_only = before && !change_between(*before, *wanted.scene).others;
  log->submitted(renderers.edit(Half::current), changed_at, camera_only);
}

/// The one place where the renderers are asked for anything. Returns whether the current half begins another picture.
bool Session::ask() {
  wanted.clean = clean();
  RenderRequest kept = wanted;
  kept.scene = kept_scene_;
  kept.film = nullptr;
  RendererPair::Begun begun = renderers.request(wanted, kept);
  if (begun.current) accuracy.set_scene(Half::current, wanted.scene);
  if (begun.kept) accuracy.set_scene(Half::kept, kept_scene_);
  if (begun.ended)
    saving.run([second = std::move(begun.ended)]() mutable -> JobQueue::Result {
      second.reset();
      return {};
    });
  accuracy.set_threads(wanted.threads);
  accuracy.set_resting(renderers.resting());
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
  const bool newest = frame->edit == renderers.edit(half);
  accuracy.shown(half, frame, method(half), newest);
  if (half == Half::current && newest) pause_at_limits(*frame);
}

/// Pauses a picture once where the command line said so; another edit, or Space, goes on.
void Session::pause_at_limits(const Frame& frame) {
  const bool good = limits_.error > 0 && frame.relative_error <= limits_.error;
  const bool reached = frame.seconds >= limits_.seconds || good;
  if (!reached || frame.spp == 0 || frame.finished || frame.edit == limited_edit_ || wanted.paused) return;
  limited_edit_ = frame.edit;
  wanted.paused = true;
  messages.say(frame.seconds >= limits_.seconds ? "paused at the time limit; Space goes on"
                                                : "paused at the error that was asked for; Space goes on");
}

bool Session::collect() {
  // All of them, one after another.
  const bool came = std::max({loading_.collect(), saving.collect(), editor.collect(), references.collect(),
                              tell_of_keeping(), collect_rows(), collect_problem()});
  const auto problem = renderers.reply().problem;
  if (problem == told_problem_) return came;
  told_problem_ = problem;
  if (problem) messages.say(problem->what, true);
  return true;
}

bool Session::at_rest() const {
  const bool known = !timer.waits() && !editor.file_changed() && (!picture_ || arrival_.ended);
  return known && renderers.finished() && !references.busy() && loading_.idle() && saving.idle() && !accuracy.busy();
}

void Session::show_view(int number) {
  view_ = number;
  wanted.view = view_entry(number).view;
  accuracy.set_view(view_entry(number).error);
}

/// A damaged file is told of once, if it can be set aside.
void Session::read_preferences_file() {
  const std::filesystem::path file = preferences_file();
  if (const auto read = read_preferences(file)) {
    preferences = kept_preferences_ = *read;
    return;
  }
  const std::string aside = set_aside(file).filename().string();
  messages.say(file.string() + " is damaged; the window begins with its defaults" +
               (aside.empty() ? ", and the file cannot be moved out of the way" : ", the file is now " + aside));
}

void Session::keep_preferences() {
  if (preferences == kept_preferences_) return;
  kept_preferences_ = preferences;
  saving.run([now = preferences]() -> JobQueue::Result {
    write_preferences(preferences_file(), now);
    return {};
  });
}

void Session::set_clean_beside_raw(bool beside) {
  beside_ = beside;
  if (beside) preferences.clean = true;
}

void Session::set_split(bool split) {
  if (split == this->split()) return;
  accuracy.set_split(split);
  kept_scene_ = split ? std::make_shared<const Scene>(*rendered_scene()) : nullptr;
  if (split) ++wanted.restarts;
}

void Session::keep_half(Half half) {
  Scene scene = half == Half::kept ? *with_kept_settings(editor.scene()) : editor.scene();
  set_split(false);
  editor.edit(std::move(scene), 0);
}

std::string Session::method(Half half) const {
  if (shows_picture()) return editor.document().origin->title;
  const RenderSettings& settings = half == Half::kept && split() ? kept_scene_->render : editor.scene().render;
  return method_of(settings, editor.document().origin->saved.render);
}

bool Session::can_show_errors() const {
  return accuracy.split() || (accuracy.reference() && accuracy.fit(Half::current) != ReferenceFit::other_size);
}

void Session::render_reference() {
  const auto frame = renderers.latest(Half::current);
  const bool newest = frame && frame->edit == renderers.edit(Half::current) && !timer.waits();
  if (!newest || frame->spp == 0) return messages.say("there is no picture yet");
  constexpr std::uint32_t minimum = 64;
  const std::shared_ptr<const Scene> scene = rendered_scene();
  references.render({*scene, std::max(minimum, frame->spp), wanted.threads, isa_, "", *scene});
}

void Session::snapshot() {
  if (timer.waits()) submit(clock_seconds());  // so that the snapshot shows the newest edit
  Document document = editor.document();
  document.scene = *rendered_scene();
  const std::string stem = shows_picture() ? "image" : stem_of(document.origin->title);
  Snapshot snapshot{document, snapshots_.next_base(stem), isa_, wanted.threads, !shows_picture()};
  messages.say_until_done("saving " + snapshot.base.filename().string() + " …");
  const std::filesystem::path base = snapshot.base;
  const std::uint64_t edit = renderers.edit(Half::current);
  snapshots_.write(base, [this, snapshot = std::move(snapshot), edit](const std::filesystem::path& free) mutable {
    Film film =
        wait_for_film([this] { return renderers.film(); },
                      [this, edit] { return renderers.edit(Half::current) == edit; }, [this] { return !closing_; });
    if (film.pixels.empty()) throw IoError("no snapshot: the picture was edited before it had a sample everywhere");
    snapshot.base = free;
    return write_snapshot(snapshot, std::move(film));
  });
}

void Session::export_chart() {
  const bool against = accuracy.is_true();
  const std::shared_ptr<const Scene> scene = rendered_scene();
  const std::string stem = stem_of(editor.document().origin->title);
  Chart chart;
  for (const NamedCurve& one : accuracy.named_curves())
    if (!one.curve->points.empty()) chart.curves.push_back({one.name, one.curve->points, one.curve->edit});
  if (chart.curves.empty()) return messages.say("there is no curve yet");
  chart.title = stem + (against ? ": true error against " + accuracy.reference()->about : ": estimated error");
  const int threads = wanted.threads;
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
