#pragma once
#include "app/window/panels/widgets.h"
#include "app/window/session.h"

#include <optional>
#include <string>
#include <vector>

/// The questions that the window asks, and how it closes without losing anything.
namespace tyndall {

/// A button of a dialog, and what it asks for.
struct Answer {
  const char* name;  ///< in the log
  std::string label;
  std::optional<Request> request{};  ///< nothing: the dialog goes, and that is all
};

/// Nothing happens.
inline const Answer cancel_answer{"dialog.cancel", "Cancel"};

/// A question that waits for an answer.
struct Dialog {
  std::string question{}, note{};  ///< no question: there is no dialog
  std::vector<Answer> answers{};
  int marked = 0;              ///< number of the answer that Return gives; at first the one that loses nothing
  const char* hint = nullptr;  ///< not null: the name of a file is typed, the first answer's text; grey without one
  enum class Kind { other, changed_file, halves } kind = Kind::other;
  char name[512] = {};
  bool fresh = true;  ///< it was not drawn yet
};

/// Draws the question, which goes once it is answered. Returns what the answer asks for.
std::optional<Request> draw_dialog(Ui& ui, const Rect& area, Dialog& dialog);

/// The box of all dialogs and messages, at a place of the window; pivot: the point of the box that is there, as parts
/// of its size.
void begin_box(Ui& ui, const char* name, ImVec2 at, ImVec2 pivot, ImGuiWindowFlags more);
void end_box();

/// Asks about edits that were not saved, then waits until all files are written; if one cannot be, the window stays
/// open and says so. For the main thread.
class Closing {
 public:
  explicit Closing(Session& session) : session_(session) {}

  /// The user wants to close the window. dialog: the window's; a question in it is replaced.
  void begin(Dialog& dialog);
  /// Draws the progress, and goes on. To be called before the dialog is drawn.
  void draw(Ui& ui, const Rect& area, const Dialog& dialog);
  /// The user has chosen to save, which the caller does, perhaps after questions of its own in the dialog.
  void save() { step_ = Step::saves; }
  /// The user does not want the edits.
  void discard();
  /// Stays open after all. Returns whether the window was waiting for files.
  bool cancel();
  /// The window may go.
  bool done() const { return step_ == Step::done; }

 private:
  enum class Step {
    none,
    saves,   ///< the user chose to; questions of saving may be open
    writes,  ///< files are still being written
    done
  };
  void draw_progress(Ui& ui, const Rect& area);
  void finish();
  void leave();

  Session& session_;
  Step step_ = Step::none;
  bool discards_ = false;       ///< the user does not want the edits
  double since_ = 0;            ///< clock second at which writing began to be waited for
  int errors_before_ = 0;       ///< that were said before
  bool paused_before_ = false;  ///< rendering was paused when that began
};

}  // namespace tyndall
