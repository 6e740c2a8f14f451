#include "app/window/main_window.h"

#include "app/window/accuracy/views.h"
#include "core/scene/place.h"
#include "core/system/process.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace tyndall {
namespace {

/// Seconds for which the screen stays as it is, because the picture of the newest edit is about to come.
constexpr double longest_await = 0.04;

/// What opens the scene again, as the list of recent files has it.
std::string what_of(const Origin& origin) {
  std::error_code ignored;
  return origin.file.empty() ? origin.what : std::filesystem::absolute(origin.file, ignored).string();
}

std::unique_ptr<UiLog> open_log(const std::filesystem::path& file) {
  return file.empty() ? nullptr : std::make_unique<UiLog>(file);
}

}  // namespace

void FrameAlarm::on_frame(Platform& platform) {
  if (clock_seconds() >= due && !rang.exchange(true)) platform.wake();
}

MainWindow::MainWindow(const WindowOptions& options, std::shared_ptr<const Reference> reference,
                       std::unique_ptr<Platform> platform)
    : log_(open_log(options.ui_log)),
      platform_(std::move(platform)),
      session_(
          options, wake_, [this] { alarm_.on_frame(*platform_); }, log_.get()),
      picture_(session_.renderers(), session_.accuracy()),
      appearance_(*platform_, session_, ui_),
      objects_(session_, panels_, tools_.gestures, pacing_),
      picture_tools_(session_, panels_, tools_.gestures, pacing_, wake_),
      commands_(session_, *platform_, panels_, pacing_, tools_.gestures, objects_, picture_tools_, strip_, timeline_,
                log_.get()) {
  ui_.log = log_.get();
  panels_.model.scenes = built_in_scenes();
  panels_.model.accuracy = &session_.accuracy();
  panels_.model.pictures = &gallery_.pictures();
  panels_.look = session_.preferences();
  ui_.folded = panels_.look.folded;
  ui_.folded.insert("Histogram");  // it takes time with each picture
  if (!options.hosted) signals_.emplace(WatchedSignals::window, wake_);
  if (log_) log_commands(*log_);
  if (reference) session_.references().set(std::move(reference));
  if (options.reference_scene) session_.render_reference(*options.reference_scene);
}

/// Asks the renderers for what is wanted now, see Session. Returns whether that is a new edit.
bool MainWindow::send(double now, bool scene_too) {
  session_.send(now, scene_too);
  const std::uint64_t edit = session_.renderers().edit(Half::current);
  if (edit == paced_edit_) return false;
  pacing_.on_edit(paced_edit_ = edit, now);
  return true;
}

/// Whether the picture of an edit is so near that drawing the window before would only hold it up.
bool MainWindow::awaits_picture(double now) const { return now < awaits_until_; }

bool MainWindow::picture_due(double now) const {
  const auto frame = picture_.unseen();
  if (!frame || now < pacing_.next_drawing()) return false;
  return now >= pacing_.picture_due() || frame->finished;
}

bool MainWindow::hidden() const {
  const WindowSize size = platform_->size();
  return size.framebuffer_width <= 0 || size.framebuffer_height <= 0;
}

double MainWindow::waiting_time(double now) {
  if (takes_in_again_) return 0;
  const double sends = std::max(0.0, session_.send_time() - now);
  if (hidden()) {  // nothing to draw until an event shows the window again
    alarm_.due = std::numeric_limits<double>::infinity();
    return sends;
  }
  // The order matters: a frame that comes from here on, after its time, wakes the window. One that came before is seen
  // below. One that comes in between is seen when its time has come.
  const double due = std::max(pacing_.picture_due(), pacing_.next_drawing());
  alarm_.due = due;
  const auto frame = picture_.unseen();
  double wait = std::max(pacing_.wait(now), awaits_until_ - now);
  if (frame)
    wait = std::min(wait, std::max(0.0, (frame->finished ? pacing_.next_drawing() : due) - now));
  else if (due > now)
    wait = std::min(wait, due - now);
  return std::min(wait, sends);
}

/// What the user changed about the window's look is remembered, once no button is held any more.
void MainWindow::use_preferences() {
  Preferences look = panels_.look;
  look.clean = session_.preferences().clean;
  look.folded.clear();
  for (const char* section : lasting_sections())
    if (ui_.folded.contains(section)) look.folded.insert(section);
  if (!read_mouse().any_down()) session_.set_preferences(look);
}

