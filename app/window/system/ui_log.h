#pragma once
#include "app/window/system/input_events.h"
#include "app/window/system/layout.h"
#include "core/render/renderer.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// A log of what the window shows, from which tests know what to do next.
namespace tyndall {

/// A diagnostic for tests and measurements (`view --ui-log FILE`): what is on the screen and how long things took, one
/// line each, written at once. Spaces in names become '_'.
///   widget NAME X0 Y0 X1 Y1 VALUE    a control appeared, moved or has a new value; window coordinates
///   gone NAME                        it is no longer there
///   submit EDIT                      the scene went to the renderer
///   frame EDIT SPP STEP MS FIRST_MS  a picture of that edit is on the screen, MS after the oldest input behind it;
///                                    FIRST_MS: what the renderer took for the edit's first picture
///   drawn CPU_MS PICTURE             the window was drawn; CPU_MS of the main thread; PICTURE 1: with a new picture
///   state rendering|paused|finished
///   reading CURVE: SECONDS RELMSE    what the chart says under the mouse
///   accuracy TEXT                    the lines beneath the chart
///   pictures 1|2 of WIDTH x HEIGHT [clean]
///                                    that the window holds: 2 while another one is shown beside the first
///   halves A SECONDS B SECONDS       of rendering, in a split view
///   cursor plain|divider
///   message TEXT                     what the user is told; without TEXT: it has gone from the screen
///   action NAME KEY                  at the start, a line for each action; KEY: Ctrl+Shift+Z, or none
///   did NAME                         an action was carried out
///   fonts FOUND of WANTED            characters beyond the usual ones that names have, and how many of them fonts have
///   saved FILE
///   read FILE                        the open file had changed and was read again
/// What the window took in, so that a test can wait until what it sent has arrived and a drawing has shown it:
///   mouse X Y                        the pointer in this drawing, in window coordinates; or "mouse none"
///   buttons LEFT RIGHT MIDDLE        in this drawing, each 1 where it is held down, else 0
///   keyboard control|shortcuts       who gets what is typed: a control that is being edited, or the shortcuts
///   key NUMBER                       a key was pressed, with GLFW's number; modifiers are keys too
///   wheel STEPS
///   size WIDTH HEIGHT                of the window
///   rest                             all of it was shown and the picture is finished: nothing will be drawn, rendered,
///                                    read or measured for the next second unless something happens
/// At the end: latency and cpu lines with the count, median, 95th and 99th percentile and the greatest, in ms;
/// latencies are those of edits' first pictures, of all edits and of those that moved only the camera, or something
/// else; and those of the first clean pictures.
class UiLog {
 public:
  /// file: "-" is standard output. Throws IoError.
  explicit UiLog(const std::filesystem::path& file);
  ~UiLog();
  UiLog(const UiLog&) = delete;
  UiLog& operator=(const UiLog&) = delete;

  void line(const std::string& text);
  void widget(const std::string& name, const Rect& rect, const std::string& value);
  /// Where a widget is; nothing if it is not on the screen.
  std::optional<Rect> find(const std::string& name) const;
  /// After all widgets of a drawing: tells which have gone.
  void end_of_widgets();
  /// since: clock second of the oldest input that has led to the edit.
  void submitted(std::uint64_t edit, double since, bool camera_only);
  /// now: seconds, after the picture was put on the screen.
  void shown(const Frame& frame, double now);
  void drawn(double cpu_seconds, bool picture);
  /// Writes where the mouse is (far below 0: outside), which of its buttons are down, and what its wheel did.
  void mouse(const Mouse& mouse);
  /// The window is at rest; written once until another line follows.
  void rest();
  /// A line that is written only when it differs from the last one of the same kind.
  void changed(const std::string& kind, const std::string& value);

 private:
  struct Widget {
    Rect rect;
    std::string value;
    std::uint64_t drawing = 0;
  };
  void summary(const char* what, std::vector<double> values);

  std::FILE* stream_ = nullptr;
  std::map<std::string, Widget> widgets_;
  std::map<std::string, std::string> last_;
  struct Submit {
    double since = 0;
    bool camera_only = false;
  };
  std::map<std::uint64_t, Submit> submits_;  ///< of the edit that is shown and newer ones
  std::vector<double> latencies_, camera_latencies_, other_latencies_, clean_latencies_, cpu_picture_, cpu_plain_;
  std::uint64_t drawing_ = 1, shown_ = 0, shown_clean_ = 0, pass_ = 0;
  bool resting_ = false;  ///< "rest" is the last line
};

/// A name as the log has it: without spaces.
std::string log_name(std::string name);

/// The value below which a share q in [0, 1] of the values lies; 0 for none. Sorts.
double quantile(std::vector<double>& values, double q);

}  // namespace tyndall
