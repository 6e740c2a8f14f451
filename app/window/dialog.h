#pragma once
#include "app/window/actions/actions.h"
#include "app/window/document/document.h"
#include "app/window/panels/widgets.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tyndall {

/// A button of a dialog, and what it asks for.
struct Answer {
  const char* name;  ///< in the log
  std::string label;
  std::optional<Request> request{};  ///< nothing: the dialog goes, and that is all
};

/// A question that waits for an answer.
struct Dialog {
  enum class Kind { none, other, close, changed_file, halves } kind = Kind::none;
  std::string question, note{};
  std::vector<Answer> answers{};
  int marked = 0;              ///< number of the answer that Return gives; at first the one that loses nothing
  const char* hint = nullptr;  ///< not null: the name of a file is typed, the first answer's text; grey without one
  char name[512] = {};
  bool fresh = true;  ///< it was not drawn yet
};

/// All questions of the window.
Dialog open_dialog();
Dialog name_dialog(const std::filesystem::path& suggestion);
/// Saving destroys something of the file: what another program has changed, else comments.
Dialog loss_dialog(const Origin& origin, bool changed);
Dialog replace_dialog(const std::filesystem::path& file);
Dialog reference_dialog(bool has_reference);
Dialog changed_file_dialog(const Origin& origin);
/// method_a, method_b: how the halves of the split view are rendered.
Dialog halves_dialog(const std::string& method_a, const std::string& method_b);
Dialog close_dialog(const Origin& unsaved);

/// Draws the question, which goes once it is answered. Returns what the answer asks for.
std::optional<Request> draw_dialog(Ui& ui, const Rect& area, Dialog& dialog);

/// A box with round corners in the middle of the area.
void begin_dialog(Ui& ui, const Rect& area);
void end_dialog();

/// The box of all dialogs and messages, at a place of the window; pivot: the point of the box that is there, as parts
/// of its size.
void begin_box(Ui& ui, const char* name, ImVec2 at, ImVec2 pivot, ImGuiWindowFlags more);
void end_box();

}  // namespace tyndall
