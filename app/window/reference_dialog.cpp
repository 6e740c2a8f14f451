#include "app/window/overlays.h"
#include "app/window/system/imgui_compat.h"

/// The dialog that asks which picture errors are measured against.
namespace tyndall {

void ask_reference(Dialog& dialog) { dialog = {Dialog::Kind::reference, {}, true, 0}; }

ReferenceWish draw_reference_dialog(Ui& ui, const Rect& area, Dialog& dialog, bool has_reference) {
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
  ReferenceWish wish;
  wish.render = answer == 1, wish.drop = has_reference && answer == 2;
  if ((enter || answer == 0) && dialog.name[0] != '\0') wish.file = typed_file(dialog);
  dialog.fresh = false;
  if (answer > 0 || wish.file) dialog.kind = Dialog::Kind::none;
  end_dialog();
  return wish;
}

}  // namespace tyndall
