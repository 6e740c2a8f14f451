#include "app/window/gallery/thumbnail.h"

#include "app/files/user_folders.h"
#include "core/base/fnv1a.h"
#include "core/image/image_io.h"
#include "core/image/tonemap.h"
#include "core/render/render.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <iterator>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t samples = 64;
constexpr double longest = 2;  // seconds

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

ThumbnailSize thumbnail_size(const Scene& scene) {
  const double width = scene.width, height = scene.height;
  const double scale = std::min(thumbnail_width / width, thumbnail_height / height);
  const auto pixels = [scale](double size) { return std::max(1, static_cast<int>(std::lround(scale * size))); };
  return {pixels(width), pixels(height)};
}

std::optional<Thumbnail> render_thumbnail(const Scene& scene, const std::function<bool()>& go_on) {
  Scene small = scene;
  const ThumbnailSize size = thumbnail_size(scene);
  small.width = size.width, small.height = size.height;
  RenderOptions options;
  options.threads = 1;
  options.spp = samples;
  options.time_limit = longest;
  options.clean = true;
  const std::shared_ptr<const PreparedScene> prepared = prepare(small);
  const RenderResult result = render(*prepared, options, [&](const RenderProgress&) { return go_on(); });
  if (result.interrupted) return {};
  const std::vector<float> rgb = result.clean ? result.clean->rgb : finished_picture(*prepared, result).image.rgb;
  return Thumbnail{size.width, size.height, tone_map(rgb, scene.display.exposure, scene.display.tone_map)};
}

std::optional<Thumbnail> read_thumbnail(const fs::path& file) {
  try {
    const LinearImage picture = read_image(file);
    if (picture.width > thumbnail_width || picture.height > thumbnail_height) return {};
    return Thumbnail{picture.width, picture.height, tone_map(picture.rgb, 0, ToneMap::srgb)};
  } catch (const std::exception&) {
    return {};
  }
}

void write_thumbnail(const fs::path& file, const Thumbnail& picture) {
  LinearImage linear{picture.width, picture.height, {}};
  for (const std::uint8_t byte : picture.rgb) linear.rgb.push_back(srgb_decode(static_cast<float>(byte) / 255.0f));
  std::error_code ignored;
  fs::create_directories(file.parent_path(), ignored);
  try {
    write_png(file, linear, 0, ToneMap::srgb, {});
  } catch (const std::exception&) {
    return;  // it will be made again
  }
}

}  // namespace tyndall
