#include "app/window/main_window.h"

#include "app/window/accuracy/views.h"
#include "core/scene/place.h"
#include "core/system/process.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace tyndall {
namespace {

/// Seconds for which the screen stays as it is, because the picture of the newest edit is about to come.
constexpr double longest_await = 0.04;

}  // namespace

MainWindow::MainWindow(const WindowOptions& options, std::shared_ptr<const Reference> reference,
                       std::unique_ptr<Platform> platform)
    : log_(options.ui_log.empty() ? nullptr : std::make_unique<UiLog>(options.ui_log)),
      platform_(std::move(platform)),
      session_(
          options, wake_,
          [this] {
            if (clock_seconds() >= frame_due_ && !frame_rang_.exchange(true)) platform_->wake();
          },
          log_.get()),
      picture_(session_.renderers, session_.accuracy),
      objects_(session_, panels_),
      picture_tools_(session_, panels_, wake_),
      commands_(session_, *platform_, ui_, panels_, objects_, picture_tools_, strip_, timeline_) {
  ui_.log = log_.get();
  panels_.now.scenes = built_in_scenes();
  panels_.look = &session_.preferences;
  ui_.folded = panels_.look->folded;
  for (const Section& one : column_sections())
    if (one.is(starts_folded)) ui_.folded.insert(one.heading);
  if (!options.hosted) signals_.emplace(WatchedSignals::window, wake_);
  if (log_) log_commands(*log_);
  if (reference) session_.references.set(std::move(reference));
  if (options.reference_scene) session_.render_reference(*options.reference_scene);
}

void MainWindow::draw(double now) {
  const double cpu_before = thread_cpu_seconds();
  session_.pacing.on_drawing();
  if (hidden()) {
    platform_->skip_frame();
    send(now);
    return session_.pacing.on_drawn(now);
  }
  const std::shared_ptr<const Origin>& origin = session_.editor.document().origin;
  if (!session_.shows_picture() && std::exchange(noted_, origin) != origin) gallery_.note_file(origin->what);
  update_look();
  platform_->begin_frame();
  ui_.wake_in = 1e300;
  ui_.has_question = commands_.has_dialog();
  ui_.problem.clear();
  const bool fresh = picture_due(now);
  for (const Half half : {Half::current, Half::kept})
    if (const auto frame = fresh ? picture_.take(half) : nullptr) session_.shown(half, frame);
  panels_.now = context(now);
  panels_.scene = EditedScene(session_.editor.shared());
  panels_.set_value = [this, fresh](const std::string& pointer, const Value& value) {
    set_value(pointer, value, !fresh);
  };
  panels_.wanted_pictures.clear();
  ui_.size = target_distance(panels_.scene->camera);
  set_selected(panels_, session_.editor.selection());
  follow_window_size();
  const Context& context = panels_.now;
  const Rect& image = context.layout.image;
  session_.wanted.shown_pixels = std::llround(image.width() * image.height() * context.dots * context.dots);
  session_.input_time = std::exchange(input_since_, 0);
  const std::uint64_t edit_before = paced_edit_;
  const Mouse mouse = read_mouse();
  const bool holds = mouse.any_down() || holds_fly_key(platform_->held()) || objects_.active();
  const bool rotates = pointer_.is_turning(mouse, context.layout, now);
  session_.editor.gestures.update(holds ? Gesture::held : rotates ? Gesture::wheel : Gesture::none);
  draw_interface();
  use_mouse_and_keys(now);
  apply_panels(now);
  session_.input_time = 0;
  session_.wanted.watched_pixel = picture_tools_.inspector.watched_pixel();
  send(now, !fresh);
  if (paced_edit_ != edit_before && !fresh) {
    awaits_until_ = now + longest_await;
    return platform_->drop_frame();
  }
  const std::string problem = picture_.show(*platform_, context, session_.editor.scene().display);
  if (!problem.empty()) session_.messages.say(problem, true);
  finish_drawing(now, cpu_before, fresh);
  awaits_until_ = 0;
  takes_in_again_ = fresh && std::isfinite(session_.timer.latest());
  if (!takes_in_again_) picture_.note_shown();  // else once the newer scene is ready
}

