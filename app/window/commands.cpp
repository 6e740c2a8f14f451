#include "app/window/commands.h"

#include "app/window/accuracy/views.h"
#include "app/window/document/document.h"
#include "app/window/tools/camera_control.h"

#include <cstring>
#include <utility>

namespace tyndall {
namespace {

Dialog name_dialog(const std::filesystem::path& suggestion) {
  Dialog dialog{
      "Save the scene as", "", {{"dialog.save", "Save", Request{"save named"}}, cancel_answer}, 0, "scene.json"};
  std::strncpy(dialog.name, suggestion.string().c_str(), sizeof dialog.name - 1);
  return dialog;
}

/// Saving destroys something of the file: what another program has changed, else comments.
Dialog loss_dialog(const Origin& origin, bool changed) {
  return {changed ? "Another program has changed " + origin.title + " since it was read."
                  : "Saving " + origin.title + " loses its comments.",
          changed ? "Saving replaces what it holds now." : "Scenes are written in normal form, which has none.",
          {{"dialog.save", "Save anyway", Request{"save to", origin.file.string()}},
           {"dialog.save_as", "Save as…", Request{"save as"}},
           cancel_answer},
          1};
}

/// A picture was dropped that may be meant as either.
Dialog picture_dialog(const std::filesystem::path& file) {
  return {"What is " + file.filename().string() + "?",
          "A sky lights the scene from all around; a reference is what the picture is compared with.",
          {{"dialog.sky", "As sky", Request{"sky", file.string()}},
           {"dialog.reference", "As reference", Request{"open the reference", file.string()}},
           cancel_answer}};
}

Dialog changed_file_dialog(const Origin& origin) {
  return {"Another program has changed " + origin.title + ".",
          "You have edits of it that are not saved. If you take the file, Ctrl + Z brings them back.",
          {{"dialog.keep", "Keep my edits", Request{"keep the edits"}},
           {"dialog.take", "Take the file", Request{"take the file"}}},
          0,
          nullptr,
          Dialog::Kind::changed_file};
}

}  // namespace

/// What a menu, a movement or the strip makes of a key or character. Returns whether it was meant for one of them.
bool Commands::take_key(const KeyPress& press) {
  if (press.typing || has_question()) return false;
  if (press.character == '\0' && menu_.take_key(press.key)) return true;
  if (objects_.active()) return objects_.take_press(press);
  return !ui_.sought.has_keys && strip_.take_key(press.key);
}

void Commands::take(const InputEvents& events) {
  for (const KeyPress& press : events.keys) {
    const Command* command = command_of_key(press.key, press.modifiers);
    const bool answers = command && command->name == "deselect";
    if (palette_.take_key(press.key) || take_key(press)) {
      session_.pacing.on_event();
      continue;
    }
    if (!command || (objects_.active() && !answers)) continue;
    if ((press.typing && !has_question()) || (has_question() && !answers)) continue;
    if (!answers) ui_.sought.has_keys = false;
    act({command->name});
  }
  for (const std::filesystem::path& file : events.dropped)
    session_.references.open_dropped(std::filesystem::absolute(file));
}

std::string Commands::why_not(const Command& command, const std::string& argument) const {
  return command.why_not ? command.why_not(*this, argument) : "";
}

void Commands::act(const Request& request) {
  const Command& command = command_named(request.command);
  const std::string& argument = request.argument.empty() ? command.argument : request.argument;
  if (session_.log && !command.is(unlisted)) session_.log->line("did " + command.name);
  session_.pacing.on_event();
  if (const std::string why = why_not(command, argument); !why.empty()) return session_.messages.say(why);
  command.run(*this, argument);
  if (command.is(begins_picture)) session_.pacing.on_new_start(clock_seconds());
}

void Commands::open_menu(const std::string& title, CommandFlag which) {
  std::vector<MenuItem> items;
  bool separated = which == in_add_menu;  // additions are, from what is done to objects
  for (const Command& command : commands()) {
    if (!command.is(which)) continue;
    const bool line_above = command.is(in_add_menu) && !std::exchange(separated, true);
    items.push_back({command.name, text_of(command.key), why_not(command, command.argument), line_above});
  }
  menu_.open(objects_.mouse().x, objects_.mouse().y, title, std::move(items));
}

/// Gives the value a key at the frame that the film shows.
void Commands::add_key(const std::string& pointer) {
  const auto slot = find_slot(session_.editor.scene(), pointer);
  if (!slot) return;
  session_.messages.say("key of " + slot->label + " at frame " + std::to_string(timeline_.frame()));
  session_.editor.change([&](Scene& scene) { tyndall::add_key(scene, *slot, timeline_.frame()); });
}

void Commands::play() {
  if (!session_.editor.scene().animation)
    return session_.messages.say("no value has keys: right click on a row, or store cameras and film through them");
  timeline_.play_or_stop(clock_seconds());
}

void Commands::key_cameras() {
  const CameraSlots& slots = panels_.cameras[panels_.now.origin->title];
  if (slots.size() < 2) return session_.messages.say("store two cameras or more first: see Camera");
  session_.editor.change([&](Scene& scene) { tyndall::key_cameras(scene, slots); });
}

void Commands::frame_selection() {
  const auto sphere = bounding_sphere(session_.editor.scene(), panels_.selected);
  if (!sphere) return;  // an empty group
  session_.editor.change([&](Scene& scene) {
    const double aspect = static_cast<double>(scene.width) / scene.height;
    scene.camera = frame_sphere(scene.camera, sphere->center, sphere->radius, aspect);
  });
}

void Commands::save_as() {
  const Origin& origin = *session_.editor.document().origin;
  dialog_ = name_dialog(origin.file.empty() ? std::filesystem::path(stem_of(origin.title) + ".json") : origin.file);
}

/// Asks first before saving destroys something of the document's file.
void Commands::save() {
  const Origin& origin = *session_.editor.document().origin;
  if (origin.file.empty()) return save_as();
  const bool differs = file_differs(origin);
  if (differs || origin.comments)
    dialog_ = loss_dialog(origin, differs);
  else
    session_.editor.save(origin.file);
}

void Commands::save_to(const std::filesystem::path& file) {
  if (!session_.editor.save(file)) dialog_ = name_dialog(file);  // what was typed is not lost
}

void Commands::save_named(std::filesystem::path file) {
  if (file.extension() != ".json") file += ".json";  // a scene file, as its name is to say
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return save_to(file);
  const std::string name = file.string();
  dialog_ = {name + " exists.", "", {{"dialog.replace", "Replace it", Request{"save to", name}}, cancel_answer}, 1};
}

void Commands::end_split() {
  const std::string kept = session_.method(Half::kept), current = session_.method(Half::current);
  if (kept == current) return session_.set_split(false);
  dialog_ = {"Which half do you keep?",
             "",
             {{"dialog.a", "A   " + kept, Request{"keep half", "A"}},
              {"dialog.b", "B   " + current, Request{"keep half", "B"}},
              cancel_answer},
             2,
             nullptr,
             Dialog::Kind::halves};
}

void Commands::ask_to_close() {
  closing_.begin(dialog_);
  session_.pacing.on_event();
}

void Commands::escape() {
  if (ui_.drag.active) {
    ui_.drag.cancel = true;
    return;
  }
  if (dialog_.kind == Dialog::Kind::changed_file) session_.editor.answer_about_file(false);
  if (closing_.cancel()) return;
  if (popup_is_open()) {
    ui_.close_popup = true;
    return;
  }
  if (palette_.is_open()) return palette_.close();
  if (std::exchange(ui_.sought.has_keys, false)) return;
  if (menu_.is_open()) return menu_.close();
  if (objects_.escape()) return;
  const bool covered = has_question() || shows_help_ || session_.messages.current().error;
  if (!covered && strip_.is_open()) return strip_.close();
  if (!covered && picture_.escape()) return;
  if (has_question())
    dialog_ = {};
  else if (shows_help_)
    shows_help_ = false;
  else if (session_.messages.current().error)
    session_.messages.dismiss();
  else
    objects_.select_all({});
}

void Commands::draw(const Rect& area) {
  shows_menu_ = menu_.is_open();
  if (auto chosen = menu_.draw(ui_, area)) ui_.requests.push_back(std::move(*chosen));
  if (std::exchange(opens_palette_, false)) {
    std::vector<std::string> scenes;  // what can be opened by a click
    for (const BuiltIn& scene : panels_.now.scenes) scenes.push_back(scene.name);
    for (const std::filesystem::path& file : panels_.now.recent) scenes.push_back(file.string());
    palette_.open(palette_items(listed_rows(rows_of_column(ui_, panels_)), scenes));
  }
  if (auto chosen = palette_.draw(ui_, area)) ui_.requests.push_back(std::move(*chosen));
  if (shows_help_) draw_help(ui_, shows_help_);
  if (session_.editor.offers_reload() && !has_question())
    dialog_ = changed_file_dialog(*session_.editor.document().origin);
  if (!has_question())
    if (const std::filesystem::path picture = session_.references.take_doubtful(); !picture.empty())
      dialog_ = picture_dialog(picture);
  if (dialog_.kind == Dialog::Kind::halves && !session_.split()) dialog_ = {};
  closing_.draw(ui_, area, dialog_);
  if (auto answer = draw_dialog(ui_, area, dialog_)) ui_.requests.push_back(std::move(*answer));
}

}  // namespace tyndall
