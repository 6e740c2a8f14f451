#pragma once
#include "app/window/document/job_queue.h"
#include "app/window/panels/context.h"
#include "app/window/panels/widgets.h"
#include "app/window/picture/display.h"
#include "core/scene/slots.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

/// This room shows what a value does: small pictures of the scene with the values of a row in steps.
namespace tyndall {

/// A small picture while it sharpens.
struct SmallPicture {
  int width = 0, height = 0;
  std::vector<float> rgb;  ///< linear, top row first
  std::uint32_t spp = 0;
};

/// What small renders are asked for.
struct SmallRequest {
  std::size_t count = 0;  ///< of pictures
  /// The scene of a picture, in the size that it is to have; nothing: there is none. Called in the background.
  std::function<std::optional<Scene>(std::size_t index)> scene;
  bool clean = false;  ///< pictures are filtered
  int threads = 1;     ///< for the first picture of each
};

/// Renders several small pictures in the background: first all of them with few samples, as quickly as it can, so that
/// they stand after a moment; then they sharpen in turn, on one thread of the lowest priority, so that the main picture
/// does not wait for them. For the main thread.
class SmallRenders {
 public:
  /// wake: collect() has something to do; called from any thread.
  explicit SmallRenders(const std::function<void()>& wake) : first_(wake), further_(wake) {}
  ~SmallRenders() { ++number_; }

  /// Takes the place of what was asked for before, and forgets its pictures. An empty one: renders nothing any more.
  void request(SmallRequest request);

  /// Takes what has come. Whether there was anything.
  bool collect();
  /// The newest picture of each; null: none yet, or there is none.
  const std::vector<std::shared_ptr<const SmallPicture>>& pictures() const { return pictures_; }
  /// Whether all pictures have all their samples.
  bool finished() const { return first_.idle() && further_.idle(); }
  /// Seconds from the request until all pictures stood; 0: they do not stand yet.
  double seconds_to_stand() const { return stood_after_; }

 private:
  struct Work;
  JobQueue::Job job(const std::shared_ptr<Work>& work, std::size_t index, std::uint32_t samples);

  std::vector<std::shared_ptr<const SmallPicture>> pictures_;
  double stood_after_ = 0;
  std::atomic<std::uint64_t> number_ = 0;  ///< counts the requests; jobs of earlier ones give up
  JobQueue first_, further_;               // last: their jobs use the others
};

/// A value of the scene and the steps in which it is shown.
struct VariedValue {
  Slot slot;
  std::vector<double> values{};
  int marked = -1;  ///< the step that the scene has now; -1: none
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
  std::size_t rows() const { return axes_.size() > 1 ? strip_rows : 1; }
  std::size_t count() const { return strip_columns * rows(); }
  Rect cell_at(const Rect& rect, std::size_t index, float scale) const;
  double update(const Context& context, const Rect& rect, const Scene& scene, float scale);
  void ask(const Context& context, const Rect& rect, float scale);
  void show_pictures(const Display& display);
  bool draw_cell(Ui& ui, const Rect& cell, std::size_t index) const;

  std::vector<VariedValue> axes_;  ///< one or two; none: the strip is closed
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
