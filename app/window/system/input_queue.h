#pragma once
#include <deque>

/// The order in which keys and mouse act.
namespace tyndall {

/// One event of the window system, as its callback was told.
struct RawInput {
  enum class Kind { key, character, button, motion, scroll } kind = Kind::motion;
  int code = 0;      ///< key, or mouse button
  int scancode = 0;  ///< of a key
  int action = 0;    ///< GLFW's number; 0: released
  int modifiers = 0;
  unsigned character = 0;
  double x = 0, y = 0;  ///< of the pointer, for motion and buttons; steps of the wheel
  double time = 0;      ///< clock second at which it was told
};

/// Holds events until those before them have had their effect. All that is delivered before a frame of the interface is
/// seen by that frame as one. So a click and what is typed after it must not be delivered together: the control that
/// was clicked takes the keyboard a few frames later, and what is typed is meant for it, however busy the machine is.
class InputQueue {
 public:
  void push(const RawInput& input) { waiting_.push_back(input); }
  /// Whether the next event may be delivered before the next frame. controls_type: a control has the keyboard.
  bool ready() const;
  /// The next event; ready() is true.
  RawInput take();
  bool empty() const { return waiting_.empty(); }
  /// The interface has had a frame.
  void on_frame();

  /// So many frames after a click, or after a key that moves the keyboard from one control to another, it is where it
  /// goes: the click is seen in the first, the control asks for the keyboard in the second or third, and has it in the
  /// frame after the next.
  static constexpr int settling_frames = 6;

 private:
  std::deque<RawInput> waiting_;
  int frames_ = settling_frames;  ///< since what moves the keyboard was delivered
  bool button_now_ = false;       ///< a button's event was delivered for the next frame
  bool key_now_ = false;          ///< a key's event was
};

}  // namespace tyndall
