#include "app/window/document/kept_edits.h"

#include "app/files/outputs.h"
#include "app/window/document/open_document.h"
#include "core/base/stoppable.h"

#include <fmt/core.h>

#include <sys/file.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>

namespace tyndall {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view first_line = "// Edits that were not saved, of ";
constexpr std::string_view second_line = "// The FNV-1a hash of that file's text when they were made: ";
constexpr auto least_interval = std::chrono::milliseconds(250);
constexpr int most_windows = 1000;  // that keep edits at the same time

/// On one line, as a comment needs it: what would end the line is written as %0A and the like.
std::string escaped(const std::string& text) {
  constexpr const char* digits = "0123456789ABCDEF";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && c != '%')
      out += c;
    else
      out += std::string("%") + digits[byte / 16] + digits[byte % 16];
  }
  return out;
}

std::string unescaped(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool code = text[i] == '%' && i + 2 < text.size();
    out += code ? static_cast<char>(std::strtol(text.substr(i + 1, 2).c_str(), nullptr, 16)) : text[i];
    if (code) i += 2;
  }
  return out;
}

/// What follows `start` in the line of the file's first two that begins with it; empty: none does.
std::string rest_of_line(const fs::path& file, std::string_view start) {
  std::ifstream in(file);
  std::string line;
  for (int k = 0; k < 2 && std::getline(in, line); ++k)
    if (line.starts_with(start)) return line.substr(start.size());
  return "";
}

/// The document as it is without edits; one that holds nothing where its scene cannot be read any more.
Document unedited(const std::string& what) {
  try {
    return document_of(load_scene(what));
  } catch (const std::exception&) {
    auto origin = std::make_shared<Origin>();
    origin->what = what;
    const fs::path file(what);
    origin->title = what.empty() ? "scene" : file.filename().string();
    if (file.extension() == ".json") origin->file = file;
    origin->folder = file.parent_path();
    return {{}, std::move(origin)};
  }
}

}  // namespace

fs::path state_folder() {
  const auto folder = [](const char* variable) {
    const char* value = std::getenv(variable);
    return fs::path(value ? value : "");
  };
  fs::path state = folder("XDG_STATE_HOME");
  if (state.empty() && !folder("HOME").empty()) state = folder("HOME") / ".local" / "state";
  return state.empty() ? state : state / "tyndall";
}

std::string kept_text(const Scene& scene, const Origin& origin, const fs::path& folder) {
  const Scene moved = move_textures(scene, fs::absolute(origin.folder), fs::absolute(folder));
  std::string text = std::string(first_line) + escaped(origin.what) + "\n";
  if (origin.text_hash != 0) text += fmt::format("{}{:016x}\n", second_line, origin.text_hash);
  return text + write_scene(moved);
}

Kept read_kept(const fs::path& file, const std::function<LoadedScene(const std::string& what)>& read) {
  const LoadedScene kept = read(fs::absolute(file).string());
  const std::string hash = rest_of_line(file, second_line);
  Document document = unedited(kept_what(file));
  document.scene = move_textures(kept.scene, kept.folder, fs::absolute(document.origin->folder));
  const std::uint64_t now = document.origin->text_hash;
  return {std::move(document), !hash.empty() && now != 0 && fmt::format("{:016x}", now) != hash};
}

std::string kept_what(const fs::path& file) { return unescaped(rest_of_line(file, first_line)); }

/// A file of the folder, and its lock while this lives.
struct Slot {
  fs::path file;
  int lock = -1;  ///< file descriptor; < 0: another window has it

  Slot() = default;
  Slot(const fs::path& folder, int number) : file(folder / ("unsaved-" + std::to_string(number) + ".json")) {
    lock = open((folder / ("unsaved-" + std::to_string(number) + ".lock")).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (lock >= 0 && flock(lock, LOCK_EX | LOCK_NB) != 0) release();
  }
  Slot(Slot&& other) noexcept : file(std::move(other.file)), lock(std::exchange(other.lock, -1)) {}
  Slot& operator=(Slot&& other) noexcept {
    release();
    file = std::move(other.file);
    lock = std::exchange(other.lock, -1);
    return *this;
  }
  ~Slot() { release(); }
  void release() {
    if (lock >= 0) close(lock);
    lock = -1;
  }
  bool held() const { return lock >= 0; }
  bool used() const {
    std::error_code ignored;
    return fs::exists(file, ignored);
  }
};

struct KeptEdits::State {
  fs::path folder;
  Slot slot;

