#include "app/window/document/autosave.h"

#include "app/files/outputs.h"
#include "app/window/system/preferences.h"
#include "core/base/error.h"
#include "core/base/stoppable.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <optional>
#include <system_error>
#include <utility>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

constexpr auto min_interval = std::chrono::milliseconds(250);
constexpr auto retry_interval = std::chrono::seconds(5);

/// How edits in the file come back: what the last line says of that.
std::string way_back(const KeepingPlace& place, const fs::path& file, const Origin& of) {
  std::error_code ignored;
  const bool gone = of.what.empty() || (fs::path(of.what).is_absolute() && !fs::exists(of.what, ignored));
  if (gone && place.beside_the_scene) return ", which opens as a scene; the one that was edited is gone";
  const std::string start = gone ? "start without a scene" : "start with this scene";
  const std::vector<fs::path> files = kept_files(place);
  const bool others = std::any_of(files.begin(), files.end(), [&](const fs::path& other) {
    return other != file && (gone || kept_what(other) == of.what);
  });
  if (!others) return " and come back at the next " + start;
  return ", and so are others; each " + start + " brings back the newest that no window has";
}

}  // namespace

fs::path state_folder() {
  const fs::path state = user_folder("XDG_STATE_HOME", ".local/state");
  return state.empty() ? state : state / "tyndall";
}

struct Autosave::State {
  fs::path folder;
  std::function<void()> on_change;
  KeptSlot slot;  ///< of the thread that writes, once something is to be kept

  mutable Mutex mutex;  ///< guards what follows
  StoppableCondition news, written;
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const Origin> origin;
  bool used = false;     ///< something was kept, or taken over
  bool waits = false;    ///< the file does not hold `scene` yet
  bool writes = false;   ///< it is being written
  bool hurries = false;  ///< somebody waits for it
  Keeping keeping{};
  bool holds_older = false;                 ///< where edits are lost: the file holds some that were made before
  std::optional<StoppableThread> thread{};  // declared last, because it uses the others

  State(fs::path in, std::function<void()> call) : folder(std::move(in)), on_change(std::move(call)) {}
  void work(const StopToken& stop);
  Keeping write(const Scene* edits, const Origin* of);
  Keeping remove();
  void write_at(const KeepingPlace& place, const Scene& edits, const Origin& of);
};

/// Writes into this window's file, which is a new one where it is to be in another place than before.
void Autosave::State::write_at(const KeepingPlace& place, const Scene& edits, const Origin& of) {
  const std::string text = kept_text(edits, of, place.folder);
  if (slot.held() && slot.place() == place) return write_text_file(slot.file(), text);
  std::error_code error;
  if (!place.beside_the_scene && !fs::create_directories(place.folder, error) && error)
    throw IoError(place.folder.string() + ": cannot make the folder: " + error.message());
  KeptSlot fresh = free_slot(place);
  write_text_file(fresh.file(), text);
  std::error_code ignored;  // older edits that cannot be removed are older, which take_over() sees
  if (slot.held()) fs::remove(slot.file(), ignored);
  slot = std::move(fresh);
}

Keeping Autosave::State::write(const Scene* edits, const Origin* of) {
  if (!edits) return remove();
  std::vector<KeepingPlace> places = keeping_places(folder, of->what);
  std::string why = folder.empty() ? "neither XDG_STATE_HOME nor HOME names a folder" : "";
  const auto own = std::find(places.begin(), places.end(), slot.place());
  if (slot.held() && own != places.end()) std::rotate(places.begin(), own, own + 1);
  for (const KeepingPlace& place : places) {
    try {
      write_at(place, *edits, *of);
      return {place.beside_the_scene ? Keeping::Kind::beside : Keeping::Kind::kept, slot.file(), why};
    } catch (const std::exception& error) {
      why += (why.empty() ? "" : "; ") + std::string(error.what());
    }
  }
  return {Keeping::Kind::lost, {}, why};
}

Keeping Autosave::State::remove() {
  std::error_code error;
  if (slot.held()) fs::remove(slot.file(), error);
  if (!error) return {};
  return {Keeping::Kind::nothing, slot.file(), error.message()};
}

