#pragma once
#include "app/text/numbers.h"
#include "app/window/picture/display.h"
#include "app/window/system/imgui_compat.h"
#include "app/window/system/style.h"
#include "app/window/system/ui_log.h"
#include "core/base/vec.h"

#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

/// The controls that panels are made of: each a row with a label on the left and, beneath it, what the value means.
namespace tyndall {

/// The number that is being typed.
struct TextEdit {
  ImGuiID id = 0;     ///< of its box; 0: none
  std::string start;  ///< text when it began; unchanged text changes nothing
  char text[256] = {};
  bool started = false;  ///< the keyboard has reached it
  int waited = 0;        ///< drawings before it was reached
  bool next = false;     ///< Tab: the next box in the column is typed into
};

/// The number that is being dragged.
struct NumberDrag {
  double start = 0;   ///< its value when the drag began; on a slider where the mouse was
  Slider range;       ///< of the slider
  float offset = 0;   ///< from the mouse to the middle of the slider's grab
  double last = 0;    ///< where the mouse was in the drawing before
  double travel = 0;  ///< how far the mouse went, window units; with Shift a tenth of it counts
  bool moved = false;
  bool reset = false;   ///< the value was set back: the mouse changes nothing until it is let go
  double before = 0;    ///< the value when the button went down
  bool active = false;  ///< a number is being dragged in this drawing
  bool cancel = false;  ///< set it back, in this drawing
};

/// A row of the column by the part and the label under which it is seen; without a label the part's heading.
struct RowPlace {
  std::string part, label;
};

/// A row of the column as the palette knows it.
struct RowEntry {
  std::string part, label;
  std::string words;  ///< other words for it, separated by ", "
  std::string owner;  ///< whose it is: the title of an object, else its section
};

/// The row that the column was sent to. In the first drawing its section is opened, in the second it is scrolled to, in
/// the third the keyboard goes there: into its first number, or to its choices, through which the arrow keys go then.
struct SoughtRow {
  RowPlace place;         ///< of the last one, until there is another
  int drawing = -1;       ///< from 0 on; -1: the keyboard is there
  bool met = false;       ///< in this drawing; of several rows of that label the first one counts
  bool here = false;      ///< it is being drawn
  bool types = false;     ///< the next number belongs to it and is to be typed into
  bool has_keys = false;  ///< it is a choice, and the arrow keys go through it
  float top = 0;          ///< of the row while it is drawn
};

/// Which window the wheel scrolls.
struct WheelOwner {
  ImGuiID owner = 0;  ///< that scrolled last; 0: none
  double last = -10;  ///< when, seconds
  bool used = false;  ///< in this drawing, by a list
};

/// What is asked for: a command by its name, with an argument where it takes one.
struct Request {
  std::string command, argument{};
  bool operator==(const Request&) const = default;
};

/// What a row of a number shows.
struct Row {
  std::string name;  ///< in the log and in messages: "fuzz"
  std::string label;
  Valid valid;
  Slider slider;
  const char* unit = "";
  std::string help;      ///< tooltip
  std::string meaning;   ///< grey line beneath; "": none
  std::string words{};   ///< by which the palette finds it, too, separated by ", "
  bool whole = false;    ///< whole numbers only
  bool warning = false;  ///< the line beneath is one
  std::optional<Vec3d> original =
      std::nullopt;       ///< what a double click sets: what the scene's file has; of single numbers x
  std::string pointer{};  ///< of the scene's value that it shows: its menu has Vary and Key; "": it shows none
};

/// What all controls share. One per window; lives as long as it.
struct Ui {
  Fonts fonts;
  float scale = 1;       ///< window units per unit of the design
  float pixels = 0;      ///< font pixels per unit of the design; 0: the fonts are not loaded yet
  UiLog* log = nullptr;  ///< null: none
  std::string scope;     ///< prefix of names in the log: "gold." or ""
  double size = 10;      ///< of the scene: dragging a coordinate by 200 units of the design changes it by this much
  TextEdit edit;
  NumberDrag drag;
  ImGuiID hovered = 0;  ///< the control under the mouse, whose tooltip comes after a moment; 0: none
  double hovered_since = 0;
  WheelOwner wheel;
  SoughtRow sought;
  RowPlace drawn;                         ///< the part of the column that is being drawn, and its section
  double wake_in = 1e300;                 ///< seconds until something appears by itself
  bool has_question = false;              ///< a dialog waits for an answer: the column takes no input
  bool close_popup = false;               ///< a list or a picker that is open closes in this drawing
  std::vector<RowEntry>* rows = nullptr;  ///< gets each row that is drawn; null: nobody asks
  std::vector<Request> requests;          ///< of controls, until they are carried out
  std::string problem;                    ///< why a typed value was refused: one line; "": it was not
  std::set<std::string> folded;           ///< sections that are closed
};

/// Puts a prefix before the names of controls in the log, and makes them distinct, as long as it lives.
class Scope {
 public:
  Scope(Ui& ui, const std::string& name) : ui_(ui), before_(ui.scope) {
    ui.scope += name + ".";
    ImGui::PushID(ui.scope.c_str());
  }
  ~Scope() {
    ImGui::PopID();
    ui_.scope = before_;
  }
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;

