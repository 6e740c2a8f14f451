#include "app/window/system/display_lost.h"

#include <dlfcn.h>
#include <unistd.h>

#include <csignal>
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
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text.data(), text.size());
  _exit(3);
}

}  // namespace

void end_when_display_is_lost(std::function<std::string()> before_end) {
  last_wish() = std::move(before_end);
  std::signal(SIGPIPE, SIG_IGN);  // comes first when the connection breaks, and would end the program without a message
  // The window library loads X by itself; linking it here would tie the program to it.
  void* library = dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
  if (!library) return;
  const auto set_handler = reinterpret_cast<Handler (*)(Handler)>(dlsym(library, "XSetIOErrorHandler"));
  if (set_handler) set_handler(on_lost);
}

}  // namespace tyndall
