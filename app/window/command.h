#pragma once
#include "app/window/menus/menu.h"

#include <string>
#include <string_view>
#include <vector>

/// One table of all that the window can be asked for. Keys, menus, the palette, the help table and the log are loops
/// over it; panels and questions ask for a command by its name.
namespace tyndall {

class Commands;

/// A key with the modifiers that must be held with it, and no others. code: GLFW's number, for letters and digits their
/// capital ASCII; 0: no key.
struct Key {
  int code = 0;
  bool control = false, shift = false;
  bool operator==(const Key&) const = default;
};

/// Where a command is offered, and what follows from it.
enum CommandFlag : unsigned {
  in_add_menu = 1,      ///< it is in the menu of Insert
  in_object_menu = 2,   ///< it is in the menu of a right click in the picture
  beside_previous = 4,  ///< the help table shows it in the line of the command before
  begins_picture = 8,   ///< what comes of it is to be seen at once
  shows_view = 16,      ///< the help table has it in a line of views
  unlisted = 32         ///< only controls and questions ask for it; neither the palette nor the log has it
};

/// A line of the table.
struct Command {
  std::string name;
  std::string words;  ///< by which the palette finds it, too, separated by ", "
  Key key;
  unsigned flags = 0;  ///< of CommandFlag
  void (*run)(Commands& commands, const std::string& argument);
  const char* (*why_not)(const Commands& commands, const std::string& argument) = nullptr;  ///< "": it can be done
  std::string help{};  ///< follows the name in the help table; "": the name says enough
  Key other_key{};
  std::string argument{};  ///< where none is given

  bool is(CommandFlag flag) const { return (flags & flag) != 0; }
};

/// The table itself, in command_table.cpp.
const std::vector<Command>& commands();
/// The command of that name, which the table must have.
const Command& command_named(std::string_view name);
/// The command of a key; null: it has none.
const Command* command_of_key(int key, Modifiers modifiers);

/// "Ctrl + Shift + Z"; "": no key.
std::string text_of(const Key& key);

/// Writes an "action" line for each command into the log.
void log_commands(UiLog& log);

/// One line of the help table.
struct HelpLine {
  std::string input, effect;
};
/// The help table: what the mouse does, then the keys.
std::vector<HelpLine> help_lines();

/// A row of the column, or, where its label is empty, a section.
struct ListedRow {
  RowEntry row;
  std::string missing;  ///< what to do first, as the column does not show it: "select fog first"; "": it does
};

/// The rows that the column draws, then those that it has at other times. Of rows of one part with the same label there
/// is one: the first, to which the column goes.
std::vector<ListedRow> listed_rows(const std::vector<RowEntry>& drawn);

/// Commands, rows of the column, sections of the column and scenes. scenes: what can be opened, for load_scene.
std::vector<PaletteItem> palette_items(const std::vector<ListedRow>& rows, const std::vector<std::string>& scenes);

}  // namespace tyndall
