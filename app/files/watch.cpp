#include "app/files/watch.h"

#ifdef __linux__
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <poll.h>
#include <unistd.h>
#endif

#include <cerrno>
#include <cstdint>
#include <string>
#include <thread>
#include <utility>

namespace tyndall {

#ifdef __linux__

struct FileWatch::State {
  int events = -1, leave = -1;
  std::string name;
  std::function<void()> on_change;
  std::thread thread;

  void listen() const;
  bool told() const;
};

/// Reads the events that have come. Returns whether any of them is about the watched file.
bool FileWatch::State::told() const {
  alignas(inotify_event) char buffer[4096];
  const ssize_t size = read(events, buffer, sizeof buffer);
  bool found = false;
  for (ssize_t at = 0; at < size;) {
    const auto* event = reinterpret_cast<const inotify_event*>(buffer + at);
    found = found || (event->len > 0 && name == event->name);
    at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
  }
  return found;
}

void FileWatch::State::listen() const {
  pollfd files[2] = {{events, POLLIN, 0}, {leave, POLLIN, 0}};
  for (;;) {
    if (poll(files, 2, -1) < 0 && errno != EINTR) return;
    if (files[1].revents) return;
    if (files[0].revents && told()) on_change();
  }
}

FileWatch::FileWatch(const std::filesystem::path& file, std::function<void()> on_change)
    : state_(std::make_unique<State>()) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  state_->name = file.filename().string();
  state_->on_change = std::move(on_change);
  state_->events = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  state_->leave = eventfd(0, EFD_CLOEXEC);
  if (state_->events < 0 || state_->leave < 0) return;
  if (inotify_add_watch(state_->events, folder.c_str(), IN_CLOSE_WRITE | IN_MOVED_TO) < 0) return;
  state_->thread = std::thread([state = state_.get()] { state->listen(); });
}

FileWatch::~FileWatch() {
  const std::uint64_t one = 1;
  if (state_->thread.joinable() && write(state_->leave, &one, sizeof one) == sizeof one) state_->thread.join();
  if (state_->events >= 0) close(state_->events);
  if (state_->leave >= 0) close(state_->leave);
}

#else

struct FileWatch::State {};
FileWatch::FileWatch(const std::filesystem::path&, std::function<void()>) {}
FileWatch::~FileWatch() = default;

#endif

}  // namespace tyndall
