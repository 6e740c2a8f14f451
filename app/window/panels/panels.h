#pragma once
#include "app/window/accuracy/live_accuracy.h"
#include "app/window/panels/widgets.h"
#include "app/window/tools/selection.h"
#include "core/render/renderer.h"
#include "core/scene/load.h"

#include <optional>
#include <string>
#include <vector>

/// The column of panels. Panels change the scene that they are given (a copy) and leave wishes; they start nothing.
namespace tyndall {

/// What panels ask the window to do.
struct Wishes {
  std::optional<std::string> open;  ///< a scene by what load_scene takes
  std::optional<int> threads;
  bool export_chart = false;  ///< the chart's curves as files
  bool reference = false;     ///< ask for one
  std::optional<bool> split;
};

struct PanelState {
  Scene scene;          ///< edited in place
  ObjectPath selected;  ///< edited in place
  int view = 0;         ///< edited in place: see view_entry()
  Wishes wishes;        ///< out
  // What is shown.
  std::shared_ptr<const Frame> frame;  ///< null before the first
  const LiveAccuracy* accuracy = nullptr;
  std::string kept_method;       ///< of the left half of a split view; "": there is no split view
  bool can_show_errors = false;  ///< there is something to measure the picture against
  std::vector<BuiltIn> scenes;
  std::string title;  ///< of the open scene
  bool paused = false;
  int threads = 1;
};

/// All sections in the column, the chart at its foot.
void draw_column(Ui& ui, PanelState& state, const Rect& column);

void object_panel(Ui& ui, PanelState& state);
void camera_panel(Ui& ui, PanelState& state);
void background_panel(Ui& ui, PanelState& state);
void image_panel(Ui& ui, PanelState& state);
void render_panel(Ui& ui, PanelState& state);
void objects_panel(Ui& ui, PanelState& state);
void scenes_panel(Ui& ui, PanelState& state);
/// What is measured, a line for each thing that there is.
struct AccuracyLine {
  std::string text;
  bool warning = false;
};
std::vector<AccuracyLine> accuracy_lines(const LiveAccuracy& accuracy);

/// height: of the chart itself.
void chart_panel(Ui& ui, PanelState& state, float height);

/// Texture, or colour, of a material or medium, with the fields of the texture.
void colour_rows(Ui& ui, Scene& scene, ColourOrTexture& colour, const Row& row);

}  // namespace tyndall
