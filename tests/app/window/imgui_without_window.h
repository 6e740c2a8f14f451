#pragma once
#include "app/window/system/imgui_compat.h"

/// Dear ImGui 1.86 and later versions without a window, for tests.
namespace tyndall::compat {

// Input. Before 1.87 there is no event queue: the fields are written directly, before ImGui::NewFrame().
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
inline void mouse_wheel(ImGuiIO& io, float notches) {
#if IMGUI_VERSION_NUM >= 18700
  io.AddMouseWheelEvent(0, notches);
#else
  io.MouseWheel += notches;
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
