#include "app/window/system/lost_display.h"

#include "core/system/process.h"
#include "core/system/signals.h"

#include <cstdio>
#include <cstdlib>
#include <utility>

namespace tyndall {
namespace {

using Handler = int (*)(void* display);

/// The X library's handler gets no argument of its own.
std::function<std::string()>& last_wish() {
  static std::function<std::string()> wish;
  return wish;
}

/// Ends the program, as X demands of such a handler. Destructors are left out: they would talk to the lost server.
int on_lost(void*) {
  const std::string more = last_wish() ? last_wish()() : "";
  const std::string text = "tyndall: the display went away\n" + (more.empty() ? "" : "tyndall: " + more + "\n");
  std::fputs(text.c_str(), stderr);
  std::_Exit(3);
}

}  // namespace

void end_when_display_is_lost(std::function<std::string()> before_end) {
  last_wish() = std::move(before_end);
  ignore_lost_pipes();  // the signal comes first when the connection breaks
  // The window library loads X by itself; linking it here would tie the program to it.
  void* function = loaded_function("libX11.so.6", "XSetIOErrorHandler");
  if (function) reinterpret_cast<Handler (*)(Handler)>(function)(on_lost);
}

}  // namespace tyndall
