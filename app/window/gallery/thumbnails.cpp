#include "app/window/gallery/thumbnails.h"

#include <sys/resource.h>

#include <exception>
#include <utility>

namespace tyndall {
namespace {

/// From now on the calling thread, and those that it starts, give way to all others. (On Linux a priority belongs to
/// one thread; elsewhere this changes nothing.)
void yield() {
#ifdef __linux__
  setpriority(PRIO_PROCESS, 0, 15);
#endif
}

/// The picture from the cache, or rendered and put there; an empty one where the scene cannot be read, nothing if it
/// was given up.
std::optional<Thumbnail> make(const std::string& scene, const std::filesystem::path& folder,
                              const std::function<bool()>& go_on) {
  try {
    const LoadedScene loaded = load_scene(scene);
    const std::filesystem::path file = folder / (thumbnail_key(loaded) + ".png");
    if (auto kept = folder.empty() ? std::nullopt : read_thumbnail(file)) return kept;
    auto picture = render_thumbnail(loaded.scene, go_on);
    if (picture && !folder.empty()) write_thumbnail(file, *picture);
    return picture;
  } catch (const std::exception&) {
    return Thumbnail{};
  }
}

}  // namespace

void Thumbnails::want(std::vector<std::string> scenes) {
  wanted_ = std::move(scenes);
  if (jobs_.idle()) begin_next();
}

void Thumbnails::begin_next() {
  for (const std::string& scene : wanted_) {
    if (!known_.insert(scene).second) continue;
    return jobs_.run([this, scene]() -> JobQueue::Result {
      yield();
      auto picture = make(scene, folder_, [this] { return !closing_; });
      if (!picture) return {};
      return [this, scene, made = std::move(*picture)] { came_[scene] = made; };
    });
  }
}

bool Thumbnails::collect(const std::function<void(const std::string& scene, const Thumbnail& picture)>& take) {
  if (!jobs_.collect()) return false;
  const auto came = std::exchange(came_, {});
  for (const auto& [scene, picture] : came) take(scene, picture);
  begin_next();
  return !came.empty();
}

}  // namespace tyndall
