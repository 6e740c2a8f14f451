#include "app/window/commands.h"

#include "app/window/accuracy/views.h"
#include "app/window/document/open_document.h"
#include "app/window/palette_list.h"
#include "app/window/requires_scene.h"
#include "app/window/tools/camera_control.h"

#include <utility>

namespace tyndall {

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
  if (session_.shows_picture() && requires_scene(request))
    return session_.messages().say("this is a picture without a scene: it can be looked at, compared and saved");
  if (picture_.act(request.action) || objects_.act(request.action)) return;
  act_on_window(request);
  act_on_rendering(request);
  act_on_document(request);
}

void Commands::act_on_window(const Request& request) {
  Preferences& look = panels_.look;
  switch (request.action) {
    case Action::help:
      shows_help_ = !shows_help_;
      return;
    case Action::deselect:
      return escape();
    case Action::panels:
      shows_panels_ = !shows_panels_;
      return;
    case Action::full_screen:
      return platform_.toggle_full_screen();
    case Action::section:
      panels_.tabs.jump = request.number;
      shows_panels_ = true;
      return;
    case Action::row:
      return go_to_row(row_entries()[static_cast<std::size_t>(request.number)]);
    case Action::palette:
      return open_palette();
    case Action::quit:
      return ask_to_close();
    case Action::larger_text:
      look.text_size = stepped_text_size(look.text_size, 1);
      return;
    case Action::smaller_text:
      look.text_size = stepped_text_size(look.text_size, -1);
      return;
    case Action::usual_text:
      look.text_size = 1;
      return;
    case Action::other_theme:
      look.theme = look.theme == Theme::dark ? Theme::light : Theme::dark;
      return;
    default:
      return;
  }
}

void Commands::act_on_rendering(const Request& request) {
  RenderRequest& wanted = session_.wanted();
  switch (request.action) {
    case Action::pause:
      wanted.paused = !wanted.paused;
      return;
    case Action::threads:
      wanted.threads = request.number;
      return;
    case Action::reference:
      dialog_ = reference_dialog(session_.accuracy().reference() != nullptr);
      return;
    case Action::open_reference:
      return session_.references().open(request.text);
    case Action::render_reference:
      return session_.render_reference();
    case Action::drop_reference:
      return session_.references().drop();
    case Action::export_chart:
      return session_.export_chart();
    case Action::snapshot:
      return session_.snapshot();
    case Action::restart:
      ++wanted.restarts;
      break;
    case Action::view:
      select_view(request.number);
      break;
    case Action::clean:
      session_.set_clean(!session_.clean());
      break;
    case Action::clean_beside_raw:
      session_.set_clean_beside_raw(!session_.clean_beside_raw());
      break;
    case Action::clean_as:
      session_.set_clean(request.number > 0);
      session_.set_clean_beside_raw(request.number > 1);
      break;
    case Action::render_at:
      panels_.model.at_window = request.number == 1;
      break;
    case Action::split:
      session_.split() ? end_split() : session_.set_split(true);
      break;
    case Action::keep_half:
      session_.keep_half(request.number == 0 ? Half::kept : Half::current);
      break;
    default:
      return;
  }
  pacing_.on_new_start(clock_seconds());
}

void Commands::act_on_document(const Request& request) {
  switch (request.action) {
    case Action::frame:
      return frame_selection();
    case Action::reset_camera:
      return reset_camera();
    case Action::undo:
      return session_.editor().undo();
    case Action::redo:
      return session_.editor().redo();
    case Action::open:
      dialog_ = open_dialog();
      return;
    case Action::open_file:
      return session_.references().open_dropped(std::filesystem::absolute(request.text));
    case Action::scene:
      return session_.editor().open(request.text);
    case Action::save:
      return save();
    case Action::save_as:
      return save_as();
    case Action::take_file:
      return session_.editor().answer_about_file(request.number == 1);
    case Action::save_to:
      return save_to(request.text);
    case Action::save_named:
      return save_named(request.text);
    case Action::save_unsaved:
      closing_.save();
      session_.editor().go_to_unsaved();
      return save();
    case Action::discard_unsaved:
      return closing_.discard();
    default:
      return;
  }
}

void Commands::open_palette() {
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
  if (dialog_.kind == Dialog::Kind::halves && !session_.split()) dialog_.kind = Dialog::Kind::none;
  closing_.draw(ui, area, dialog_);
  if (auto answer = draw_dialog(ui, area, dialog_)) panels_.requests.push_back(std::move(*answer));
}

void Commands::carry_out() {
  for (const Request& request : std::exchange(panels_.requests, {})) act(request);
}

}  // namespace tyndall
