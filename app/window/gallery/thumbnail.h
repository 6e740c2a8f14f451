#pragma once
#include "core/scene/load.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// This room makes the small pictures of scenes, and keeps them and the list of recent files from one start to the
/// next.
namespace tyndall {

/// Small pictures are at most so large, in pixels.
inline constexpr int thumbnail_width = 128, thumbnail_height = 80;

/// A small picture as the screen shows it: 8-bit sRGB, 3 bytes a pixel, top row first.
struct Thumbnail {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// $XDG_CACHE_HOME/tyndall/thumbnails, else ~/.cache/tyndall/thumbnails; empty where neither variable is an absolute
/// path.
std::filesystem::path thumbnails_folder();

/// 16 hex digits that say which picture a scene has: they change with the text of the scene and the bytes of its
/// textures, and with how thumbnails are made.
std::string thumbnail_key(const LoadedScene& loaded);

/// The size of a scene's thumbnail: its image's proportions, within the greatest size.
struct ThumbnailSize {
  int width = 1, height = 1;
};
ThumbnailSize thumbnail_size(const Scene& scene);

/// Renders one, for a second or two, with one thread of the caller's priority. Nothing if go_on() says no, which is
/// asked every 50 ms.
std::optional<Thumbnail> render_thumbnail(const Scene& scene, const std::function<bool()>& go_on);

/// A picture of the cache. Nothing if it is not there, or is damaged.
std::optional<Thumbnail> read_thumbnail(const std::filesystem::path& file);
/// Puts a picture into the cache; fails silently, as it can be made again.
void write_thumbnail(const std::filesystem::path& file, const Thumbnail& picture);

}  // namespace tyndall