/// What this drawing goes by. The old picture keeps its shape until the new one is there.
Context MainWindow::context(double now) {
  const Editor& editor = session_.editor;
  const LiveAccuracy& accuracy = session_.accuracy;
  const WindowSize size = platform_->size();
  Context context;
  context.frame = picture_.shown();
  const int width = context.frame ? context.frame->width : editor.scene().width,
            height = context.frame ? context.frame->height : editor.scene().height;
  context.dots = static_cast<float>(size.framebuffer_width) / static_cast<float>(std::max(1, size.width));
  context.layout = layout_for(size, width, height);
  context.layout.image = picture_tools_.place(context.layout, width, height, context.dots);
  context.visible = overlap(context.layout.image, context.layout.area);
  context.seconds = now;
  context.calm = !read_mouse().any_down() && !timeline_.plays();
  context.origin = editor.document().origin;
  if (context.origin->title != panels_.now.origin->title) forget_scene(panels_);
  std::error_code ignored;
  context.what = context.origin->file.empty() ? context.origin->what
                                              : std::filesystem::absolute(context.origin->file, ignored).string();
  context.changes = editor.changes();
  context.edited = editor.edited();
  context.has_scene = !session_.shows_picture();
  context.renders = session_.renders();
  context.arrived = session_.arrived();
  context.wanted = session_.wanted;
  context.squares = picture_tools_.shows_pixels();
  context.view = session_.view();
  context.clean = session_.clean() ? (session_.clean_beside_raw() ? 2 : 1) : 0;
  context.split = session_.split();
  context.method = session_.method(Half::current), context.kept_method = session_.method(Half::kept);
  context.accuracy = &accuracy;
  context.is_true = accuracy.is_true();
  context.run = &accuracy.curves(Half::current).current();
  context.clean_run = &accuracy.curves(Half::current, Kind::clean).current();
  context.can_show_errors = session_.can_show_errors();
  context.scenes = std::move(panels_.now.scenes);
  context.recent = gallery_.recent();
  context.pictures = &gallery_.pictures();
  return context;
}

void MainWindow::draw_interface() {
  const Context& context = panels_.now;
  draw_column(ui_, panels_, context.layout.column);
  objects_.draw(ui_);
  picture_.draw_halves(ui_, context);
  picture_tools_.draw(ui_);
  draw_status(ui_, context.layout.status, status_cells(context, session_.editor.scene()));
  draw_message(ui_, context.layout.area, session_.messages.current());
  const Rect& strip = context.layout.strip;
  const float film = Timeline::height(session_.editor.scene(), ui_.scale);
  draw_timeline({strip.x0, strip.y0, strip.x1, strip.y0 + film});
  draw_strip({strip.x0, strip.y0 + film, strip.x1, strip.y1});
  commands_.draw(context.layout.area);
  if (!ui_.log) return;
  ui_.log->widget("picture", context.layout.image, title_of(*panels_.scene, panels_.selected));
  ui_.log->end_of_widgets();
}

/// The bar of the film, and the frame that it goes to: the scene then has that frame's values.
void MainWindow::draw_timeline(const Rect& rect) {
  const Editor& editor = session_.editor;
  const bool held = read_mouse().any_down();
  const TimelineWish wish = timeline_.draw(ui_, rect, editor.scene(), clock_seconds());
  if (!wish.frame && !wish.remove) {
    if (!held && !timeline_.plays()) film_gesture_ = 0;
    return;
  }
  try {
    if (film_gesture_ == 0 || wish.remove) film_gesture_ = session_.editor.gestures.begin();
    Scene scene = wish.frame ? at_frame_with_keys(editor.scene(), *wish.frame) : editor.scene();
    if (wish.remove) remove_keys(scene, timeline_.frame());
    session_.editor.edit(std::move(scene), film_gesture_);
  } catch (const ParseError& error) {
    timeline_.stop();
    session_.messages.say(error.where + ": found " + error.found + ", expected " + error.expected, true);
  }
  panels_.scene.show(session_.editor.shared());
}

/// The strip, and what is taken over from it.
void MainWindow::draw_strip(const Rect& rect) {
  if (!strip_.is_open()) {
    strip_gesture_ = 0;
    return;
  }
  const Editor& editor = session_.editor;
  auto taken = strip_.draw(ui_, panels_.now, rect, editor.scene());
  if (!taken) return;
  move_linked_objects(editor.scene(), editor.scene(), *taken);
  if (strip_gesture_ == 0) strip_gesture_ = session_.editor.gestures.begin();
  session_.editor.edit(std::move(*taken), strip_gesture_);
  panels_.scene.show(session_.editor.shared());
}

