#include "app/window/overlays.h"
#include "app/window/system/imgui_compat.h"

/// The dialog that asks which picture errors are measured against.
namespace tyndall {

void ask_reference(Dialog& dialog) { dialog = {Dialog::Kind::reference, {}, true, 0}; }

std::optional<Request> draw_reference_dialog(Ui& ui, const Rect& area, Dialog& dialog, bool has_reference) {
  if (dialog.kind != Dialog::Kind::reference) return {};
  begin_dialog(ui, area);
  ImGui::TextUnformatted("Measure the error against");
  note(ui,
       "an image of this scene and size, best an EXR of another seed; or one that is rendered now with another seed",
       false);
  ImGui::Dummy({0, 2 * ui.scale});
  const bool enter = draw_name_field(ui, dialog, "reference.exr");
  std::vector<Answer> answers{{"dialog.load", "Load"}, {"dialog.render", "Render one"}};
  if (has_reference) answers.push_back({"dialog.drop", "No reference"});
  answers.push_back({"dialog.cancel", "Cancel"});
  const int answer = draw_answers(ui, dialog, answers);
  std::optional<Request> request;
  if (answer == 1) request = {Action::render_reference};
  if (answer == 2 && has_reference) request = {Action::drop_reference};
  if ((enter || answer == 0) && dialog.name[0] != '\0')
    request = {Action::open_reference, 0, typed_file(dialog).string()};
  dialog.fresh = false;
  if (answer > 0 || request) dialog.kind = Dialog::Kind::none;
  end_dialog();
  return request;
}

}  // namespace tyndall
