#pragma once
#include "app/window/handles/handles.h"
#include "app/window/system/ui_log.h"

#include <string>

/// How the handles look.
namespace tyndall {

/// Draws the handles over the picture, the hovered one bright. only: just that one, while it is dragged.
void draw_handles(const PictureFrame& frame, const std::vector<Handle>& handles, const std::optional<Handle>& hovered,
                  bool only);
/// What is being done, at the foot of the picture.
void draw_handle_text(const PictureFrame& frame, const std::string& text);
/// Tells the log where each handle can be taken. names: of the handles.
void log_handles(UiLog& log, const std::vector<Handle>& handles, const std::vector<std::string>& names, double scale);

}  // namespace tyndall
