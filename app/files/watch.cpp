#include "app/files/watch.h"

#ifdef __linux__
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <poll.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <map>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

namespace tyndall {

namespace fs = std::filesystem;

#ifdef __linux__

namespace {

constexpr std::uint32_t gone_events = IN_DELETE | IN_MOVED_FROM;
constexpr std::uint32_t watched_events = IN_CLOSE_WRITE | IN_MOVED_TO | IN_CREATE | gone_events | IN_ONLYDIR;

/// Whether something has just been created and is still to be written, which will be told.
bool is_still_empty(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(fs::symlink_status(file, error)) && fs::file_size(file, error) == 0 && !error;
}

}  // namespace

struct FileWatch::State {
  enum class News { none, gone, changed };
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds longest_absence{100};

  struct Folder {
    fs::path path;
    std::set<std::string> names;  ///< in it, that are watched
  };

  int events = -1, leave = -1;
  std::vector<fs::path> files;
  std::function<void()> on_change;
  std::map<int, Folder> folders;  ///< by what inotify calls them
  int failure = 0;                ///< the error for which a file is not watched; 0: all are
  std::thread thread;

  void look();
  void follow(const fs::path& file, std::map<int, Folder>& found);
  News news() const;
  News news_of(const inotify_event& event) const;
  void listen();
};

/// Watches each name on the way to a file in the folder where it stands: those of folders, of links, and of the file.
void FileWatch::State::follow(const fs::path& file, std::map<int, Folder>& found) {
  constexpr int max_links = 40;  // as many as the system follows
  std::vector<fs::path> rest;    // of the way, the next name at the end
  const auto go_on_with = [&](const fs::path& components) {
    const std::vector<fs::path> names(components.begin(), components.end());
    rest.insert(rest.end(), names.rbegin(), names.rend());
  };
  fs::path at = "/";
  int links = 0;
  for (go_on_with(file); !rest.empty();) {
    const fs::path name = rest.back();
    rest.pop_back();
    if (name.empty() || name == "." || name == "/") continue;
    if (name == "..") {
      at = at.parent_path();
      continue;
    }
    const int folder = inotify_add_watch(events, at.c_str(), watched_events);
    if (folder >= 0) {
      found[folder].path = at;
      found[folder].names.insert(name.string());
    } else if (errno == ENOSPC || errno == ENOMEM || (rest.empty() && errno != ENOENT && errno != ENOTDIR)) {
      failure = errno;  // what is not there yet is told of when it comes; of other folders only the last one matters
    }
    std::error_code error;
    const fs::path target = fs::read_symlink(at / name, error);
    if (error) {  // it is no link
      at /= name;
      continue;
    }
    if (++links > max_links) return;
    if (target.is_absolute()) at = "/";
    go_on_with(target);
  }
}

/// Finds out which names are to be watched now.
void FileWatch::State::look() {
  std::map<int, Folder> found;
  for (const fs::path& file : files) follow(file, found);
  for (const auto& [folder, what] : folders)
    if (!found.contains(folder)) inotify_rm_watch(events, folder);
  folders = std::move(found);
}

FileWatch::State::News FileWatch::State::news_of(const inotify_event& event) const {
  if ((event.mask & IN_Q_OVERFLOW) != 0) return News::changed;
  const auto folder = folders.find(event.wd);
  if (folder == folders.end() || event.len == 0 || !folder->second.names.contains(event.name)) return News::none;
  if ((event.mask & gone_events) != 0) return News::gone;
  const bool begun = (event.mask & IN_CREATE) != 0 && is_still_empty(folder->second.path / event.name);
  return begun ? News::none : News::changed;
}

/// Reads the events that have come.
FileWatch::State::News FileWatch::State::news() const {
  alignas(inotify_event) char buffer[4096];
  const ssize_t size = read(events, buffer, sizeof buffer);
  News all = News::none;
  for (ssize_t at = 0; at < size;) {
    const auto* event = reinterpret_cast<const inotify_event*>(buffer + at);
    if (const News one = news_of(*event); one != News::none) all = one;
    at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
  }
  return all;
}

void FileWatch::State::listen() {
  pollfd polled[2] = {{events, POLLIN, 0}, {leave, POLLIN, 0}};
  constexpr auto never = Clock::time_point::max();
  for (Clock::time_point due = never;;) {  // when a file is told of that has gone
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(due - Clock::now());
    const int wait = due == never ? -1 : std::max(0, static_cast<int>(left.count()));
    if (poll(polled, 2, wait) < 0 && errno != EINTR) return;
    if (polled[1].revents) return;
    const News now = polled[0].revents ? news() : News::none;
    if (now == News::gone && due == never) due = Clock::now() + longest_absence;
    if (now != News::changed && Clock::now() < due) continue;
    due = never;
    look();
    on_change();
  }
}

FileWatch::FileWatch(const std::vector<fs::path>& files, std::function<void()> on_change)
    : state_(std::make_unique<State>()) {
  std::error_code error;
  for (const fs::path& file : files) state_->files.push_back(fs::absolute(file, error));
  state_->on_change = std::move(on_change);
  state_->events = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  state_->leave = eventfd(0, EFD_CLOEXEC);
  if (state_->events < 0 || state_->leave < 0) {
    problem_ = std::generic_category().message(errno);
    return;
  }
  state_->look();
  if (state_->failure == ENOSPC)
    problem_ = "the system watches no more files";
  else if (state_->failure != 0)
    problem_ = std::generic_category().message(state_->failure);
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
FileWatch::FileWatch(const std::vector<fs::path>&, std::function<void()>) : problem_("not on this system") {}
FileWatch::~FileWatch() = default;

#endif

}  // namespace tyndall