void Autosave::State::work(const StopToken& stop) {
  std::unique_lock lock(mutex);
  for (;;) {
    const auto has_news = [&] { return waits; };
    if (!keeping.failed())
      news.wait(lock, stop, has_news);
    else if (!news.wait_for(lock, stop, retry_interval, has_news) && !stop.stop_requested())
      waits = true;      // a disk may have room again
    if (!waits) return;  // asked to stop, and nothing is left to do
    waits = false;
    writes = true;
    const auto edits = scene;
    const auto of = origin;
    lock.unlock();
    Keeping now = write(edits.get(), of.get());
    lock.lock();
    const bool changed = now.kind != keeping.kind || now.why != keeping.why;
    keeping = std::move(now);
    holds_older = keeping.kind == Keeping::Kind::lost && slot.used();
    lock.unlock();
    if (changed && on_change) on_change();  // before flush() returns
    lock.lock();
    writes = false;
    if (!waits) hurries = false;
    written.notify_all();
    news.wait_for(lock, stop, min_interval, [&] { return hurries; });
  }
}

Autosave::Autosave(fs::path folder, std::function<void()> on_change)
    : state_(std::make_unique<State>(std::move(folder), std::move(on_change))) {
  state_->thread.emplace([state = state_.get()](const StopToken& stop) { state->work(stop); });
}

Autosave::~Autosave() = default;

fs::path Autosave::take_over(const std::string& what) {
  KeptSlot newest;
  std::error_code ignored;
  const auto see = [&](KeptSlot&& free) {
    if (!what.empty() && kept_what(free.file()) != what) return;
    const bool newer =
        !newest.held() || fs::last_write_time(free.file(), ignored) > fs::last_write_time(newest.file(), ignored);
    if (newer) newest = std::move(free);
  };
  for (const KeepingPlace& place : keeping_places(state_->folder, what)) for_free_files(place, see);
  const std::lock_guard lock(state_->mutex);
  state_->slot = std::move(newest);
  state_->used = state_->slot.held();
  return state_->used ? state_->slot.file() : fs::path();
}

void Autosave::leave() {
  const std::lock_guard lock(state_->mutex);
  state_->slot = {};
  state_->used = false;
}

std::vector<std::string> Autosave::others() const {
  std::vector<std::string> names;
  const auto see = [&names](KeptSlot&& free) {
    const std::string what = kept_what(free.file());
    if (!what.empty() && std::find(names.begin(), names.end(), what) == names.end()) names.push_back(what);
  };
  for (const KeepingPlace& place : keeping_places(state_->folder, "")) for_free_files(place, see);
  return names;
}

void Autosave::keep(std::shared_ptr<const Scene> scene, std::shared_ptr<const Origin> origin) {
  const std::lock_guard lock(state_->mutex);
  if (!scene && !state_->used) return;
  state_->used = true;
  state_->scene = std::move(scene);
  state_->origin = std::move(origin);
  state_->waits = true;
  state_->news.notify_one();
}

void Autosave::flush() {
  std::unique_lock lock(state_->mutex);
  state_->hurries = true;
  if (state_->keeping.failed()) state_->waits = true;
  state_->news.notify_one();
  state_->written.wait(lock, [this] { return !state_->waits && !state_->writes; });
}

Keeping Autosave::keeping() const {
  const std::lock_guard lock(state_->mutex);
  return state_->keeping;
}

std::string Autosave::last_words() const {
  const std::lock_guard lock(state_->mutex);
  const Keeping& now = state_->keeping;
  if (!state_->scene && !now.failed()) return "";
  if (!state_->scene)
    return "edits that were saved or given up are still in " + now.file.string() + " (" + now.why +
           ") and come back at the next start";
  const std::string& title = state_->origin->title;
  const std::string back =
      state_->slot.held() ? way_back(state_->slot.place(), state_->slot.file(), *state_->origin) : "";
  if (now.kind != Keeping::Kind::lost)
    return "the edits of " + title + " are kept" +
           (now.kind == Keeping::Kind::beside ? " in " + now.file.string() : "") + back;
  if (!state_->holds_older) return "the edits of " + title + " are lost: " + now.why;
  return "the newest edits of " + title + " are lost (" + now.why + "); older ones are kept" + back;
}

}  // namespace tyndall
