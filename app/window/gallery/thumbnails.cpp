#include "app/window/gallery/thumbnails.h"

#include "app/window/system/preferences.h"
#include "core/base/fnv1a.h"
#include "core/image/image_io.h"
#include "core/image/tonemap.h"
#include "core/render/render.h"
#include "core/system/process.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <iterator>
#include <tuple>
#include <utility>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

/// Small pictures are at most so large, in pixels.
constexpr int thumbnail_width = 128, thumbnail_height = 80;

constexpr std::uint32_t samples = 64;
constexpr double longest = 2;  // seconds

/// The width and height of a scene's thumbnail: its image's proportions, within the greatest size.
std::pair<int, int> thumbnail_size(const Scene& scene) {
  const double width = scene.width, height = scene.height;
  const double scale = std::min(thumbnail_width / width, thumbnail_height / height);
  const auto pixels = [scale](double size) { return std::max(1, static_cast<int>(std::lround(scale * size))); };
  return {pixels(width), pixels(height)};
}

/// Renders one, for a second or two, with one thread of the caller's priority. Nothing if go_on() says no, which is
/// asked every 50 ms.
std::optional<ScreenPicture> render_thumbnail(const Scene& scene, const std::function<bool()>& go_on) {
  Scene small = scene;
  std::tie(small.width, small.height) = thumbnail_size(scene);
  RenderOptions options;
  options.threads = 1;
  options.spp = samples;
  options.time_limit = longest;
  options.clean = true;
  const std::shared_ptr<const PreparedScene> prepared = prepare(small);
  const RenderResult result = render(*prepared, options, [&](const RenderProgress&) { return go_on(); });
  if (result.interrupted) return {};
  const std::vector<float> rgb = result.clean ? result.clean->rgb : finished_picture(*prepared, result).image.rgb;
  return ScreenPicture{small.width, small.height, tone_map(rgb, scene.display.exposure, scene.display.tone_map)};
}

/// The picture from the cache, or rendered and put there; an empty one where the scene cannot be read, nothing if it
/// was given up.
std::optional<ScreenPicture> make(const std::string& scene, const std::filesystem::path& folder,
                                  const std::function<bool()>& go_on) {
  try {
    const LoadedScene loaded = load_scene(scene);
    const std::filesystem::path file = folder / (thumbnail_key(loaded) + ".png");
    if (auto kept = folder.empty() ? std::nullopt : read_thumbnail(file)) return kept;
    auto picture = render_thumbnail(loaded.scene, go_on);
    if (picture && !folder.empty()) write_thumbnail(file, *picture);
    return picture;
  } catch (const std::exception&) {
    return ScreenPicture{};
  }
}

}  // namespace

fs::path thumbnails_folder() {
  const fs::path cache = user_folder("XDG_CACHE_HOME", ".cache");
  return cache.empty() ? cache : cache / "tyndall" / "thumbnails";
}

std::string thumbnail_key(const LoadedScene& loaded) {
  std::uint64_t hash = fnv1a("1 ");  // counts the ways in which thumbnails were made
  hash = fnv1a(loaded.text, hash);
  for (std::size_t k = 1; k < loaded.files.size(); ++k) {  // the first one is the scene's own
    std::ifstream file(loaded.files[k], std::ios::binary);
    hash = fnv1a(std::string(std::istreambuf_iterator<char>(file), {}), hash);
  }
  return fmt::format("{:016x}", hash);
}

std::optional<ScreenPicture> read_thumbnail(const fs::path& file) {
  try {
    const LinearImage picture = read_image(file);
    if (picture.width > thumbnail_width || picture.height > thumbnail_height) return {};
    return ScreenPicture{picture.width, picture.height, tone_map(picture.rgb, 0, ToneMap::srgb)};
  } catch (const std::exception&) {
    return {};
  }
}

void write_thumbnail(const fs::path& file, const ScreenPicture& picture) {
  std::error_code ignored;
  fs::create_directories(file.parent_path(), ignored);
  try {
    write_png(file, light_of(picture), 0, ToneMap::srgb, {});
  } catch (const std::exception&) {
    return;  // it will be made again
  }
}

void Thumbnails::want(std::vector<std::string> scenes) {
  wanted_ = std::move(scenes);
  if (jobs_.idle()) begin_next();
}

void Thumbnails::begin_next() {
  for (const std::string& scene : wanted_) {
    if (!known_.insert(scene).second) continue;
    return jobs_.run([this, scene]() -> JobQueue::Result {
      lower_priority(15);
      auto picture = make(scene, folder_, [this] { return !closing_; });
      if (!picture) return {};
      return [this, scene, made = std::move(*picture)] { came_[scene] = made; };
    });
  }
}

bool Thumbnails::collect(const std::function<void(const std::string& scene, const ScreenPicture& picture)>& take) {
  if (!jobs_.collect()) return false;
  const auto came = std::exchange(came_, {});
  for (const auto& [scene, picture] : came) take(scene, picture);
  begin_next();
  return !came.empty();
}

}  // namespace tyndall
