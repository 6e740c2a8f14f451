#include "app/window/overlays.h"
#include "app/window/system/imgui_compat.h"

/// The dialog that asks which picture errors are measured against.
namespace tyndall {

void ask_reference(Dialog& dialog) { dialog = {Dialog::Kind::reference, {}, true}; }

ReferenceWish draw_reference_dialog(Ui& ui, const Rect& area, Dialog& dialog, bool has_reference) {
  if (dialog.kind != Dialog::Kind::reference) return {};
  begin_dialog(ui, area);
  ImGui::TextUnformatted("Measure the error against");
  note(ui,
       "an image of this scene and size, best an EXR of another seed; or one that is rendered now with another seed",
       false);
  ImGui::Dummy({0, 2 * ui.scale});
  ImGui::SetNextItemWidth(420 * ui.scale);
  if (dialog.fresh) ImGui::SetKeyboardFocusHere();
  const bool enter = ImGui::InputTextWithHint("##name", "reference.exr", dialog.name, sizeof dialog.name,
                                              ImGuiInputTextFlags_EnterReturnsTrue);
  log_item(ui, "dialog.name", dialog.name);
  ImGui::Dummy({0, 4 * ui.scale});
  ReferenceWish wish;
  const bool load = small_button(ui, "dialog.load", "Load");
  ImGui::SameLine();
  wish.render = small_button(ui, "dialog.render", "Render one");
  ImGui::SameLine();
  if (has_reference) {
    wish.drop = small_button(ui, "dialog.drop", "No reference");
    ImGui::SameLine();
  }
  const bool cancel = small_button(ui, "dialog.cancel", "Cancel");
  if ((enter || load) && dialog.name[0] != '\0') wish.file = dialog.name;
  dialog.fresh = false;
  if (cancel || wish.render || wish.drop || wish.file) dialog.kind = Dialog::Kind::none;
  end_dialog();
  return wish;
}

}  // namespace tyndall