/// What was opened or saved is among the recent files from then on.
void MainWindow::note_files() {
  if (session_.shows_picture()) return;
  const std::shared_ptr<const Origin>& origin = session_.editor().document().origin;
  if (std::exchange(noted_, origin) == origin) return;
  gallery_.note_file(origin->what);
}

void MainWindow::draw(double now) {
  const double cpu_before = thread_cpu_seconds();
  pacing_.on_drawing();
  if (hidden()) {
    platform_->skip_frame();
    send(now);
    return pacing_.on_drawn(now);
  }
  note_files();
  appearance_.update(panels_.look, gallery_.recent());
  platform_->begin_frame();
  ui_.wake_in = 1e300;
  ui_.has_question = commands_.has_dialog();
  ui_.problem.clear();
  ui_.close_popup = std::exchange(panels_.close_popup, false);
  const bool fresh = picture_due(now);
  for (const Half half : {Half::current, Half::kept})
    if (const auto frame = fresh ? picture_.take(half) : nullptr) session_.shown(half, frame);
  // The old picture keeps its shape until the new one is there.
  const Scene& scene = session_.editor().scene();
  const Frame* shown = picture_.shown().get();
  const WindowSize size = platform_->size();
  Layout layout = layout_for(size, shown ? shown->width : scene.width, shown ? shown->height : scene.height);
  const float dots = static_cast<float>(size.framebuffer_width) / static_cast<float>(std::max(1, size.width));
  follow_window_size(size, dots);
  picture_tools_.place(layout, dots);
  session_.wanted().shown_pixels = std::llround(layout.image.width() * layout.image.height() * dots * dots);
  session_.set_input_time(std::exchange(input_since_, 0));
  fill_panels();
  draw_interface(layout);
  use_mouse_and_keys(layout, now);
  apply_panels(now);
  session_.set_input_time(0);
  session_.wanted().watched_pixel = picture_tools_.watched_pixel();
  if (!fresh) picture_.note_shown();  // the one before; if a newer scene is sent now, the workers begin with that
  if (send(now, !fresh) && !fresh) {
    awaits_until_ = now + longest_await;
    return platform_->drop_frame();
  }
  const std::string problem = picture_.show(*platform_, layout, shown_state());
  if (!problem.empty()) session_.messages().say(problem, true);
  finish_drawing(now, cpu_before, fresh);
  awaits_until_ = 0;
  takes_in_again_ = fresh && std::isfinite(session_.send_time());
  if (!takes_in_again_) picture_.note_shown();  // else once the newer scene is ready
}

/// Where things are for a picture of that shape.
Layout MainWindow::layout_for(const WindowSize& size, int image_width, int image_height) const {
  const float column = commands_.shows_panels() ? static_cast<float>(panels_.look.column) : 0;
  const auto width = static_cast<float>(size.width), height = static_cast<float>(size.height);
  const float shown = std::min(std::round(column * ui_.scale), std::floor(width / 2));
  return make_layout(width, height, image_width, image_height, ui_.scale, column,
                     strip_.height(width - shown, image_width, image_height, ui_.scale) +
                         Timeline::height(session_.editor().scene(), ui_.scale));
}

/// Renders as many pixels as the window shows of the picture, where the user wants that.
void MainWindow::follow_window_size(const WindowSize& size, float dots) {
  const Scene& scene = session_.editor().scene();
  const Rect image = layout_for(size, scene.width, scene.height).image;
  const PictureSize shown{static_cast<int>(std::lround(image.width() * dots)),
                          static_cast<int>(std::lround(image.height() * dots))};
  const bool seen = shown.width > 0 && shown.height > 0;
  const bool follows = panels_.model.at_window && seen && !session_.shows_picture();
  session_.set_picture_size(follows ? std::optional(shown) : std::nullopt);
}

ShownState MainWindow::shown_state() const {
  ShownState state{session_.editor().scene().display, view_entry(panels_.model.view).stops,
                   picture_tools_.shows_pixels(), session_.split(), session_.clean_beside_raw()};
  if (state.split) state.method = session_.method(Half::current), state.kept_method = session_.method(Half::kept);
  return state;
}

