#pragma once
#include "app/curves/curve.h"
#include "app/window/document/document.h"
#include "app/window/edit/material_edits.h"
#include "app/window/panels/context.h"
#include "app/window/panels/widgets.h"
#include "app/window/system/layout.h"
#include "app/window/system/preferences.h"
#include "app/window/tools/selection.h"
#include "core/render/frame.h"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The column of panels. Panels change the scene that they are given and leave requests; they start nothing.
namespace tyndall {

/// How many of a picture's pixels have which value on the screen.
struct Histogram {
  static constexpr std::size_t bins = 64;
  std::array<std::array<std::uint32_t, bins>, 3> counts{};  ///< of red, green, blue: from black to white
  std::uint32_t pixels = 0;                                 ///< that were counted
  double white = 0;  ///< fraction of the pixels with a channel that the screen cannot show brighter
  double black = 0;  ///< fraction of the pixels that are shown black
};

/// rgba: linear, 4 floats a pixel. Counts about 16,000 pixels, evenly spread.
Histogram histogram_of(const std::vector<float>& rgba, const Display& display);

/// The histogram of what is on the screen, kept until that changes.
class LiveHistogram {
 public:
  const Histogram& of(const Frame& frame, const Display& display);

 private:
  std::uint64_t pass_ = 0;
  const void* clean_ = nullptr;
  Display display_;
  Histogram histogram_;
};

/// How the list of objects is shown.
struct ObjectsView {
  std::string search;            ///< only objects with this text are listed; "": all
  std::set<ObjectPath> toggled;  ///< groups that are folded though they are small, or open though they are large
  ObjectPath shown;              ///< the selected object that the list has scrolled to
};

struct PanelState;

enum SectionFlag : unsigned {
  has_tab = 1,   ///< a tab leads there
  of_scene = 2,  ///< a picture without a scene does not have it
  starts_folded =
      4  ///< because it takes time with each picture; the others stay as they were from one start to the next
};

/// A section of the column, or those of objects: all that is known of it.
struct Section {
  const char* name;
  const char* heading;  ///< "": the titles of objects
  const char* words;    ///< by which the palette finds it, too
  unsigned flags;       ///< of SectionFlag
  void (*draw)(Ui& ui, PanelState& state);

  bool is(SectionFlag flag) const { return (flags & flag) != 0; }
};
/// All of them, from top to bottom.
std::span<const Section> column_sections();
/// The number of the one of that name, which is there.
int section_named(std::string_view name);

/// Which tab is lit, and which one the column is to go to.
struct ColumnTabs {
  int jump = -1;       ///< the column goes there in the next drawing; -1: nowhere
  int lit = 0;         ///< the part at the column's head, or the one that it was sent to last
  float sent = -1;     ///< how far the column was scrolled when it had gone there; < 0: it has not yet
  bool moves = false;  ///< it goes there in this drawing
};

/// What goes into the panels and comes out of them in each drawing.
struct PanelState {
  Context now;             ///< of this drawing
  bool at_window = false;  ///< the picture is to have as many pixels as the window shows
  // Panels change these in place.
  EditedScene scene;
  /// Sets a value that the scene has, in the document itself; `scene` shows it from then on.
  std::function<void(const std::string& pointer, const Value& value)> set_value;
  ObjectPath selected;           ///< whose values the panels show; empty: nothing is selected
  std::vector<ObjectPath> also;  ///< further objects that are selected with it
  bool rename = false;           ///< the name of the selected object is to be typed
  BackgroundMemory backgrounds;
  MaterialMemory materials;
  LiveHistogram histogram;
  std::map<std::string, CameraSlots> cameras;  ///< by the scene's title
  ObjectsView objects;
  ObjectPath shown;             ///< the selected object that the column has jumped to
  Preferences* look = nullptr;  ///< theme, size of texts and width of the column are changed here
  ColumnTabs tabs;
  std::vector<std::string> wanted_pictures;  ///< of these scenes, that are to be seen
};

/// All selected objects, the one whose values are shown first.
ObjectPaths all_selected(const PanelState& state);
void set_selected(PanelState& state, const ObjectPaths& paths);
/// Forgets what was searched for and remembered of another scene.
void forget_scene(PanelState& state);

/// Tabs, all sections in the column, and the chart at its foot. The column's edge can be dragged.
void draw_column(Ui& ui, PanelState& state, const Rect& column);
/// All rows that it has now, also those in folded sections. Within a frame of Dear ImGui.
std::vector<RowEntry> rows_of_column(const Ui& ui, const PanelState& state);

void object_panel(Ui& ui, PanelState& state);
void camera_panel(Ui& ui, PanelState& state);
void histogram_panel(Ui& ui, PanelState& state);
void background_panel(Ui& ui, PanelState& state);
void image_panel(Ui& ui, PanelState& state);
/// Only of a scene with an animation.
void film_panel(Ui& ui, PanelState& state);
void render_panel(Ui& ui, PanelState& state);
void objects_panel(Ui& ui, PanelState& state);
void scenes_panel(Ui& ui, PanelState& state);
/// At the end of the column's window: the wheel scrolls it unless it has scrolled a list.
void scroll_column(Ui& ui);
void window_panel(Ui& ui, PanelState& state);
/// The measured errors in words: a line for each that is known.
struct AccuracyLine {
  std::string text;
  bool warning = false;
};
std::vector<AccuracyLine> accuracy_lines(const LiveAccuracy& accuracy);

inline constexpr float chart_height = 166;  ///< of the chart itself, units of the design
void chart_panel(Ui& ui, PanelState& state);

inline constexpr double target_rel_mse = 1e-4;  ///< of 1 % relative error

/// The axes of the chart in a rectangle of the window: seconds to the right, relMSE upwards.
struct ChartAxes {
  Decades times{-1, 1}, errors{-4, 0};
  Rect frame;

  float x(double seconds) const;
  float y(double rel_mse) const;
  double seconds(float x) const;
  double rel_mse(float y) const;
};

/// Axes that hold all curves and the target.
ChartAxes axes_for(std::span<const ErrorCurve* const> curves, const Rect& frame);

/// Where names of these widths stand: side by side from the left, `gap` apart, and in further rows beneath. first: the
/// first row; a name that is wider has a row of its own.
std::vector<Rect> rows_of_names(std::span<const float> widths, const Rect& first, float gap);

/// A place on one of the curves.
struct CurveReading {
  std::size_t curve = 0;  ///< its index
  ErrorPoint at;
};

/// The curve that is nearest above or beneath a place, at that time; a curve that ends less than `reach` beside it
/// counts with its end. Nothing where there is none.
std::optional<CurveReading> nearest_curve(std::span<const ErrorCurve* const> curves, const ChartAxes& axes, float x,
                                          float y, float reach);

}  // namespace tyndall
