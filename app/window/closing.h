#pragma once
#include "app/window/dialog.h"
#include "app/window/session.h"

/// How the window closes without losing anything.
namespace tyndall {

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
    asking,  ///< whether to save
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