 private:
  Ui& ui_;
  std::string before_;
};

/// Text has a font as long as it lives.
class WithFont {
 public:
  explicit WithFont(ImFont* font) { compat::push_font(font); }
  ~WithFont() { ImGui::PopFont(); }
  WithFont(const WithFont&) = delete;
  WithFont& operator=(const WithFont&) = delete;
};

/// Sends the column to a row, in this drawing and the next two.
void seek_row(Ui& ui, const RowPlace& place);
/// At the end of a drawing of the column: goes on with what was sought.
void go_on_seeking(Ui& ui);
/// Whether the column was sent last to the row of this label in the part that is being drawn.
bool is_sought(const Ui& ui, const std::string& label);

/// A heading with a note on the right; a click folds the section. Returns whether it is open.
bool section(Ui& ui, const std::string& name, const std::string& note);

/// Label, slider, typed value. Returns whether the value changed; it is then in row.valid.
bool slider_row(Ui& ui, const Row& row, double& value);
/// Label and three numbers to drag or type.
bool vector_row(Ui& ui, const Row& row, Vec3d& value);
/// Label, three numbers and a swatch that opens a picker. Linear RGB; radiance may exceed 1.
bool colour_row(Ui& ui, const Row& row, Vec3d& value);
/// One of the buttons of a choice.
struct Choice {
  std::string name;
  const char* missing = nullptr;  ///< not null: it cannot be chosen, and why
  const char* help = "";          ///< tooltip
};
/// Label and buttons side by side, one of them chosen; names are also the log's. In several lines if `columns` > 0 is
/// less than their number. What is missing is grey and says why.
bool choice_row(Ui& ui, const Row& row, std::span<const Choice> choices, int& chosen, int columns = 0);
/// Label and a list that drops down; what is missing is grey, says why, and cannot be chosen.
bool combo_row(Ui& ui, const Row& row, std::span<const Choice> choices, int& chosen);
/// Label and a text to type. hint: shown grey where it is empty. begin: typing begins now.
bool name_row(Ui& ui, const Row& row, const std::string& hint, bool begin, std::string& value);
/// Label and the name of a file.
void file_row(Ui& ui, Row row, const std::string& file);
/// A small button in the label's column or anywhere; logged as `name`.
bool small_button(Ui& ui, const std::string& name, const std::string& label, float width = 0);
/// Grey small text, wrapped. indent: start in the column of the values.
void note(Ui& ui, const std::string& text, bool indent = true, Tone colour = palette::dim);
/// The same on one line, cut where it does not fit, with all of it in a tooltip; and the height that this takes.
void line_of_note(Ui& ui, const std::string& text, Tone colour);
float line_of_note_height(const Ui& ui);

/// The text at a place of the window, cut and with ".." at its end where it is wider than `width`.
void clipped_text_at(const std::string& text, ImVec2 at, float width, Tone colour);

/// A picture in the middle of a place of the window, as large as that allows.
void draw_fitted(const PictureTexture& picture, const Rect& place, float rounding);

/// A part of the window with controls, in a window of Dear ImGui's own. padding: around what `draw` puts into it.
void draw_part(Ui& ui, const char* name, const Rect& where, ImGuiWindowFlags more, ImVec2 padding,
               const std::function<void()>& draw);
inline constexpr ImGuiWindowFlags stays_behind = ImGuiWindowFlags_NoBringToFrontOnFocus;
/// Of a bar beneath the picture.
inline constexpr ImGuiWindowFlags bar_flags =
    stays_behind | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoNav;

/// Whether a list or a colour picker is open.
bool popup_is_open();

/// Begins to type into the box of that number.
void begin_typing(Ui& ui, ImGuiID id, const std::string& text);
/// The box that is typed into; it is the last item then. Returns whether typing has ended: ui.edit has the text.
bool type_text(Ui& ui, const char* hint, float width);

/// Parts that rows are made of.
bool slider(Ui& ui, const Row& row, double& value, float width);
bool value_box(Ui& ui, const char* id, const Row& row, double& value, float width, bool fixed_digits);
void begin_row(Ui& ui, const Row& row);
/// Opens the menu of a row by a right click on the last item, and draws it. can_vary: it has Vary, too.
void row_menu(Ui& ui, const Row& row, bool can_vary);
void end_row(Ui& ui, const Row& row);
/// Shows a tooltip over the last item after a moment.
void tooltip(Ui& ui, const std::string& text);
/// Tells the log about the last item, if any of it is on the screen.
void log_item(Ui& ui, const std::string& name, const std::string& value);

/// Width of what lies right of the label.
float value_width(const Ui& ui);

}  // namespace tyndall
