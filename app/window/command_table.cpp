#include "app/window/commands.h"

#include "app/window/accuracy/views.h"
#include "app/window/edit/object_list.h"

/// The table of commands, in the order of the palette and of the help table.
namespace tyndall {
namespace {

constexpr Key no_key{}, esc_key{256}, tab_key{258}, insert_key{260}, delete_key{261}, home_key{268}, f1_key{290},
    f2_key{291}, f11_key{300};
constexpr Key plain(char letter) { return {letter}; }
constexpr Key ctrl(char letter) { return {letter, true}; }
constexpr Key shift(char letter) { return {letter, false, true}; }
constexpr Key ctrl_shift(char letter) { return {letter, true, true}; }

Dialog open_dialog() {
  return {"Open",
          "a scene, an image that Tyndall has made of one, or a picture to measure the error against",
          {{"dialog.open", "Open", Request{"open"}}, cancel_answer},
          0,
          "scene.json"};
}

Dialog reference_dialog(bool has_reference) {
  Dialog dialog{"Measure the error against",
                "an image of this scene and size, best an EXR of another seed; or one that is rendered now with "
                "another seed",
                {{"dialog.load", "Load", Request{"open the reference"}},
                 {"dialog.render", "Render one", Request{"render a reference"}}},
                0,
                "reference.exr"};
  if (has_reference) dialog.answers.push_back({"dialog.drop", "No reference", Request{"drop the reference"}});
  dialog.answers.push_back(cancel_answer);
  return dialog;
}

}  // namespace

const char* Commands::requires_scene(const Commands& c, const std::string&) {
  const char* why = "this is a picture without a scene: it can be looked at, compared and saved";
  return c.session_.shows_picture() ? why : "";
}

const char* Commands::requires_rendering(const Commands& c, const std::string& none) {
  return c.session_.renders() ? "" : requires_scene(c, none);
}

const char* Commands::requires_selection(const Commands& c, const std::string& none) {
  const char* why = requires_scene(c, none);
  return *why || !c.panels_.selected.empty() ? why : "select an object first: click on it";
}

/// A view of errors needs something to measure against.
const char* Commands::requires_of_view(const Commands& c, const std::string& name) {
  const int number = view_named(name);
  const bool of_scene = is_view_of_scene(number), of_beauty = view_entry(number).view == View::beauty;
  const char* why = of_scene ? requires_scene(c, name) : of_beauty ? "" : requires_rendering(c, name);
  const bool measures = !shows_errors(number) || c.session_.can_show_errors();
  return *why || measures ? why : "load a reference first: see Speed and accuracy";
}

const char* Commands::requires_of_part(const Commands& c, const std::string& part) {
  const Section& section = column_sections()[static_cast<std::size_t>(section_named(part.substr(0, part.find('/'))))];
  return section.is(of_scene) ? requires_scene(c, part) : "";
}

std::vector<Command> Commands::table_of_objects() {
  constexpr unsigned to_object = in_object_menu;
  std::vector<Command> table = {
      {"deselect", "unselect, select none, clear selection", esc_key, 0, [](Commands& c, auto&) { c.escape(); }},
      {"move the selection", "move, translate the selection, drag", plain('G'), to_object,
       [](Commands& c, auto&) { c.objects_.grab(); }, requires_selection,
       "then X, Y or Z, the mouse or a number; Enter or Esc"},
      {"add an object", "new object, create, insert", insert_key, 0,
       [](Commands& c, auto&) { c.objects_.look_under_mouse(), c.open_menu("Add here", in_add_menu); }, requires_scene,
       "at the cursor"},
      {"duplicate", "copy, clone", ctrl('D'), to_object | beside_previous,
       [](Commands& c, auto&) { c.objects_.duplicate(); }, requires_selection},
      {"delete", "remove, erase", delete_key, to_object | beside_previous,
       [](Commands& c, auto&) { c.objects_.remove(); }, requires_selection},
      {"rename", "name, object name, title", f2_key, to_object | beside_previous,
       [](Commands& c, auto&) { c.panels_.rename = c.shows_panels_ = true; }, requires_selection},
      {"make single user", "copy the material, unlink", no_key, to_object,
       [](Commands& c, auto&) { c.objects_.own_material(); }, requires_selection}};
  const auto add = [](Commands& c, const std::string& name) { c.objects_.add(addition_named(name)); };
  for (const Addition& what : additions())
    table.push_back({std::string("add ") + what.name, what.words, no_key, in_add_menu | to_object, add, requires_scene,
                     "", no_key, what.name});
  return table;
}

std::vector<Command> Commands::table_of_picture() {
  return {
      {"frame the selection", "zoom to, centre, center, frame selected, view selected, zoom selected", plain('F'),
       in_object_menu, [](Commands& c, auto&) { c.frame_selection(); }, requires_selection},
      {"reset the camera", "home, reset view", home_key, beside_previous,
       [](Commands& c, auto&) {
         Editor& editor = c.session_.editor;
         editor.change([&](Scene& scene) { scene.camera = editor.document().origin->saved.camera; });
       },
       requires_scene},
      {"inspect pixels", "pick, probe, pixel value, eyedropper, color picker", plain('I'), 0,
       [](Commands& c, auto&) { c.picture_.inspector.set_on(!c.picture_.inspector.on()); }, nullptr,
       "value, error and object under the cursor"},
      {"why noisy", "path, fireflies, variance, light paths", shift('I'), beside_previous,
       [](Commands& c, auto&) { c.picture_.find_path(); }, requires_scene, "the path that adds most to that pixel"},
      {"actual size", "1:1, zoom 1:1, 100 %, pixel for pixel", plain('0'), 0,
       [](Commands& c, auto&) { c.picture_.toggle_actual_size(); }, nullptr,
       "one pixel for each of the screen's; again: all of it"},
      {"refine a rectangle first", "region, crop, render region, render border, border, region of interest", ctrl('B'),
       0, [](Commands& c, auto&) { c.picture_.refine(); }, requires_scene, "then drag; again: the whole picture"},
      {"store the camera", "bookmark, camera bookmark, save camera", no_key, 0,
       [](Commands& c, auto&) { c.picture_.store_camera(); }, requires_scene},
      {"next stored camera", "switch camera, cycle cameras", no_key, 0,
       [](Commands& c, auto&) { c.picture_.look_through_next(); }, requires_scene},
      {"play or stop the film", "play, animate, animation, film", plain('P'), 0, [](Commands& c, auto&) { c.play(); },
       requires_scene, "of values with keys: right click on a row"},
      {"film through the stored cameras", "animate the cameras, camera path, fly through", no_key, 0,
       [](Commands& c, auto&) { c.key_cameras(); }, requires_scene},
      {"pause or go on", "stop, resume, continue", plain(' '), 0,
       [](Commands& c, auto&) { c.session_.wanted.paused = !c.session_.wanted.paused; }, requires_rendering},
      {"start over", "restart, render again, clear", plain('R'), beside_previous | begins_picture,
       [](Commands& c, auto&) { ++c.session_.wanted.restarts; }, requires_rendering}};
}

std::vector<Command> Commands::table_of_files() {
  return {{"undo", "back, revert", ctrl('Z'), 0, [](Commands& c, auto&) { c.session_.editor.undo(); }},
          {"redo", "repeat", ctrl_shift('Z'), beside_previous, [](Commands& c, auto&) { c.session_.editor.redo(); },
           nullptr, "", ctrl('Y')},
          {"open a file", "load, import, browse", ctrl('O'), 0, [](Commands& c, auto&) { c.dialog_ = open_dialog(); },
           nullptr, "a scene, or an image that Tyndall made"},
          {"save the scene", "write", ctrl('S'), 0, [](Commands& c, auto&) { c.save(); }, requires_scene},
          {"save as", "save a copy, export the scene", ctrl_shift('S'), beside_previous,
           [](Commands& c, auto&) { c.save_as(); }, requires_scene},
          {"snapshot", "screenshot, export, export image, save image, save picture", ctrl('P'), 0,
           [](Commands& c, auto&) { c.session_.snapshot(); }, nullptr, "PNG and EXR, numbered"}};
}

std::vector<Command> Commands::table_of_views() {
  std::vector<Command> table = {
      {"clean view on or off", "clean, denoise, denoiser, denoising, filter", plain('N'), begins_picture,
       [](Commands& c, auto&) { c.session_.preferences.clean = !c.session_.clean(); }, requires_scene,
       "noise filtered away"},
      {"clean beside raw", "compare clean and raw, denoise beside raw", shift('N'), beside_previous | begins_picture,
       [](Commands& c, auto&) { c.session_.set_clean_beside_raw(!c.session_.clean_beside_raw()); }, requires_scene},
      {"split view", "split, split screen, A/B, compare, compare settings, side by side", no_key, begins_picture,
       [](Commands& c, auto&) { c.session_.split() ? c.end_split() : c.session_.set_split(true); }, requires_scene},
      {"reference picture", "reference, reference image, ground truth, compare with an image, true error", no_key, 0,
       [](Commands& c, auto&) { c.dialog_ = reference_dialog(c.session_.accuracy.reference() != nullptr); }},
      {"export the chart", "csv, svg, export csv, save the chart", no_key, 0,
       [](Commands& c, auto&) { c.session_.export_chart(); }}};
  const auto show = [](Commands& c, const std::string& name) { c.session_.show_view(view_named(name)); };
  for (int k = 0; k < view_count; ++k) {
    const ViewEntry view = view_entry(k);
    const Key key = k < keyed_views ? plain(static_cast<char>('1' + k)) : no_key;
    table.push_back({std::string("view: ") + view.name, view.words, key, begins_picture | shows_view, show,
                     requires_of_view, "", no_key, view.name});
  }
  return table;
}

std::vector<Command> Commands::table_of_window() {
  return {{"hide the panels", "show the panels, show the column, sidebar, toggle sidebar, hide ui", tab_key, 0,
           [](Commands& c, auto&) { c.shows_panels_ = !c.shows_panels_; }},
          {"full screen", "maximize, maximise", f11_key, beside_previous,
           [](Commands& c, auto&) { c.platform_.toggle_full_screen(); }},
          {"larger text", "font size, larger font, bigger text, preferences, settings", ctrl('+'), 0,
           [](Commands& c, auto&) { step_text_size(c.session_.preferences, 1); }},
          {"smaller text", "smaller font", ctrl('-'), beside_previous,
           [](Commands& c, auto&) { step_text_size(c.session_.preferences, -1); }},
          {"usual text", "reset font size", ctrl('0'), beside_previous,
           [](Commands& c, auto&) { c.session_.preferences.text_size = 1; }},
          {"dark or light theme", "dark mode, light mode, colours of the window, colors of the window", no_key, 0,
           [](Commands& c, auto&) {
             Theme& theme = c.session_.preferences.theme;
             theme = theme == Theme::dark ? Theme::light : Theme::dark;
           }},
          {"close the window", "exit, quit", ctrl('Q'), 0, [](Commands& c, auto&) { c.ask_to_close(); }},
          {"all actions by name", "", ctrl('K'), 0,
           [](Commands& c, auto&) { c.objects_.look_under_mouse(), c.opens_palette_ = true; }, nullptr,
           "and all rows: ior, roughness, fov"},
          {"this table", "help, keys, shortcuts, hotkeys, keymap, manual", f1_key, 0,
           [](Commands& c, auto&) { c.shows_help_ = !c.shows_help_; }, nullptr, "", plain('H')}};
}

/// What only controls, answers to questions and lines of the palette ask for.
std::vector<Command> Commands::unlisted_table() {
  return {
      {"menu", "", no_key, unlisted,  // of what is selected
       [](Commands& c, auto&) {
         const bool none = c.panels_.selected.empty();
         c.open_menu(none ? "Add here" : title_of(c.session_.editor.scene(), c.panels_.selected), in_object_menu);
       }},
      {"part", "", no_key, unlisted,  // of the column; argument: its tab
       [](Commands& c, const std::string& name) { c.panels_.tabs.jump = section_named(name), c.shows_panels_ = true; },
       requires_of_part},
      {"row", "", no_key, unlisted,  // of the column; argument: its part and its label, "Camera/Focus"
       [](Commands& c, const std::string& place) {
         const std::size_t slash = place.find('/');
         seek_row(c.ui_, {place.substr(0, slash), place.substr(slash + 1)});
         c.shows_panels_ = true;
       },
       requires_of_part},
      {"say", "", no_key, unlisted,  // what a row that the column does not show needs first: "Camera/Focus: " and that
       [](Commands& c, const std::string& row) { c.session_.messages.say(row.substr(row.find('/') + 1)); },
       requires_of_part},
      {"vary", "", no_key, unlisted,
       [](Commands& c, const std::string& pointer) {
         if (const auto slot = find_slot(c.session_.editor.scene(), pointer)) c.strip_.vary(*slot);
       }},
      {"key", "", no_key, unlisted, [](Commands& c, const std::string& pointer) { c.add_key(pointer); },
       requires_scene},
      {"scene", "", no_key, unlisted,  // argument: as load_scene takes it
       [](Commands& c, const std::string& what) { c.session_.editor.open(what); }},
      {"clean", "", no_key, unlisted | begins_picture,  // argument: off, on or beside raw
       [](Commands& c, const std::string& how) {
         c.session_.preferences.clean = how != "off", c.session_.set_clean_beside_raw(how == "beside raw");
       },
       requires_scene},
      {"render at", "", no_key, unlisted | begins_picture,  // argument: the size of the file or of the window
       [](Commands& c, const std::string& size) { c.panels_.at_window = size == "window"; }},
      {"threads", "", no_key, unlisted,
       [](Commands& c, const std::string& count) { c.session_.wanted.threads = std::stoi(count); }},
      {"keep half", "", no_key, unlisted | begins_picture,  // argument: A, the left one, or B
       [](Commands& c, const std::string& half) { c.session_.keep_half(half == "A" ? Half::kept : Half::current); }},
      {"keep the edits", "", no_key, unlisted,  // another program has changed the file
       [](Commands& c, auto&) { c.session_.editor.answer_about_file(false); }},
      {"take the file", "", no_key, unlisted, [](Commands& c, auto&) { c.session_.editor.answer_about_file(true); }},
      {"open", "", no_key, unlisted,  // argument: the file of a scene, a picture of one, or a reference
       [](Commands& c, const std::string& file) {
         c.session_.references.open_dropped(std::filesystem::absolute(file));
       }},
      {"sky", "", no_key, unlisted,  // argument: its file
       [](Commands& c, const std::string& file) { c.session_.editor.set_sky(file); }},
      {"save to", "", no_key, unlisted,  // argument: the file, which is replaced if it exists
       [](Commands& c, const std::string& file) { c.save_to(file); }},
      {"save named", "", no_key, unlisted,  // argument: the file, as the user has typed it
       [](Commands& c, const std::string& file) { c.save_named(file); }},
      {"save and close", "", no_key, unlisted,  // the edits that no file has, wherever they are
       [](Commands& c, auto&) { c.closing_.save(), c.session_.editor.go_to_unsaved(), c.save(); }},
      {"discard and close", "", no_key, unlisted, [](Commands& c, auto&) { c.closing_.discard(); }},
      {"open the reference", "", no_key, unlisted,  // argument: its file
       [](Commands& c, const std::string& file) { c.session_.references.open(file); }},
      {"render a reference", "", no_key, unlisted, [](Commands& c, auto&) { c.session_.render_reference(); },
       requires_scene},
      {"drop the reference", "", no_key, unlisted, [](Commands& c, auto&) { c.session_.references.drop(); }}};
}

std::vector<Command> Commands::table() {
  std::vector<Command> all;
  for (const auto& part : {table_of_objects(), table_of_picture(), table_of_files(), table_of_views(),
                           table_of_window(), table_of_page(), unlisted_table()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

const std::vector<Command>& commands() {
  static const std::vector<Command> all = Commands::table();
  return all;
}

}  // namespace tyndall
