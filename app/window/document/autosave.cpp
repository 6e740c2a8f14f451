#include "app/window/document/autosave.h"

#include "app/files/outputs.h"
#include "app/window/system/preferences.h"
#include "core/base/error.h"

#include <algorithm>
#include <exception>
#include <system_error>
#include <utility>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

constexpr BackgroundThread::Time min_interval(250), retry_interval(5000);

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

/// Writes into this window's file, which is a new one where it is to be in another place than before.
void Autosave::write_at(const KeepingPlace& place, const Scene& edits, const Origin& of) {
  const std::string text = kept_text(edits, of, place.folder);
  if (slot_.held() && slot_.place() == place) return write_text_file(slot_.file(), text);
  std::error_code error;
  if (!place.beside_the_scene && !fs::create_directories(place.folder, error) && error)
    throw IoError(place.folder.string() + ": cannot make the folder: " + error.message());
  KeptSlot fresh = free_slot(place);
  write_text_file(fresh.file(), text);
  std::error_code ignored;  // older edits that cannot be removed are older, which take_over() sees
  if (slot_.held()) fs::remove(slot_.file(), ignored);
  slot_ = std::move(fresh);
}

Keeping Autosave::write(const Scene* edits, const Origin* of) {
  if (!edits) return remove();
  std::vector<KeepingPlace> places = keeping_places(folder_, of->what);
  std::string why = folder_.empty() ? "neither XDG_STATE_HOME nor HOME names a folder" : "";
  const auto own = std::find(places.begin(), places.end(), slot_.place());
  if (slot_.held() && own != places.end()) std::rotate(places.begin(), own, own + 1);
  for (const KeepingPlace& place : places) {
    try {
      write_at(place, *edits, *of);
      return {place.beside_the_scene ? Keeping::Kind::beside : Keeping::Kind::kept, slot_.file(), why};
    } catch (const std::exception& error) {
      why += (why.empty() ? "" : "; ") + std::string(error.what());
    }
  }
  return {Keeping::Kind::lost, {}, why};
}

Keeping Autosave::remove() {
  std::error_code error;
  if (slot_.held()) fs::remove(slot_.file(), error);
  if (!error) return {};
  return {Keeping::Kind::nothing, slot_.file(), error.message()};
}

Autosave::Autosave(fs::path folder, std::function<void()> on_change)
    : folder_(std::move(folder)),
      writing_(
          [this, on_change = std::move(on_change), told = Keeping()]() mutable {
            flush();
            const Keeping now = keeping(), before = std::exchange(told, now);
            if (on_change && (now.kind != before.kind || now.why != before.why)) on_change();
            return now.failed() ? retry_interval : BackgroundThread::never;
          },
          min_interval) {}

fs::path Autosave::take_over(const std::string& what) {
  KeptSlot newest;
  std::error_code ignored;
  const auto see = [&](KeptSlot&& free) {
    if (!what.empty() && kept_what(free.file()) != what) return;
    const bool newer =
        !newest.held() || fs::last_write_time(free.file(), ignored) > fs::last_write_time(newest.file(), ignored);
    if (newer) newest = std::move(free);
  };
  for (const KeepingPlace& place : keeping_places(folder_, what)) for_free_files(place, see);
  const std::lock_guard file(file_mutex_);
  const std::lock_guard lock(mutex_);
  slot_ = std::move(newest);
  used_ = slot_.held();
  return used_ ? slot_.file() : fs::path();
}

void Autosave::leave() {
  const std::lock_guard file(file_mutex_);
  const std::lock_guard lock(mutex_);
  slot_ = {};
  used_ = false;
}

std::vector<std::string> Autosave::others() const {
  std::vector<std::string> names;
  const auto see = [&names](KeptSlot&& free) {
    const std::string what = kept_what(free.file());
    if (!what.empty() && std::find(names.begin(), names.end(), what) == names.end()) names.push_back(what);
  };
  for (const KeepingPlace& place : keeping_places(folder_, "")) for_free_files(place, see);
  return names;
}

void Autosave::keep(std::shared_ptr<const Scene> scene, std::shared_ptr<const Origin> origin) {
  const std::lock_guard lock(mutex_);
  if (!scene && !used_) return;
  used_ = waits_ = true;
  scene_ = std::move(scene);
  origin_ = std::move(origin);
  writing_.ask();
}

void Autosave::flush() {
  const std::lock_guard file(file_mutex_);
  std::unique_lock lock(mutex_);
  if (!std::exchange(waits_, false) && !keeping_.failed()) return;  // else a disk may have room again
  const auto edits = scene_;
  const auto of = origin_;
  lock.unlock();
  Keeping now = write(edits.get(), of.get());
  lock.lock();
  keeping_ = std::move(now);
  holds_older_ = keeping_.kind == Keeping::Kind::lost && slot_.used();
}

Keeping Autosave::keeping() const {
  const std::lock_guard lock(mutex_);
  return keeping_;
}

std::string Autosave::last_words() const {
  const std::lock_guard file(file_mutex_);
  const std::lock_guard lock(mutex_);
  const Keeping& now = keeping_;
  if (!scene_ && !now.failed()) return "";
  if (!scene_)
    return "edits that were saved or given up are still in " + now.file.string() + " (" + now.why +
           ") and come back at the next start";
  const std::string& title = origin_->title;
  const std::string back = slot_.held() ? way_back(slot_.place(), slot_.file(), *origin_) : "";
  if (now.kind != Keeping::Kind::lost)
    return "the edits of " + title + " are kept" +
           (now.kind == Keeping::Kind::beside ? " in " + now.file.string() : "") + back;
  if (!holds_older_) return "the edits of " + title + " are lost: " + now.why;
  return "the newest edits of " + title + " are lost (" + now.why + "); older ones are kept" + back;
}

}  // namespace tyndall
