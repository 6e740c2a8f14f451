#pragma once
#include <imgui.h>
#include <imgui_internal.h>

/// What differs between Dear ImGui 1.86 (Debian 12) and later versions.
namespace tyndall::compat {

/// Null: the current font (1.86: the default one).
inline void push_font(ImFont* font) {
#if IMGUI_VERSION_NUM >= 19200
  ImGui::PushFont(font, font ? font->LegacySize : 0.0f);
#else
  ImGui::PushFont(font);
#endif
}

inline bool key_pressed(ImGuiKey key, bool repeats = true) {
#if IMGUI_VERSION_NUM >= 18700
  return ImGui::IsKeyPressed(key, repeats);
#else
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeats);
#endif
}

/// The modifiers that the next frame sees, whatever the keys say.
inline void modifiers(ImGuiIO& io, bool control, bool shift, bool alt, bool super) {
#if IMGUI_VERSION_NUM >= 18700
  io.AddKeyEvent(ImGuiMod_Ctrl, control);
  io.AddKeyEvent(ImGuiMod_Shift, shift);
  io.AddKeyEvent(ImGuiMod_Alt, alt);
  io.AddKeyEvent(ImGuiMod_Super, super);
#else
  io.KeyCtrl = control, io.KeyShift = shift, io.KeyAlt = alt, io.KeySuper = super;
#endif
}

/// Begins a frame. A field that nobody types into any more forgets what it could undo: typed into again it may hold
/// another text, and undoing in that would end the program.
inline void new_frame() {
  ImGui::NewFrame();
  ImGuiContext& g = *ImGui::GetCurrentContext();
  if (g.InputTextState.ID != g.ActiveId) g.InputTextState.ID = 0;
}

}  // namespace tyndall::compat
