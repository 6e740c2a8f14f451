#pragma once
#include "tests/app/window/imgui_without_window.h"

#include <utility>

/// Dear ImGui for tests that draw panels where there is no display.
namespace tyndall {

/// Dear ImGui without a window: frames are built and thrown away.
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

}  // namespace tyndall