  mutable std::mutex mutex;  ///< guards what follows
  StoppableCondition news, written;
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const Origin> origin;
  bool used = false;     ///< something was kept, or taken over
  bool waits = false;    ///< the file does not hold `scene` yet
  bool writes = false;   ///< it is being written
  bool hurries = false;  ///< somebody waits for it
  std::string problem{};
  std::optional<StoppableThread> thread{};  // declared last, because it uses the others

  explicit State(fs::path in) : folder(std::move(in)) {}
  void work(const StopToken& stop);
  void write(const Scene* edits, const Origin* of);
  bool has_slot();
  /// Calls see(slot) for each file that nobody has; its lock is free again when the slot goes.
  template <class See>
  void for_free_files(const See& see) const;
};

template <class See>
void KeptEdits::State::for_free_files(const See& see) const {
  std::error_code gone;
  for (const auto& entry : fs::directory_iterator(folder, gone)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("unsaved-") || entry.path().extension() != ".json") continue;
    Slot free(folder, std::atoi(name.c_str() + std::string_view("unsaved-").size()));
    if (free.held() && free.file == entry.path()) see(std::move(free));
  }
}

/// Takes a file that nobody has and that holds nothing.
bool KeptEdits::State::has_slot() {
  for (int number = 1; !slot.held() && number <= most_windows; ++number) {
    Slot free(folder, number);
    if (free.held() && !free.used()) slot = std::move(free);
  }
  return slot.held();
}

void KeptEdits::State::write(const Scene* edits, const Origin* of) {
  std::string wrong;
  try {
    if (edits) {
      fs::create_directories(folder);
      if (!has_slot()) throw IoError(folder.string() + ": no file can be locked there");
      write_text_file(slot.file, kept_text(*edits, *of, folder));
    } else if (slot.held()) {
      fs::remove(slot.file);
    }
  } catch (const std::exception& error) {
    wrong = error.what();
  }
  const std::lock_guard lock(mutex);
  problem = wrong;
}

void KeptEdits::State::work(const StopToken& stop) {
  std::unique_lock lock(mutex);
  for (;;) {
    news.wait(lock, stop, [&] { return waits; });
    if (!waits) return;  // asked to stop, and nothing is left to do
    waits = false;
    writes = true;
    const auto edits = scene;
    const auto of = origin;
    lock.unlock();
    write(edits.get(), of.get());
    lock.lock();
    writes = false;
    if (!waits) hurries = false;
    written.notify_all();
    news.wait_for(lock, stop, least_interval, [&] { return hurries; });
  }
}

KeptEdits::KeptEdits(fs::path folder) : state_(std::make_unique<State>(std::move(folder))) {
  if (!state_->folder.empty())
    state_->thread.emplace([state = state_.get()](const StopToken& stop) { state->work(stop); });
}

KeptEdits::~KeptEdits() = default;

fs::path KeptEdits::take_over(const std::string& what) {
  Slot newest;
  std::error_code ignored;
  state_->for_free_files([&](Slot&& free) {
    if (!what.empty() && kept_what(free.file) != what) return;
    const bool newer =
        !newest.held() || fs::last_write_time(free.file, ignored) > fs::last_write_time(newest.file, ignored);
    if (newer) newest = std::move(free);
  });
  const std::lock_guard lock(state_->mutex);
  state_->slot = std::move(newest);
  state_->used = state_->slot.held();
  return state_->used ? state_->slot.file : fs::path();
}

void KeptEdits::leave() {
  const std::lock_guard lock(state_->mutex);
  state_->slot = {};
  state_->used = false;
}

std::vector<std::string> KeptEdits::others() const {
  std::vector<std::string> names;
  state_->for_free_files([&](Slot&& free) {
    const std::string what = kept_what(free.file);
    if (!what.empty() && std::find(names.begin(), names.end(), what) == names.end()) names.push_back(what);
  });
  return names;
}

void KeptEdits::keep(std::shared_ptr<const Scene> scene, std::shared_ptr<const Origin> origin) {
  if (state_->folder.empty()) return;
  const std::lock_guard lock(state_->mutex);
  if (!scene && !state_->used) return;
  state_->used = true;
  state_->scene = std::move(scene);
  state_->origin = std::move(origin);
  state_->waits = true;
  state_->news.notify_one();
}

void KeptEdits::flush() {
  if (state_->folder.empty()) return;
  std::unique_lock lock(state_->mutex);
  state_->hurries = true;
  state_->news.notify_one();
  state_->written.wait(lock, [this] { return !state_->waits && !state_->writes; });
}

std::string KeptEdits::problem() const {
  const std::lock_guard lock(state_->mutex);
  return state_->problem;
}

}  // namespace tyndall
