#pragma once
#include "app/window/panels/context.h"
#include "app/window/panels/widgets.h"
#include "app/window/picture/display.h"
#include "app/window/rendering/renderer_pair.h"
#include "app/window/system/input_events.h"
#include "app/window/system/platform.h"

#include <memory>
#include <string>

/// What is drawn behind the interface: the picture, or the two pictures of a split view side by side, A on the left of
/// a divider, B on its right.
namespace tyndall {

/// Where the divider is.
struct Divider {
  float part = 0.5f;  ///< of the image's width
  bool hovered = false, dragged = false;

  float x(const Rect& image) const { return image.x0 + part * image.width(); }
  /// Whether a press at that place takes the divider. reach: to either side.
  bool is_at(const Rect& image, float mouse_x, float mouse_y, float reach) const;
  /// Goes along with the mouse while it is dragged; to be called in each drawing. free: nothing else has the mouse.
  /// Returns whether the divider has the mouse.
  bool follow(const Mouse& mouse, const Rect& image, bool free, float reach);
  /// Goes to the mouse; a little of each half stays.
  void drag_to(const Rect& image, float mouse_x);
};

/// Divider, and in the upper corners of the halves what they are.
void draw_split(Ui& ui, const Rect& image, const Divider& divider, const std::string& a, const std::string& b);

/// The picture in the window: which frames are on the screen, how they are shown, and the divider of a split view.
class PictureView {
 public:
  /// Lives within the window's OpenGL context. Throws IoError if the shaders do not compile.
  PictureView(RendererPair& renderers, const LiveAccuracy& accuracy) : renderers_(renderers), accuracy_(accuracy) {
    right_.display = std::make_unique<FrameDisplay>();
  }

  /// A frame that is not on the screen yet. If both halves have one: the right half's if it is finished, else the left
  /// half's. Null: there is none.
  std::shared_ptr<const Frame> unseen() const;
  /// Puts the newest frame of a half on the screen, with the next drawing. Returns it; null: there is no new one.
  std::shared_ptr<const Frame> take(Half half);
  /// The drawing is on the screen: tells the renderers.
  void note_shown();
  /// The frame that is on the screen, of the right half in a split view; null: there is none.
  const std::shared_ptr<const Frame>& shown() const { return right_.frame; }

  /// The divider of a split view and what is said of its halves.
  void draw_halves(Ui& ui, const Context& context) const;
  /// Moves the divider with the mouse. free: nothing else has the mouse. Returns whether the divider has it.
  bool drag_divider(Ui& ui, const Mouse& mouse, bool free, const Context& context);
  /// Draws the picture, or both halves, beneath the interface and shows the whole drawing. Returns what the screen
  /// could not take, a sentence; "": it took all. display: as it is now.
  std::string show(Platform& platform, const Context& context, const Display& display);

 private:
  /// A half, and what its display holds: its frame or a map of errors, and how that looks.
  struct Side {
    std::shared_ptr<const Frame> frame;
    std::shared_ptr<const void> uploaded;
    Look look;
    std::unique_ptr<FrameDisplay> display;
  };
  bool shows_halves(const Context& context) const;
  bool shows_raw_beside(const Context& context) const;
  static void upload(Side& side, const std::shared_ptr<const void>& what, const ShownPicture& picture,
                     const Look& look);
  static void upload_frame(Side& side, const std::shared_ptr<const Frame>& frame, bool clean, const Look& look);
  void upload_all(const Context& context, const Display& display);
  std::string text_of(Half half, std::string method) const;

  RendererPair& renderers_;
  const LiveAccuracy& accuracy_;
  Side left_, right_;  ///< without a split view all is in right_
  Divider divider_;
};

}  // namespace tyndall
