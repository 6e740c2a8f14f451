#pragma once
#include "app/window/command.h"
#include "app/window/dialog.h"
#include "app/window/menus/menu.h"
#include "app/window/overlays.h"
#include "app/window/panels/panels.h"
#include "app/window/picture_tools.h"
#include "app/window/session.h"
#include "app/window/system/platform.h"
#include "app/window/timeline/timeline.h"
#include "app/window/variations/strip.h"

#include <vector>

/// What happens when the user presses a key, drops a file or answers a question.
namespace tyndall {

/// Carries out all that the window is asked for: by keys and dropped files at once, by panels, menus, the palette and
/// dialogs at the end of the drawing.
class Commands {
 public:
  /// The arguments belong to the window and must outlive this.
  Commands(Session& session, Platform& platform, Ui& ui, PanelState& panels, ObjectTools& objects,
           PictureTools& picture, VariationStrip& strip, Timeline& timeline)
      : session_(session),
        platform_(platform),
        ui_(ui),
        panels_(panels),
        objects_(objects),
        picture_(picture),
        strip_(strip),
        timeline_(timeline),
        closing_(session) {}

  /// See commands(), which is made of it once.
  static std::vector<Command> table();

  /// Does what the user has asked for since the last drawing.
  void take(const InputEvents& events);
  /// Carries out one request; those of a drawing at its end, when the panels' scene was handed to the editor.
  void act(const Request& request);
  /// The user wants to close the window: asks about what is not saved.
  void ask_to_close();
  /// The window may go.
  bool closed() const { return closing_.done(); }
  /// Draws menu, palette, help table and the question that waits for an answer.
  void draw(const Rect& area);

  /// Whether a dialog waits for an answer: until then nothing else takes clicks.
  bool has_dialog() const { return !dialog_.question.empty(); }
  /// Whether a dialog or the palette has the keyboard.
  bool has_question() const { return has_dialog() || palette_.is_open(); }
  /// Whether the menu is open, or was closed by this drawing: a click beside it does nothing else.
  bool shows_menu() const { return shows_menu_ || menu_.is_open(); }
  bool shows_panels() const { return shows_panels_; }

 private:
  static std::vector<Command> table_of_objects();
  static std::vector<Command> table_of_picture();
  static std::vector<Command> table_of_files();
  static std::vector<Command> table_of_views();
  static std::vector<Command> table_of_window();
  static std::vector<Command> table_of_page();  ///< only in browsers
  static std::vector<Command> unlisted_table();
  // See Command::why_not.
  static const char* requires_scene(const Commands& commands, const std::string& argument);
  static const char* requires_rendering(const Commands& commands, const std::string& argument);
  static const char* requires_selection(const Commands& commands, const std::string& argument);
  static const char* requires_of_view(const Commands& commands, const std::string& name);
  static const char* requires_of_part(const Commands& commands, const std::string& part);

  std::string why_not(const Command& command, const std::string& argument) const;
  bool take_key(const KeyPress& press);
  void open_menu(const std::string& title, CommandFlag which);
  void play();
  void key_cameras();
  void frame_selection();
  void add_key(const std::string& pointer);
  /// Ends the split view; asks which half to keep where they differ.
  void end_split();
  void save();
  void save_as();
  void save_to(const std::filesystem::path& file);
  void save_named(std::filesystem::path file);
  void escape();

  Session& session_;
  Platform& platform_;
  Ui& ui_;
  PanelState& panels_;
  ObjectTools& objects_;
  PictureTools& picture_;
  VariationStrip& strip_;
  Timeline& timeline_;
  Dialog dialog_;
  Menu menu_;
  Palette palette_;
  Closing closing_;
  bool shows_help_ = false, shows_panels_ = true, shows_menu_ = false, opens_palette_ = false;
};

}  // namespace tyndall