void MainWindow::fill_panels() {
  panels_.scene = EditedScene(session_.editor().shared());
  panels_.model.frame = picture_.shown();
  panels_.model.saved = &session_.editor().document().origin->saved;
  const std::string& title = session_.editor().document().origin->title;
  if (panels_.model.title != title) forget_scene(panels_);
  panels_.model.title = title;
  panels_.model.what = what_of(*session_.editor().document().origin);
  panels_.model.recent = gallery_.recent();
  panels_.model.has_scene = !session_.shows_picture();
  panels_.model.renders = session_.renders();
  panels_.model.threads = session_.wanted().threads;
  panels_.model.kept_method = session_.split() ? session_.method(Half::kept) : "";
  panels_.model.clean = session_.clean() ? (session_.clean_beside_raw() ? 2 : 1) : 0;
  panels_.model.can_show_errors = session_.can_show_errors();
  panels_.wanted_pictures.clear();
  ui_.size = target_distance(panels_.scene->camera);
  set_selected(panels_, session_.editor().selection());
}

void MainWindow::draw_interface(const Layout& layout) {
  draw_column(ui_, panels_, layout.column);
  objects_.draw(ui_, layout);
  picture_.draw_halves(ui_, overlap(layout.image, layout.area), shown_state());
  picture_tools_.draw(ui_, layout);
  const LiveAccuracy& accuracy = session_.accuracy();
  draw_status(
      ui_, layout.status,
      status_cells(
          panels_.model.frame.get(), accuracy.curves(Half::current).current(), session_.editor().document(),
          {session_.wanted().paused, accuracy.is_true(), session_.split(), session_.editor().edited(),
           &accuracy.curves(Half::current, Kind::clean).current(), session_.arrived(), !session_.shows_picture()}));
  draw_message(ui_, layout.area, session_.messages().current());
  const float film = Timeline::height(session_.editor().scene(), ui_.scale);
  draw_timeline({layout.strip.x0, layout.strip.y0, layout.strip.x1, layout.strip.y0 + film}, clock_seconds());
  draw_strip({layout.strip.x0, layout.strip.y0 + film, layout.strip.x1, layout.strip.y1});
  commands_.draw(ui_, layout.area);
  if (!ui_.log) return;
  ui_.log->widget("picture", layout.image, title_of(*panels_.scene, panels_.selected));
  ui_.log->end_of_widgets();
}

/// The bar of the film, and the frame that it goes to: the scene then has that frame's values.
void MainWindow::draw_timeline(const Rect& rect, double now) {
  const Editor& editor = session_.editor();
  const bool held = read_mouse().any_down();
  const TimelineWish wish = timeline_.draw(ui_, rect, editor.scene(), now);
  if (!wish.frame && !wish.remove) {
    if (!held && !timeline_.plays()) film_gesture_ = 0;
    return;
  }
  try {
    if (film_gesture_ == 0 || wish.remove) film_gesture_ = tools_.gestures.begin();
    Scene scene = wish.frame ? at_frame_with_keys(editor.scene(), *wish.frame) : editor.scene();
    if (wish.remove) remove_keys(scene, timeline_.frame());
    session_.editor().edit(std::move(scene), film_gesture_);
  } catch (const ParseError& error) {
    timeline_.stop();
    session_.messages().say(error.where + ": found " + error.found + ", expected " + error.expected, true);
  }
  panels_.scene = EditedScene(session_.editor().shared());
}

/// The strip, and what is taken over from it.
void MainWindow::draw_strip(const Rect& rect) {
  if (!strip_.is_open()) {
    strip_gesture_ = 0;
    return;
  }
  const WindowSize size = platform_->size();
  const float dots = static_cast<float>(size.framebuffer_width) / static_cast<float>(std::max(1, size.width));
  const Editor& editor = session_.editor();
  const double again = strip_.update({editor.scene(), editor.changes(), !read_mouse().any_down() && !timeline_.plays(),
                                      session_.clean(), session_.wanted().threads, dots, clock_seconds()},
                                     rect, ui_.scale);
  ui_.wake_in = std::min(ui_.wake_in, again);
  auto taken = strip_.draw(ui_, rect, editor.scene());
  if (!taken) return;
  move_linked_objects(editor.scene(), editor.scene(), *taken);
  if (strip_gesture_ == 0) strip_gesture_ = tools_.gestures.begin();
  session_.editor().edit(std::move(*taken), strip_gesture_);
  panels_.scene = EditedScene(session_.editor().shared());
}

