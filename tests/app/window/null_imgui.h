#pragma once
#include "app/window/system/imgui_compat.h"

#include <utility>

/// Dear ImGui 1.86 and later versions without a window or a display, for tests.
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

namespace tyndall::test {

/// Frames are built and thrown away; input is what a test's hands do.
class NullImGui {
 public:
  explicit NullImGui(float width = 1280, float height = 720) : context_(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.DisplaySize = {width, height};
    io.DeltaTime = 1.0f / 60;
    compat::init_without_window(io);
    compat::mouse_pos(io, -1, -1);
  }
  ~NullImGui() {
#if IMGUI_VERSION_NUM >= 19200
    for (ImTextureData* texture : ImGui::GetPlatformIO().Textures) texture->SetStatus(ImTextureStatus_Destroyed);
#endif
    ImGui::DestroyContext(context_);
  }
  NullImGui(const NullImGui&) = delete;
  NullImGui& operator=(const NullImGui&) = delete;

  template <class F>
  void frame(F&& draw) {
    compat::new_frame();
    std::forward<F>(draw)();
    ImGui::Render();
    compat::textures_without_window();
  }

 private:
  ImGuiContext* context_;
};

/// Characters for the control that has the keyboard.
inline void type_text(const char* text) {
  for (const char* c = text; *c; ++c) ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(*c));
}

}  // namespace tyndall::test
