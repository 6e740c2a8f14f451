#pragma once
#include "app/window/overlays.h"
#include "app/window/panels/panels.h"
#include "app/window/panels/split_view.h"
#include "app/window/session.h"
#include "app/window/system/display.h"
#include "app/window/system/pacing.h"
#include "app/window/system/platform.h"

#include <atomic>
#include <memory>

namespace tyndall {

/// What the mouse does in the picture.
struct PointerDrag {
  int button = -1;  ///< -1: nothing is pressed
  bool moved = false;
};

/// The window: waits for events, draws when there is something new, hands edits to the session.
class MainWindow {
 public:
  /// reference: null: none.
  MainWindow(const WindowOptions& options, std::shared_ptr<const Reference> reference);
  /// Until the window is closed.
  void run();

 private:
  // main_window.cpp
  bool hidden() const;
  double waiting_time(double now);
  std::shared_ptr<const Frame> unseen() const;
  bool picture_due(double now) const;
  void draw(double now);
  void draw_interface(const Layout& layout);
  void finish_drawing(double now, double cpu_before, bool fresh);
  void update_scale();
  void apply_panels(double now);

  // window_picture.cpp
  void take_pictures();
  void draw_halves(const Layout& layout);
  void show_picture(const Layout& layout);
  void upload_pictures();
  bool shows_halves() const;

  // window_input.cpp
  void take_input(const InputEvents& events);
  void act(Action action);
  void act_on_document(Action action);
  void reset_camera();
  void save();
  void save_as();
  void select_view(int view);
  void frame_selection();
  void escape();
  void pointer(const Layout& layout, double now);
  void drag(const Layout& layout, float dx, float dy);
  bool drag_divider(const Layout& layout);
  void click(const Layout& layout);
  void wheel(double now);
  void fly(double now);
  void count_gestures(double now);

  std::unique_ptr<UiLog> log_;
  Platform platform_;
  FrameDisplay display_;
  std::unique_ptr<FrameDisplay> left_display_;  ///< of the left half of a split view
  std::atomic<double> due_ = 0;                 ///< clock second from which on a frame wakes the window
  std::atomic<bool> posted_ = false;
  Session session_;
  std::vector<BuiltIn> scenes_;
  Ui ui_;
  PanelState panels_;
  Pacing pacing_;
  Dialog dialog_;
  PointerDrag pointer_;
  Divider divider_;
  std::shared_ptr<const Frame> shown_, shown_kept_;
  std::uint64_t gesture_ = 1, paced_edit_ = 0;
  double wheel_time_ = -1, fly_time_ = -1;
  std::shared_ptr<const void> uploaded_, uploaded_left_;  ///< the frames or map that the displays hold
  float pixels_ = 0;
  int shown_view_ = 0;
  bool help_ = false, columns_ = true, was_held_ = false;
  std::string window_title_;
};

}  // namespace tyndall
