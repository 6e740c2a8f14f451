#pragma once
#include "app/curves/curve.h"
#include "app/window/accuracy/half.h"
#include "app/window/actions/actions.h"
#include "app/window/document/document.h"
#include "app/window/document/message.h"
#include "app/window/panels/widgets.h"
#include "app/window/tools/outline.h"
#include "core/render/frame.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// What is drawn over and beneath the picture: status line, messages, help table, dialogs, the selection's outline.
namespace tyndall {

/// A part of the status line: a grey word and a value.
struct StatusCell {
  std::string key, value;
  int rank = 0;  ///< the cells of the highest rank go first when there is no room
  bool warning = false;
};

struct StatusState {
  bool paused = false;
  bool is_true = false;                   ///< errors are against a reference, not estimated
  bool split = false;                     ///< the frame is the right half, B
  bool edited = false;                    ///< the document differs from its file
  const ErrorCurve* clean_run = nullptr;  ///< how the error of its clean view fell; null: not known
};

/// The parts for a state of things. frame: what is on the screen, may be null; run: how its error fell.
std::vector<StatusCell> status_cells(const Frame* frame, const ErrorCurve& run, const Document& document,
                                     StatusState state);

/// Which cells fit: drops those of the highest rank, last ones first, until the rest is at most `room` wide.
std::vector<std::size_t> fitting_cells(const std::vector<StatusCell>& cells, const std::vector<float>& widths,
                                       float room);

void draw_status(Ui& ui, const Rect& rect, const std::vector<StatusCell>& cells);

/// A box above the status line.
void draw_message(Ui& ui, const Rect& area, const Message& message);

/// The table of inputs; sets `open` to false when it is clicked away.
void draw_help(Ui& ui, bool& open);

void draw_outline(Ui& ui, const Rect& image, const std::vector<ImageLine>& lines);

/// A question that waits for an answer.
struct Dialog {
  enum class Kind {
    none,
    comments,
    overwrite,
    save_as,
    replace,
    open,
    reference,
    close,
    changed_file,
    halves
  } kind = Kind::none;
  char name[512] = {};  ///< of the file that is typed
  bool fresh = false;   ///< it was opened in this drawing
  int marked = 0;       ///< number of the answer that Return gives; at first the one that loses nothing
};

void ask_name(Dialog& dialog, const std::filesystem::path& suggestion);
/// A text field for the name of a file, which takes the keyboard at first. Returns whether Return was pressed in it.
bool draw_name_field(Ui& ui, Dialog& dialog, const char* hint);
/// The file whose name was typed: "~/" stands for the home folder, as in a shell.
std::filesystem::path typed_file(const Dialog& dialog);
/// Draws the question; returns the file to write once that is decided. empty path: the document's own.
std::optional<std::filesystem::path> draw_dialog(Ui& ui, const Rect& area, Dialog& dialog, const Document& document);

/// Asks which file to open.
std::optional<std::filesystem::path> draw_open_dialog(Ui& ui, const Rect& area, Dialog& dialog);

/// Asks whether to take what another program has written into the open file, or to keep the edits. Returns true: take.
std::optional<bool> draw_changed_file_dialog(Ui& ui, const Rect& area, Dialog& dialog, const Document& document);

/// Asks which half of a split view to keep. method_a, method_b: how the halves are rendered.
std::optional<Half> draw_halves_dialog(Ui& ui, const Rect& area, Dialog& dialog, const std::string& method_a,
                                       const std::string& method_b);

/// Asks what errors are measured against.
void ask_reference(Dialog& dialog);
std::optional<Request> draw_reference_dialog(Ui& ui, const Rect& area, Dialog& dialog, bool has_reference);

/// A box with round corners in the middle of the area, for a question.
void begin_dialog(Ui& ui, const Rect& area);
struct Answer {
  const char* name;  ///< in the log
  std::string label;
};
/// A row of buttons, the last part of a dialog. Tab and the arrow keys mark another one, Return and the space bar press
/// the marked one, unless a text field has the keyboard. Returns the number of the one that was pressed, -1: none.
int draw_answers(Ui& ui, Dialog& dialog, std::span<const Answer> answers);
void end_dialog();

}  // namespace tyndall
