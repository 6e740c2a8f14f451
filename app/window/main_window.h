#pragma once
#include "app/window/commands.h"
#include "app/window/edit/arrange.h"
#include "app/window/rendering/picture_view.h"
#include "app/window/timeline/timeline.h"
#include "app/window/tools/camera_control.h"
#include "app/window/tools/pointer.h"
#include "app/window/variations/strip.h"
#include "core/system/signals.h"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>

/// The window's main loop, which ties together all that the other files of this folder do.
namespace tyndall {

/// The window: waits for events, draws when there is something new, and hands edits to the session.
class MainWindow {
 public:
  /// reference: null: none.
  MainWindow(const WindowOptions& options, std::shared_ptr<const Reference> reference,
             std::unique_ptr<Platform> platform);
  /// Until the window is closed. Returns the exit code.
  int run();
  /// Waits for something to happen, and draws if there is something new. Returns whether the window stays open.
  bool step();
  /// Renders nothing from now on, or what it did before: for a window that nobody sees.
  void rest(bool rests);
  /// Waits until the file of edits that were not saved holds all of them. From any thread.
  std::string flush_edits() { return session_.flush_edits(); }

 private:
  bool hidden() const;
  double waiting_time(double now);
  bool picture_due(double now) const;
  void draw(double now);
  Context context(double now);
  void draw_interface();
  void use_mouse_and_keys(double now);
  void set_camera(const Camera& camera);
  void set_value(const std::string& pointer, const Value& value, bool scene_too);
  void take_edit(const std::string& pointer = "");
  void apply_panels(double now);
  void draw_strip(const Rect& rect);
  void draw_timeline(const Rect& rect);
  void send(double now, bool scene_too = true);
  void keep_message(double now);
  void finish_drawing(double now, double cpu_before, bool fresh);
  Layout layout_for(const WindowSize& size, int image_width, int image_height) const;
  void follow_window_size();
  void use_preferences();
  bool find_characters();
  void update_look();

  std::unique_ptr<UiLog> log_;
  std::unique_ptr<Platform> platform_;
  std::function<void()> wake_ = [this] { platform_->wake(); };  ///< called from any thread
  std::atomic<double> frame_due_ = 0;     ///< clock second from which on a renderer's frame wakes the window
  std::atomic<bool> frame_rang_ = false;  ///< one has; further ones do not until the window has looked
  Session session_;
  std::optional<SignalWatch> signals_;  ///< none where signals are left to the program that the window belongs to
  PictureView picture_;
  VariationStrip strip_{wake_};
  Timeline timeline_;
  std::uint64_t film_gesture_ = 0;   ///< going through frames is one step to undo
  std::uint64_t strip_gesture_ = 0;  ///< what is taken over from the strip is one step to undo
  Gallery gallery_{wake_};
  Ui ui_;
  PanelState panels_;
  Theme theme_ = Theme::dark;
  Characters more_characters_;                       ///< beyond the usual ones, that the names have
  std::uint64_t named_changes_ = ~std::uint64_t{0};  ///< Editor::changes() when the scene's names were looked at
  std::size_t named_files_ = 0;                      ///< of the recent files, whose names were looked at
  PointerTool pointer_;
  Flight flight_;
  GestureStart start_;
  ObjectTools objects_;
  PictureTools picture_tools_;
  Commands commands_;
  std::shared_ptr<const Origin> noted_;  ///< the file of the recent ones that was noted last
  bool paused_before_ = false;           ///< see rest()
  std::uint64_t paced_edit_ = 0;         ///< newest edit that pacing_ knows of
  double input_since_ = 0;               ///< when the oldest input came that no drawing has seen; 0: there is none
  bool takes_in_again_ = false;          ///< an edit waits for what came while the picture was put on the screen
  double awaits_until_ = 0;              ///< until then nothing is drawn but the picture of an edit that was just sent
};

}  // namespace tyndall