void MainWindow::use_mouse_and_keys(const Layout& layout, double now) {
  const Mouse mouse = read_mouse();
  if (log_) log_->mouse(mouse);
  const std::set<int>& held = platform_->held();
  PointerTool& pointer = tools_.pointer;
  const bool holds = mouse.any_down() || holds_fly_key(held) || objects_.active();
  const bool rotates = pointer.is_turning(mouse, layout, now);
  tools_.gestures.update(holds ? Gesture::held : rotates ? Gesture::wheel : Gesture::none);
  const bool free = !mouse.taken && !pointer.is_pressed() && !commands_.has_question();
  const bool looks = !objects_.active() && picture_tools_.use_mouse(mouse, layout, free);
  const Rect visible = overlap(layout.image, layout.area);
  const bool divides = !looks && !objects_.active() && picture_.drag_divider(ui_, visible, mouse, free, shown_state());
  const bool arranges =
      !looks && !divides && objects_.use_mouse(mouse, layout, ui_.scale, free && !commands_.shows_menu());
  if (!looks && !divides && !arranges) {
    const bool opens = !commands_.has_question() && !commands_.shows_menu();
    Camera camera = panels_.scene->camera;
    const PressedButton clicked = pointer.update(mouse, layout, ui_.scale, opens, now, camera);
    set_camera(camera);
    if (clicked != PressedButton::none && objects_.click(layout, mouse, clicked)) ui_.requests.push_back({"menu"});
  }
  const bool grounded = mouse.control || objects_.active() || session_.shows_picture();
  Camera camera = panels_.scene->camera;
  const bool flies = tools_.flight.update(grounded ? std::set<int>{} : held, platform_->shift_held(), now, camera);
  if (flies) pacing_.wake_at(now + min_frame_interval);
  set_camera(camera);
}

void MainWindow::set_camera(const Camera& camera) {
  if (!(camera == panels_.scene->camera)) panels_.scene.change().camera = camera;
}

/// Hands what the drawing has changed of the scene to the editor.
void MainWindow::take_edit() {
  Editor& editor = session_.editor();
  if (!panels_.scene.is_changed()) return;
  const std::string pointer = panels_.scene.pointer();
  const std::uint64_t gesture = tools_.gestures.current();
  Scene next = panels_.scene.take();
  if (session_.shows_picture()) {  // without a scene, how it is displayed is all that can be changed
    const Display display = next.display;
    next = editor.scene();
    next.display = display;
  }
  if (pointer.empty() || pointer.starts_with("/objects/")) tools_.start.finish_edit(editor.shared(), next, gesture);
  editor.edit(std::move(next), gesture, pointer);
}

void MainWindow::apply_panels(double now) {
  take_edit();
  session_.editor().select(all_selected(panels_));
  if (!ui_.problem.empty()) session_.messages().say(ui_.problem, true);
  commands_.carry_out(ui_);
  gallery_.want(panels_.wanted_pictures);
  use_preferences();
  if (shows_errors(panels_.model.view) && !session_.can_show_errors())
    commands_.act({std::string("view: ") + view_entry(0).name});
  keep_message(now);
  if (ui_.wake_in < 1e299) pacing_.wake_at(now + ui_.wake_in);
  const Document& document = session_.editor().document();
  platform_->set_title(document.origin->title +
                       (session_.editor().edited() && !session_.shows_picture() ? " (edited)" : "") + " – Tyndall");
}

/// Takes a message off the screen when its time has come; errors stay.
void MainWindow::keep_message(double now) {
  const Message& message = session_.messages().current();
  if (message.text.empty() || message.error) return;
  if (now < message.until) return pacing_.wake_at(message.until);
  session_.messages().dismiss();
  pacing_.on_event();  // draws once more, because this drawing still shows the message
}

void MainWindow::finish_drawing(double now, double cpu_before, bool fresh) {
  pacing_.on_drawn(now);
  const double after = clock_seconds();
  const Frame* shown = fresh ? picture_.shown().get() : nullptr;
  if (shown) pacing_.on_picture(shown->edit, after);
  if (!log_) return;
  if (shown) log_->shown(*shown, after);
  const WindowSize size = platform_->size();
  log_->changed("size", std::to_string(size.width) + " " + std::to_string(size.height));
  log_->drawn(thread_cpu_seconds() - cpu_before, fresh);
}

}  // namespace tyndall
