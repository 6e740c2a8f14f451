#include "app/window/commands.h"

#include "app/window/accuracy/views.h"
#include "app/window/document/open_document.h"
#include "app/window/palette_list.h"
#include "app/window/tools/camera_control.h"

#include <algorithm>
#include <utility>

namespace tyndall {
namespace {

Theme other_theme(Theme theme) { return theme == Theme::dark ? Theme::light : Theme::dark; }

}  // namespace

void Commands::take(const InputEvents& events) {
  for (const KeyPress& press : events.keys) {
    const auto request = request_of_key(press.key, press.modifiers);
    const bool answers = request && request->action == Action::deselect;
    if (palette_.take_key(press.key)) {
      pacing_.on_event();
      continue;
    }
    if (!press.typing && !has_question() && objects_.has_keys() && objects_.take_press(press)) continue;
    if (objects_.active() && !answers) continue;
    if (!press.typing && !has_question() && !panels_.row_has_keys && strip_.take_key(press.key)) {
      pacing_.on_event();
      continue;
    }
    if (!request || (press.typing && !has_question()) || (has_question() && !answers)) continue;
    panels_.leave_row = true;
    act(*request);
  }
  for (const std::filesystem::path& file : events.dropped)
    session_.references().open_dropped(std::filesystem::absolute(file));
}

void Commands::act(const Request& request) {
  const ActionEntry* entry = find_action(request.action);
  if (log_ && entry) log_->line("did " + std::string(entry->name));
  if (entry) panels_.leave_row = request.action != Action::deselect;
  if (request.action == Action::rename) shows_panels_ = true;
  pacing_.on_event();
  const bool refused = requires_scene(request) || (requires_rendering(request) && !session_.renders());
  if (session_.shows_picture() && refused)
    return session_.messages().say("this is a picture without a scene: it can be looked at, compared and saved");
  if (picture_.act(request.action) || objects_.act(request.action)) return;
  act_on_window(request);
  act_on_rendering(request);
  act_on_document(request);
}

/// Carries out the request by the handler of its action. Returns whether there is one.
bool Commands::act_by(std::span<const Handler> handlers, const Request& request) {
  const auto found =
      std::find_if(handlers.begin(), handlers.end(), [&](const Handler& one) { return one.action == request.action; });
  if (found != handlers.end()) found->act(*this, request);
  return found != handlers.end();
}

void Commands::act_on_window(const Request& request) {
  static constexpr Handler handlers[] = {
      {Action::help, [](Commands& c, auto&) { c.shows_help_ = !c.shows_help_; }},
      {Action::deselect, [](Commands& c, auto&) { c.escape(); }},
      {Action::panels, [](Commands& c, auto&) { c.shows_panels_ = !c.shows_panels_; }},
      {Action::full_screen, [](Commands& c, auto&) { c.platform_.toggle_full_screen(); }},
      {Action::section, [](Commands& c, auto& r) { c.panels_.tabs.jump = r.number, c.shows_panels_ = true; }},
      {Action::row, [](Commands& c, auto& r) { c.go_to_row(row_entries()[static_cast<std::size_t>(r.number)]); }},
      {Action::palette, [](Commands& c, auto&) { c.open_palette(); }},
      {Action::quit, [](Commands& c, auto&) { c.ask_to_close(); }},
      {Action::larger_text,
       [](Commands& c, auto&) { c.panels_.look.text_size = stepped_text_size(c.panels_.look.text_size, 1); }},
      {Action::smaller_text,
       [](Commands& c, auto&) { c.panels_.look.text_size = stepped_text_size(c.panels_.look.text_size, -1); }},
      {Action::usual_text, [](Commands& c, auto&) { c.panels_.look.text_size = 1; }},
      {Action::other_theme, [](Commands& c, auto&) { c.panels_.look.theme = other_theme(c.panels_.look.theme); }}};
  act_by(handlers, request);
}

void Commands::act_on_rendering(const Request& request) {
  static constexpr Handler handlers[] = {
      {Action::pause, [](Commands& c, auto&) { c.session_.wanted().paused = !c.session_.wanted().paused; }},
      {Action::threads, [](Commands& c, auto& r) { c.session_.wanted().threads = r.number; }},
      {Action::reference,
       [](Commands& c, auto&) { c.dialog_ = reference_dialog(c.session_.accuracy().reference() != nullptr); }},
      {Action::open_reference, [](Commands& c, auto& r) { c.session_.references().open(r.text); }},
      {Action::render_reference, [](Commands& c, auto&) { c.session_.render_reference(); }},
      {Action::drop_reference, [](Commands& c, auto&) { c.session_.references().drop(); }},
      {Action::export_chart, [](Commands& c, auto&) { c.session_.export_chart(); }},
      {Action::snapshot, [](Commands& c, auto&) { c.session_.snapshot(); }}};
  // After these a new picture is to be seen at once.
  static constexpr Handler new_starts[] = {
      {Action::restart, [](Commands& c, auto&) { ++c.session_.wanted().restarts; }},
      {Action::view, [](Commands& c, auto& r) { c.select_view(r.number); }},
      {Action::clean, [](Commands& c, auto&) { c.session_.set_clean(!c.session_.clean()); }},
      {Action::clean_beside_raw,
       [](Commands& c, auto&) { c.session_.set_clean_beside_raw(!c.session_.clean_beside_raw()); }},
      {Action::clean_as,
       [](Commands& c, auto& r) { c.session_.set_clean(r.number > 0), c.session_.set_clean_beside_raw(r.number > 1); }},
      {Action::render_at, [](Commands& c, auto& r) { c.panels_.model.at_window = r.number == 1; }},
      {Action::split, [](Commands& c, auto&) { c.session_.split() ? c.end_split() : c.session_.set_split(true); }},
      {Action::keep_half,
       [](Commands& c, auto& r) { c.session_.keep_half(r.number == 0 ? Half::kept : Half::current); }}};
  act_by(handlers, request);
  if (act_by(new_starts, request)) pacing_.on_new_start(clock_seconds());
}

void Commands::act_on_document(const Request& request) {
  static constexpr Handler handlers[] = {
      {Action::frame, [](Commands& c, auto&) { c.frame_selection(); }},
      {Action::reset_camera, [](Commands& c, auto&) { c.reset_camera(); }},
      {Action::play, [](Commands& c, auto&) { c.play(); }},
      {Action::key_cameras, [](Commands& c, auto&) { c.key_cameras(); }},
      {Action::undo, [](Commands& c, auto&) { c.session_.editor().undo(); }},
      {Action::redo, [](Commands& c, auto&) { c.session_.editor().redo(); }},
      {Action::open, [](Commands& c, auto&) { c.dialog_ = open_dialog(); }},
      {Action::open_file,
       [](Commands& c, auto& r) { c.session_.references().open_dropped(std::filesystem::absolute(r.text)); }},
      {Action::sky_of_file, [](Commands& c, auto& r) { c.session_.editor().set_sky(r.text); }},
      {Action::scene, [](Commands& c, auto& r) { c.session_.editor().open(r.text); }},
      {Action::save, [](Commands& c, auto&) { c.save(); }},
      {Action::save_as, [](Commands& c, auto&) { c.save_as(); }},
      {Action::take_file, [](Commands& c, auto& r) { c.session_.editor().answer_about_file(r.number == 1); }},
      {Action::save_to, [](Commands& c, auto& r) { c.save_to(r.text); }},
      {Action::save_named, [](Commands& c, auto& r) { c.save_named(r.text); }},
      {Action::save_unsaved,
       [](Commands& c, auto&) { c.closing_.save(), c.session_.editor().go_to_unsaved(), c.save(); }},
      {Action::discard_unsaved, [](Commands& c, auto&) { c.closing_.discard(); }}};
  act_by(handlers, request);
}

void Commands::open_palette() {
  objects_.look_under_mouse();
  palette_.open(palette_items(session_.editor().scene(), panels_.selected, listed_scenes()));
}

void Commands::go_to_row(const RowEntry& row) {
  if (owner_of(row, session_.editor().scene(), panels_.selected).empty())
    return session_.messages().say(row.label + ": " + row.missing);
  panels_.seek = RowPlace{row.part, row.label};
  shows_panels_ = true;
}

std::vector<std::string> Commands::listed_scenes() const {
  std::vector<std::string> all;
  for (const BuiltIn& scene : panels_.model.scenes) all.push_back(scene.name);
  for (const std::filesystem::path& file : panels_.model.recent) all.push_back(file.string());
  return all;
}

void Commands::play() {
  if (!session_.editor().scene().animation)
    return session_.messages().say("no value has keys: right click on a row, or store cameras and film through them");
  timeline_.play_or_stop(clock_seconds());
}

void Commands::key_cameras() {
  const CameraSlots& slots = panels_.cameras[panels_.model.title];
  if (slots.size() < 2) return session_.messages().say("store two cameras or more first: see Camera");
  Scene scene = session_.editor().scene();
  tyndall::key_cameras(scene, slots);
  session_.editor().edit(std::move(scene), gestures_.begin());
}

void Commands::reset_camera() {
  Scene scene = session_.editor().scene();
  scene.camera = session_.editor().document().origin->saved.camera;
  session_.editor().edit(std::move(scene), gestures_.begin());
}

void Commands::frame_selection() {
  const auto sphere = bounding_sphere(session_.editor().scene(), panels_.selected);
  if (!sphere) return session_.messages().say("select an object first: click on it");
  Scene scene = session_.editor().scene();
  scene.camera =
      frame_sphere(scene.camera, sphere->center, sphere->radius, static_cast<double>(scene.width) / scene.height);
  session_.editor().edit(std::move(scene), gestures_.begin());
}

void Commands::save_as() {
  const Origin& origin = *session_.editor().document().origin;
  dialog_ = name_dialog(origin.file.empty() ? std::filesystem::path(stem_of(origin.title) + ".json") : origin.file);
}

/// Asks first before saving destroys something of the document's file.
void Commands::save() {
  const Origin& origin = *session_.editor().document().origin;
  if (origin.file.empty()) return save_as();
  const bool differs = file_differs(origin);
  if (differs || origin.comments)
    dialog_ = loss_dialog(origin, differs);
  else
    session_.editor().save(origin.file);
}

void Commands::save_to(const std::filesystem::path& file) {
  if (!session_.editor().save(file)) dialog_ = name_dialog(file);  // what was typed is not lost
}

void Commands::save_named(std::filesystem::path file) {
  if (file.extension() != ".json") file += ".json";  // a scene file, as its name is to say
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return save_to(file);
  dialog_ = replace_dialog(file);
}

/// A view of errors needs something to measure against; without it the view stays and a message says why.
void Commands::select_view(int index) {
  if (shows_errors(index) && !session_.can_show_errors())
    return session_.messages().say("load a reference first: see Speed and accuracy");
  panels_.model.view = index;
  session_.set_view(view_entry(index).view, view_entry(index).error);
}

void Commands::end_split() {
  const std::string kept = session_.method(Half::kept), current = session_.method(Half::current);
  if (kept == current) return session_.set_split(false);
  dialog_ = halves_dialog(kept, current);
}

void Commands::ask_to_close() {
  closing_.begin(dialog_);
  pacing_.on_event();
}

void Commands::escape() {
  if (panels_.drags) {
    panels_.cancel_drag = true;
    return;
  }
  if (dialog_.kind == Dialog::Kind::changed_file) session_.editor().answer_about_file(false);
  if (closing_.cancel()) return;
  if (popup_is_open()) {
    panels_.close_popup = true;
    return;
  }
  if (palette_.is_open()) return palette_.close();
  if (panels_.row_has_keys) {
    panels_.leave_row = true;
    return;
  }
  if (objects_.escape()) return;
  if (strip_.is_open() && !has_question() && !shows_help_ && !session_.messages().current().error)
    return strip_.close();
  const bool covered = has_question() || shows_help_ || session_.messages().current().error;
  if (!covered && picture_.escape()) return;
  if (has_question())
    dialog_.kind = Dialog::Kind::none;
  else if (shows_help_)
    shows_help_ = false;
  else if (session_.messages().current().error)
    session_.messages().dismiss();
  else
    objects_.select_all({});
}

void Commands::draw(Ui& ui, const Rect& area) {
  if (auto chosen = palette_.draw(ui, area)) panels_.requests.push_back(std::move(*chosen));
  if (shows_help_) draw_help(ui, shows_help_);
  if (session_.editor().offers_reload() && !has_question())
    dialog_ = changed_file_dialog(*session_.editor().document().origin);
  if (!has_question())
    if (const std::filesystem::path picture = session_.references().take_doubtful(); !picture.empty())
      dialog_ = picture_dialog(picture);
  if (dialog_.kind == Dialog::Kind::halves && !session_.split()) dialog_.kind = Dialog::Kind::none;
  closing_.draw(ui, area, dialog_);
  if (auto answer = draw_dialog(ui, area, dialog_)) panels_.requests.push_back(std::move(*answer));
}

void Commands::carry_out() {
  for (const Request& request : std::exchange(panels_.requests, {})) act(request);
}

}  // namespace tyndall
