#pragma once
#include "app/window/panels/split_view.h"
#include "app/window/picture/display.h"
#include "app/window/session.h"
#include "app/window/system/mouse.h"
#include "app/window/system/platform.h"

#include <memory>

/// What is drawn behind the interface: the picture, or the two pictures of a split view.
namespace tyndall {

/// The picture in the window: which frames are on the screen, how they are shown, and the divider of a split view.
class PictureView {
 public:
  /// Lives within the window's OpenGL context. Throws IoError if the shaders do not compile.
  explicit PictureView(Session& session);

  /// A frame that is not on the screen yet. If both halves have one: the right half's if it is finished, else the left
  /// half's. Null: there is none.
  std::shared_ptr<const Frame> unseen() const;
  /// Puts the newest frames on the screen, with the next drawing, and tells the session.
  void take();
  /// The drawing is on the screen: tells the renderers.
  void note_shown();
  /// The frame that is on the screen, of the right half in a split view; null: there is none.
  const std::shared_ptr<const Frame>& shown() const { return right_.frame; }

  /// The divider of a split view and what is said of its halves.
  void draw_halves(Ui& ui, const Rect& image) const;
  /// Moves the divider with the mouse. free: nothing else has the mouse. Returns whether the divider has it.
  bool drag_divider(Ui& ui, const Rect& image, const Mouse& mouse, bool free);
  /// Draws the picture, or both halves, beneath the interface and shows the whole drawing. stops: as Look says;
  /// squares: enlarged pixels are squares.
  void show(Platform& platform, const Layout& layout, bool stops, bool squares);

 private:
  /// A half, and what its display holds: its frame or a map of errors, and how that looks.
  struct Side {
    std::shared_ptr<const Frame> frame;
    std::shared_ptr<const void> uploaded;
    Look look;
    std::unique_ptr<FrameDisplay> display;
  };
  bool shows_halves() const;
  bool shows_raw_beside() const;
  SplitLabels labels() const;
  static std::shared_ptr<const CleanFrame> clean_of(const std::shared_ptr<const Frame>& frame);
  Look look_of(const Frame& frame, bool stops) const;
  static void upload(Side& side, const std::shared_ptr<const void>& what, const ShownPicture& picture,
                     const Look& look);
  void upload_frame(Side& side, const std::shared_ptr<const Frame>& frame, bool clean, bool stops);
  void upload_all(bool stops);
  std::string text_of(Half half) const;

  Session& session_;
  Side left_, right_;  ///< without a split view all is in right_
  Divider divider_;
};

}  // namespace tyndall
