#include "app/window/main_window.h"

#include "app/window/document/open_document.h"
#include "app/window/system/display_lost.h"
#include "core/base/error.h"

#include <cstdio>
#include <cstdlib>
#include <memory>

namespace tyndall {
namespace {

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

}  // namespace

/// Says what becomes of the edits if a signal ends the window. Returns the exit code.
int MainWindow::end_of_signal() {
  const int signal = signals_.received();
  if (signal == 0) return 0;
  session_.pause(true);
  session_.keep_edits();
  session_.flush_edits();
  if (const Document* unsaved = session_.editor().unsaved())
    std::fprintf(stderr, "tyndall: the edits of %s are kept and come back at the next start\n",
                 unsaved->origin->title.c_str());
  return 128 + signal;
}

int run_window(const WindowOptions& options) {
  // GLFW is not touched without a display: its error would say less.
  if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY"))
    throw IoError("no display: neither DISPLAY nor WAYLAND_DISPLAY is set");
  std::shared_ptr<const Reference> reference;
  if (!options.reference.empty())
    reference = std::make_shared<const Reference>(read_reference(options.reference, document_of(options.scene)));
  MainWindow window(options, std::move(reference));
  end_when_display_is_lost([&window] { window.flush_edits(); });
  const int code = window.run();
  end_when_display_is_lost({});  // what is left is gone soon
  return code;
}

}  // namespace tyndall
