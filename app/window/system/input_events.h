#pragma once
#include <deque>
#include <filesystem>
#include <optional>
#include <set>
#include <vector>

/// What the user did between two drawings, with keys and mouse, and the order in which that acts.
namespace tyndall {

/// Keys that are held while another one is pressed.
struct Modifiers {
  bool control = false, shift = false, alt = false;
};

struct KeyPress {
  int key = 0;  ///< GLFW's number; letters by what is printed on the user's keyboard
  Modifiers modifiers;
  bool typing = false;    ///< a control took the keyboard when it was pressed
  char character = '\0';  ///< the ASCII character that was typed, in a press of its own after that of the key, key 0
};

/// What the user did since this was last taken.
struct InputEvents {
  bool any = false;     ///< something happened that may change what is drawn
  bool closes = false;  ///< the user wants the window closed, which stays, and shows if it was minimised
  double first = 0;     ///< clock second at which the oldest event of keys or mouse came; 0: there was none
  std::vector<KeyPress> keys;
  std::vector<std::filesystem::path> dropped;  ///< files
};

/// The mouse as one drawing of the window finds it. Places are in window units, y down; the buttons are left, right,
/// middle.
struct Mouse {
  float x = 0, y = 0;
  float dx = 0, dy = 0;  ///< how far it went since the last drawing
  float wheel = 0;       ///< notches turned since the last drawing, positive: away from the user
  bool clicked[3] = {};  ///< pressed since the last drawing, and maybe released again
  bool down[3] = {};
  float pressed_x[3] = {}, pressed_y[3] = {};  ///< where each button went down last
  bool control = false, shift = false, alt = false;
  bool taken = false;   ///< a control of the panels or a dialog has it
  bool typing = false;  ///< a control has the keyboard

  bool any_down() const { return down[0] || down[1] || down[2]; }
};

/// What Dear ImGui knows of the mouse. Within one of its frames.
Mouse read_mouse();

/// One event of the window system, as its callback was told.
struct RawInput {
  enum class Kind { key, character, button, motion, scroll, focus } kind = Kind::motion;
  int code = 0;       ///< key, or mouse button
  int scancode = 0;   ///< of a key
  int action = 0;     ///< GLFW's number; 0: released, or the focus was lost
  int modifiers = 0;  ///< GLFW's flags; of keys that are no modifiers themselves, and of buttons
  unsigned character = 0;
  double x = 0, y = 0;  ///< of the pointer, for motion and buttons; steps of the wheel
  double time = 0;      ///< clock second at which it was told
};

/// Whether a key is Shift, Ctrl, Alt or Super.
bool is_modifier(int key);

/// Holds events until those before them have had their effect. All that is delivered before a frame of the interface is
/// seen by that frame as one: its keys and buttons with the modifiers that are held at its end, its characters before
/// its keys, a key that was let go not at all. So events that would be misread together are delivered one after
/// another, a frame each, however much comes within one slow frame:
/// - a modifier is pressed or released once a frame has seen what came before;
/// - a key that does something (an arrow, Enter, Ctrl + A) has a frame without characters and other such keys;
/// - a key or button that is released at once is held for one frame, and a key is seen up before it is pressed again;
/// - what is typed after a click, or after a key that moves the keyboard from one control to another, waits until the
///   keyboard is there: the control that was clicked takes it a few frames later.
class InputQueue {
 public:
  void push(const RawInput& input) { waiting_.push_back(input); }
  /// The next event that belongs before the next frame; nothing: there is none.
  std::optional<RawInput> take();
  /// Whether all events were taken.
  bool empty() const { return waiting_.empty() && late_.empty(); }
  /// The interface has had a frame.
  void on_frame();

  /// So many frames after a click, or after a key that moves the keyboard from one control to another, it is where it
  /// goes: the click is seen in the first, the control asks for the keyboard in the second or third, and has it in the
  /// frame after the next.
  static constexpr int settling_frames = 6;

 private:
  bool waits(const RawInput& input) const;

  std::deque<RawInput> waiting_;
  std::vector<RawInput> late_;     ///< releases of keys that the next frame is to see pressed
  std::set<int> down_, was_down_;  ///< keys: as delivered, and as the last frame has seen them
  unsigned seen_ = 0;              ///< what was delivered for the next frame: a bit for each Role
  int frames_ = settling_frames;   ///< since what moves the keyboard was delivered
};

}  // namespace tyndall
