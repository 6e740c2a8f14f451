#pragma once
#include "app/window/panels/context.h"
#include "app/window/panels/widgets.h"
#include "app/window/picture/display.h"
#include "app/window/variations/small_renders.h"
#include "core/scene/slots.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tyndall {

/// A value of the scene and the steps in which it is shown.
struct VariedValue {
  Slot slot;
  std::vector<double> values{};
};

inline constexpr int strip_columns = 9, strip_rows = 3;

/// Even steps over the slider's range, or over the power of ten around a value beyond it. The step next to the present
/// value is that value.
std::vector<double> varied_values(const Slot& slot, double present, int steps);

/// The strip of small pictures along the bottom of the window: one row of them, and three where a second value varies.
/// Lives within the window's OpenGL context; for the main thread.
class VariationStrip {
 public:
  /// wake: a picture has come; called from any thread.
  explicit VariationStrip(const std::function<void()>& wake) : renders_(wake) {}

  bool is_open() const { return !axes_.empty(); }
  /// Opens the strip for a value of the scene; once it is open, another value becomes the second one, and one that is
  /// shown already goes. slot: of a number, as it is now.
  void vary(const Slot& slot);
  void close();

  /// Height in window units of a strip of that width, for a picture of that shape.
  float height(float width, int image_width, int image_height, float scale) const;
  /// In each drawing: asks for the pictures of the scene, and draws them. Returns the scene whose picture was clicked,
  /// or to which the arrow keys went.
  std::optional<Scene> draw(Ui& ui, const Context& context, const Rect& rect, const Scene& scene);
  /// Arrow keys go through the pictures; key: GLFW's number. Returns whether it was meant for the strip.
  bool take_key(int key);
  /// Whether there is something new to draw.
  bool collect() { return renders_.collect(); }
  /// All pictures have all their samples.
  bool at_rest() const { return renders_.finished(); }

 private:
  struct Cell {
    std::shared_ptr<const SmallPicture> shown;
    std::unique_ptr<PictureTexture> texture;
  };
  int rows() const { return axes_.size() > 1 ? strip_rows : 1; }
  std::size_t count() const { return static_cast<std::size_t>(strip_columns * rows()); }
  Rect cell_at(const Rect& rect, std::size_t index, float scale) const;
  double update(const Context& context, const Rect& rect, const Scene& scene, float scale);
  void ask(const Context& context, const Rect& rect, float scale);
  void show_pictures(const Display& display);
  bool draw_cell(Ui& ui, const Rect& cell, std::size_t index) const;

  std::vector<VariedValue> axes_;  ///< one or two; none: the strip is closed
  std::vector<int> marked_;        ///< the step of each axis that the scene has now; -1: none
  std::vector<Cell> cells_;
  std::optional<Scene> base_;          ///< of the pictures, with the first step of each value
  std::uint64_t seen_changes_ = 0;     ///< Context::changes of the scene that was looked at last
  double changed_at_ = 0;              ///< when the scene became another one, seconds
  bool stale_ = true, clean_ = false;  ///< the pictures are of another scene
  int width_ = 0, height_ = 0;         ///< of the pictures, pixels
  Display display_;                    ///< how the textures show them
  std::array<int, 2> move_{};          ///< where the arrow keys go in the next drawing: right and down
  SmallRenders renders_;
};

}  // namespace tyndall
