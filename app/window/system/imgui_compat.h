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

// Input for tests without a window. Before 1.87 there is no event queue: the fields are written directly, before
// ImGui::NewFrame().
inline void mouse_pos(ImGuiIO& io, float x, float y) {
#if IMGUI_VERSION_NUM >= 18700
  io.AddMousePosEvent(x, y);
#else
  io.MousePos = ImVec2(x, y);
#endif
}
inline void mouse_button(ImGuiIO& io, int button, bool down) {
#if IMGUI_VERSION_NUM >= 18700
  io.AddMouseButtonEvent(button, down);
#else
  io.MouseDown[button] = down;
#endif
}
inline void control_key(ImGuiIO& io, bool down) {
#if IMGUI_VERSION_NUM >= 18700
  io.AddKeyEvent(ImGuiMod_Ctrl, down);
#else
  io.KeyCtrl = down;
#endif
}
inline void key(ImGuiIO& io, ImGuiKey name, bool down) {
#if IMGUI_VERSION_NUM >= 18700
  io.AddKeyEvent(name, down);
#else
  io.KeysDown[io.KeyMap[name]] = down;
#endif
}

/// What the backends of a window would have set up.
inline void init_without_window(ImGuiIO& io) {
#if IMGUI_VERSION_NUM < 18700
  for (int k = 0; k < ImGuiKey_COUNT; ++k) io.KeyMap[k] = k;
#endif
#if IMGUI_VERSION_NUM >= 19200
  io.BackendFlags |= ImGuiBackendFlags_RendererHasTextures;
#else
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
#endif
}
/// After ImGui::Render() without a renderer.
inline void textures_without_window() {
#if IMGUI_VERSION_NUM >= 19200
  for (ImTextureData* texture : ImGui::GetPlatformIO().Textures) {
    if (texture->Status == ImTextureStatus_WantCreate) texture->SetTexID(1);
    if (texture->Status == ImTextureStatus_WantDestroy) {
      texture->SetTexID(ImTextureID_Invalid);
      texture->SetStatus(ImTextureStatus_Destroyed);
    } else {
      texture->SetStatus(ImTextureStatus_OK);
    }
  }
#endif
}

}  // namespace tyndall::compat