void MainWindow::use_mouse_and_keys(double now) {
  const Layout& layout = panels_.now.layout;
  const Mouse mouse = read_mouse();
  if (log_) log_->mouse(mouse);
  const bool free = !mouse.taken && !pointer_.is_pressed() && !commands_.has_question();
  const bool looks = !objects_.active() && picture_tools_.use_mouse(mouse, free);
  const bool divides = !looks && !objects_.active() && picture_.drag_divider(ui_, mouse, free, panels_.now);
  const bool arranges = !looks && !divides && objects_.use_mouse(mouse, ui_.scale, free && !commands_.shows_menu());
  if (!looks && !divides && !arranges) {
    const bool opens = !commands_.has_question() && !commands_.shows_menu();
    Camera camera = panels_.scene->camera;
    const PressedButton clicked = pointer_.update(mouse, layout, ui_.scale, opens, now, camera);
    set_camera(camera);
    if (clicked != PressedButton::none && objects_.click(mouse, clicked)) ui_.requests.push_back({"menu"});
  }
  const bool grounded = mouse.control || objects_.active() || session_.shows_picture();
  Camera camera = panels_.scene->camera;
  const bool flies = flight_.update(grounded ? std::set<int>{} : platform_->held(), now, camera);
  if (flies) session_.pacing.wake_at(now + min_frame_interval);
  set_camera(camera);
}

void MainWindow::set_camera(const Camera& camera) {
  if (!(camera == panels_.scene->camera)) panels_.scene.change().camera = camera;
}

/// Sets a value of the scene, and asks for its picture before anything else is drawn. scene_too: see Session::send.
void MainWindow::set_value(const std::string& pointer, const Value& value, bool scene_too) {
  take_edit();
  put_value(panels_.scene.change(), pointer, value);
  take_edit(pointer);
  send(panels_.now.seconds, scene_too);
  panels_.now.wanted = session_.wanted;
}

/// Hands what the drawing has changed of the scene to the editor; what is drawn next shows what that has made of it.
/// pointer: see Editor::edit.
void MainWindow::take_edit(const std::string& pointer) {
  Editor& editor = session_.editor;
  std::optional<Scene> next = panels_.scene.take();
  if (!next) return;
  const std::uint64_t gesture = editor.gestures.current();
  if (session_.shows_picture()) {  // without a scene, how it is displayed is all that can be changed
    const Display display = next->display;
    next = editor.scene();
    next->display = display;
  }
  if (pointer.empty() || pointer.starts_with("/objects/")) start_.finish_edit(editor.shared(), *next, gesture);
  editor.edit(std::move(*next), gesture, pointer);
  panels_.scene.show(editor.shared());
}

void MainWindow::apply_panels(double now) {
  take_edit();
  session_.editor.select(all_selected(panels_));
  if (!ui_.problem.empty()) session_.messages.say(ui_.problem, true);
  for (const Request& request : std::exchange(ui_.requests, {})) commands_.act(request);
  gallery_.thumbnails.want(panels_.wanted_pictures);
  use_preferences();
  if (shows_errors(session_.view()) && !session_.can_show_errors())
    commands_.act({std::string("view: ") + view_entry(0).name});
  keep_message(now);
  if (ui_.wake_in < 1e299) session_.pacing.wake_at(now + ui_.wake_in);
  const Document& document = session_.editor.document();
  platform_->set_title(document.origin->title +
                       (session_.editor.edited() && !session_.shows_picture() ? " (edited)" : "") + " – Tyndall");
}

/// Takes a message off the screen when its time has come; errors stay.
void MainWindow::keep_message(double now) {
  const Message& message = session_.messages.current();
  if (message.text.empty() || message.error) return;
  if (now < message.until) return session_.pacing.wake_at(message.until);
  session_.messages.dismiss();
  session_.pacing.on_event();  // draws once more, because this drawing still shows the message
}

void MainWindow::finish_drawing(double now, double cpu_before, bool fresh) {
  session_.pacing.on_drawn(now);
  const double after = clock_seconds();
  const Frame* shown = fresh ? picture_.shown().get() : nullptr;
  if (shown) session_.pacing.on_picture(shown->edit, after);
  if (!log_) return;
  if (shown) log_->shown(*shown, after);
  const WindowSize size = platform_->size();
  log_->changed("size", std::to_string(size.width) + " " + std::to_string(size.height));
  log_->drawn(thread_cpu_seconds() - cpu_before, fresh);
}

}  // namespace tyndall
