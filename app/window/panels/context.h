#pragma once
#include "app/window/accuracy/live_accuracy.h"
#include "app/window/gallery/gallery.h"
#include "app/window/system/layout.h"
#include "core/render/frame.h"
#include "core/scene/load.h"

#include <memory>
#include <string>
#include <vector>

namespace tyndall {

/// What a drawing of the window goes by, besides the scene under edit: made once for each, and read by all that draws.
struct Context {
  Layout layout;
  Rect visible;        ///< the part of the picture that is seen
  float dots = 1;      ///< pixels of the screen in a window unit
  double seconds = 0;  ///< of the window's clock
  bool calm = true;    ///< nothing is dragged, no film plays
  std::shared_ptr<const Origin> origin = std::make_shared<const Origin>();
  std::string what;           ///< the open scene, by what load_scene takes
  std::uint64_t changes = 0;  ///< counts the edits
  bool edited = false;        ///< the scene differs from its file
  bool has_scene = true;      ///< false: a picture without one is shown
  bool renders = true;        ///< false: what is shown has no samples that could still be taken
  std::string arrived;  ///< how much is there of a picture that another program writes; "": what is shown is rendered
  std::shared_ptr<const Frame> frame;  ///< on the screen, of a split view the right half; null before the first
  RenderRequest wanted;                ///< of the renderers
  bool squares = false;                ///< enlarged pixels are squares
  int view = 0;                        ///< see view_entry()
  int clean = 0;                       ///< 0 off, 1 on, 2 beside the raw picture
  bool split = false;
  std::string method, kept_method;  ///< by which the halves of a split view are rendered
  const LiveAccuracy* accuracy = nullptr;
  bool is_true = false;  ///< errors are against a reference, not estimated
  const ErrorCurve *run = nullptr,
                   *clean_run = nullptr;  ///< how the error fell, and that of the clean view; null: not known
  bool can_show_errors = false;           ///< there is something to measure the picture against
  std::vector<BuiltIn> scenes;
  std::vector<std::filesystem::path> recent;  ///< files that were opened before, the newest first
  const SmallPictures* pictures = nullptr;    ///< of scenes; null: there are none
};

}  // namespace tyndall
