#include "app/window/commands.h"

#include "app/window/accuracy/views.h"
#include "app/window/document/open_document.h"
#include "app/window/palette_list.h"
#include "app/window/tools/camera_control.h"

#include <utility>

namespace tyndall {

void Commands::take(const InputEvents& events) {
  for (const KeyPress& press : events.keys) {
    const auto command = command_of_key(press.key, press.modifiers);
    const bool answers = command && command->action == Action::deselect;
    if (palette_.take_key(press.key)) {
      pacing_.on_event();
      continue;
    }
    if (!press.typing && !asks() && objects_.has_keys() && objects_.take_press(press)) continue;
    if (objects_.active() && !answers) continue;
    if (!command || (press.typing && !asks()) || (asks() && !answers)) continue;
    act(*command);
  }
  for (const std::filesystem::path& file : events.dropped)
    session_.references().open_dropped(std::filesystem::absolute(file));
}

void Commands::act(const KeyCommand& command) {
  const ActionEntry* entry = find_action(command.action);
  if (log_ && entry) log_->line("did " + std::string(entry->name));
  panels_.leave_row = command.action != Action::deselect;
  switch (command.action) {
    case Action::help:
      shows_help_ = !shows_help_;
      break;
    case Action::deselect:
      escape();
      break;
    case Action::pause:
      session_.wanted().paused = !session_.wanted().paused;
      break;
    case Action::restart:
      ++session_.wanted().restarts;
      pacing_.on_new_start(clock_seconds());
      break;
    case Action::view:
      select_view(command.which);
      break;
    case Action::clean:
      session_.set_clean(!session_.clean());
      pacing_.on_new_start(clock_seconds());
      break;
    case Action::clean_beside_raw:
      session_.set_clean_beside_raw(!session_.clean_beside_raw());
      pacing_.on_event();
      break;
    case Action::panels:
      shows_panels_ = !shows_panels_;
      break;
    case Action::full_screen:
      platform_.toggle_full_screen();
      break;
    case Action::section:
      panels_.tabs.jump = command.which;
      shows_panels_ = true;
      pacing_.on_event();
      break;
    case Action::row:
      go_to_row(row_entries()[static_cast<std::size_t>(command.which)]);
      break;
    case Action::scene:
      session_.editor().open(listed_scenes().at(static_cast<std::size_t>(command.which)));
      break;
    case Action::palette:
      open_palette();
      break;
    case Action::quit:
      ask_to_close();
      break;
    default:
      act_on_look(command.action);
      act_on_document(command.action);
  }
}

void Commands::act_on_look(Action action) {
  Preferences& look = panels_.look;
  if (action == Action::larger_text) look.text_size = stepped_text_size(look.text_size, 1);
  if (action == Action::smaller_text) look.text_size = stepped_text_size(look.text_size, -1);
  if (action == Action::usual_text) look.text_size = 1;
  if (action == Action::other_theme) look.theme = look.theme == Theme::dark ? Theme::light : Theme::dark;
}

void Commands::act_on_document(Action action) {
  if (picture_.act(action)) return;
  if (objects_.act(action)) {
    if (action == Action::rename) shows_panels_ = true;
    return;
  }
  switch (action) {
    case Action::frame:
      return frame_selection();
    case Action::reset_camera:
      return reset_camera();
    case Action::undo:
      session_.editor().undo();
      return pacing_.on_event();
    case Action::redo:
      session_.editor().redo();
      return pacing_.on_event();
    case Action::open:
      dialog_ = {Dialog::Kind::open, {}, true, 0};
      return pacing_.on_event();
    case Action::save:
      return save();
    case Action::save_as:
      return save_as();
    case Action::snapshot:
      return session_.snapshot();
    case Action::split:
      session_.split() ? end_split() : session_.set_split(true);
      return pacing_.on_new_start(clock_seconds());
    case Action::reference:
      ask_reference(dialog_);
      return pacing_.on_event();
    case Action::export_chart:
      return session_.export_chart();
    default:
      return;
  }
}

void Commands::open_palette() {
  std::vector<PaletteItem> items;
  palette_commands_.clear();
  for (PaletteLine& line : palette_lines(session_.editor().scene(), panels_.selected, listed_scenes())) {
    items.push_back(std::move(line.item));
    palette_commands_.push_back(line.command);
  }
  palette_.open(std::move(items));
  pacing_.on_event();
}

void Commands::go_to_row(const RowEntry& row) {
  if (owner_of(row, session_.editor().scene(), panels_.selected).empty())
    return session_.messages().say(row.label + ": " + row.missing);
  panels_.seek = RowPlace{row.part, row.label};
  shows_panels_ = true;
  pacing_.on_event();
}

std::vector<std::string> Commands::listed_scenes() const {
  std::vector<std::string> all;
  for (const BuiltIn& scene : panels_.facts.scenes) all.push_back(scene.name);
  for (const std::filesystem::path& file : panels_.facts.recent) all.push_back(file.string());
  return all;
}

void Commands::reset_camera() {
  Scene scene = session_.editor().scene();
  scene.camera = session_.editor().document().origin->saved.camera;
  session_.editor().edit(std::move(scene), gestures_.begin());
}

void Commands::frame_selection() {
  const auto ball = ball_around(session_.editor().scene(), panels_.selected);
  if (!ball) return session_.messages().say("select an object first: click on it");
  Scene scene = session_.editor().scene();
  scene.camera = frame_ball(scene.camera, ball->center, ball->radius, static_cast<double>(scene.width) / scene.height);
  session_.editor().edit(std::move(scene), gestures_.begin());
}

void Commands::save_as() {
  const Origin& origin = *session_.editor().document().origin;
  ask_name(dialog_, origin.file.empty() ? std::filesystem::path(stem_of(origin.title) + ".json") : origin.file);
}

void Commands::save() {
  const Origin& origin = *session_.editor().document().origin;
  if (origin.file.empty())
    save_as();
  else if (file_differs(origin))
    dialog_ = {Dialog::Kind::overwrite, {}, true, 1};
  else if (origin.comments)
    dialog_ = {Dialog::Kind::comments, {}, true, 1};
  else
    session_.editor().save(origin.file);
}

void Commands::select_view(int index) {
  if (shows_errors(index) && !session_.can_show_errors())
    return session_.messages().say("load a reference first: see Speed and accuracy");
  panels_.view = index;
  if (index == shown_view_) return;
  shown_view_ = index;
  session_.set_view(view_entry(index).view, view_entry(index).error);
  pacing_.on_new_start(clock_seconds());
}

void Commands::end_split() {
  if (session_.method(Half::kept) == session_.method(Half::current))
    session_.set_split(false);
  else
    dialog_ = {Dialog::Kind::halves, {}, true, 2};
}

void Commands::ask_to_close() {
  closing_.begin(dialog_);
  pacing_.on_event();
}

void Commands::escape() {
  if (panels_.drags) {
    panels_.cancel_drag = true;
    return pacing_.on_event();
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
    return pacing_.on_event();
  }
  if (objects_.escape()) return;
  const bool covered = asks() || shows_help_ || session_.messages().current().error;
  if (!covered && picture_.escape()) return;
  if (asks())
    dialog_.kind = Dialog::Kind::none;
  else if (shows_help_)
    shows_help_ = false;
  else if (session_.messages().current().error)
    session_.messages().dismiss();
  else
    objects_.select_all({});
}

void Commands::draw(Ui& ui, const Rect& area) {
  const int chosen = palette_.draw(ui, area);
  if (chosen >= 0) later_ = [this, command = palette_commands_[static_cast<std::size_t>(chosen)]] { act(command); };
  if (shows_help_) draw_help(ui, shows_help_);
  const ReferenceWish wish = draw_reference_dialog(ui, area, dialog_, session_.accuracy().reference() != nullptr);
  if (wish.file) session_.references().open(*wish.file);
  if (wish.render) session_.render_reference();
  if (wish.drop) session_.references().drop();
  const auto file = draw_dialog(ui, area, dialog_, session_.editor().document());
  if (file && !session_.editor().save(*file)) ask_name(dialog_, *file);  // what was typed is not lost
  const auto opened = draw_open_dialog(ui, area, dialog_);
  if (opened) session_.references().open_dropped(std::filesystem::absolute(*opened));
  if (session_.editor().asks_about_file() && !asks()) dialog_ = {Dialog::Kind::changed_file, {}, true, 0};
  const auto take = draw_changed_file_dialog(ui, area, dialog_, session_.editor().document());
  if (take) later_ = [this, take = *take] { session_.editor().answer_about_file(take); };
  if (dialog_.kind == Dialog::Kind::halves && !session_.split()) dialog_.kind = Dialog::Kind::none;
  const auto half = draw_halves_dialog(ui, area, dialog_, session_.method(Half::kept), session_.method(Half::current));
  if (half) later_ = [this, half = *half] { session_.keep_half(half); };
  if (closing_.draw(ui, area, dialog_))
    later_ = [this] {
      session_.editor().go_to_unsaved();
      save();
    };
}

void Commands::carry_out() {
  if (!later_) return;
  std::exchange(later_, nullptr)();
  pacing_.on_event();
}

}  // namespace tyndall
