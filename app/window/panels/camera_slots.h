#pragma once
#include "app/report/contact_sheet.h"
#include "app/window/panels/widgets.h"
#include "app/window/picture/display.h"
#include "core/render/frame.h"
#include "core/scene/settings.h"

#include <memory>
#include <optional>
#include <vector>

/// Cameras that the user has put aside, each with a small picture. They last as long as the window.
namespace tyndall {

struct CameraSlot {
  Camera camera;
  std::shared_ptr<const PictureTexture> picture;  ///< null: there was none yet
};
using CameraSlots = std::vector<CameraSlot>;

inline constexpr std::size_t max_camera_slots = 8;

/// A frame as a small picture of at most 96 x 60 pixels; empty where the frame has no picture yet.
ScreenPicture small_picture(const Frame& frame, const Display& display);

/// Puts a camera into a new slot; where all are taken, the oldest goes. frame: on the screen, may be null.
void store_camera(CameraSlots& slots, const Camera& camera, const Frame* frame, const Display& display);
/// The slot that follows the one with this camera, the first one for a camera that is in none; nothing without slots.
std::optional<std::size_t> next_slot(const CameraSlots& slots, const Camera& camera);

/// Small pictures side by side: a click looks through that camera, which is returned then, a right click forgets it;
/// and a button that asks for the present one to be stored.
std::optional<Camera> camera_slots_row(Ui& ui, CameraSlots& slots, const Camera& now);

}  // namespace tyndall
