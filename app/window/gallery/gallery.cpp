#include "app/window/gallery/gallery.h"

#include "app/files/outputs.h"
#include "app/window/document/autosave.h"
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
#include <utility>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

/// Small pictures are at most so large, in pixels, and have the proportions of the scene's image.
constexpr int thumbnail_width = 128, thumbnail_height = 80;
constexpr int slot_width = 96, slot_height = 60;  // those of cameras

constexpr std::uint32_t samples = 64;
constexpr double longest = 2;  // seconds

/// Renders one, for a second or two, with one thread of the caller's priority. Nothing if go_on() says no, which is
/// asked every 50 ms.
std::optional<ScreenPicture> render_thumbnail(const Scene& scene, const std::function<bool()>& go_on) {
  Scene small = scene;
  const double width = scene.width, height = scene.height;
  const double scale = std::min(thumbnail_width / width, thumbnail_height / height);
  const auto pixels = [scale](double size) { return std::max(1, static_cast<int>(std::lround(scale * size))); };
  small.width = pixels(width), small.height = pixels(height);
  const RenderOptions options{
      .threads = 1, .isa = "", .region = {}, .spp = samples, .time_limit = longest, .clean = true};
  const std::shared_ptr<const PreparedScene> prepared = prepare(small);
  const RenderResult result = render(*prepared, options, [&](const RenderProgress&) { return go_on(); });
  if (result.interrupted) return {};
  const std::vector<float> rgb = result.clean ? result.clean->rgb : finished_picture(*prepared, result).image.rgb;
  return ScreenPicture{small.width, small.height, tone_map(rgb, scene.display.exposure, scene.display.tone_map)};
}

/// The picture from the cache, or rendered and put there; an empty one where the scene cannot be read, nothing if it
/// was given up.
std::optional<ScreenPicture> make(const std::string& scene, const fs::path& folder,
                                  const std::function<bool()>& go_on) {
  try {
    const LoadedScene loaded = load_scene(scene);
    const fs::path file = folder / (thumbnail_key(loaded) + ".png");
    if (auto kept = folder.empty() ? std::nullopt : read_thumbnail(file)) return kept;
    auto picture = render_thumbnail(loaded.scene, go_on);
    if (picture && !folder.empty()) write_thumbnail(file, *picture);
    return picture;
  } catch (const std::exception&) {
    return ScreenPicture{};
  }
}

/// The place in one of the user's folders; empty where there is no such folder.
fs::path within(const fs::path& folder, const char* place) { return folder.empty() ? folder : folder / place; }

/// Makes the folder of a file and writes it, where that can be done.
template <class Write>
void try_to_write(const fs::path& file, const Write& write) {
  std::error_code ignored;
  fs::create_directories(file.parent_path(), ignored);
  try {
    write();
  } catch (const std::exception&) {
    return;  // what was there before stays, and all goes on without
  }
}

/// The picture as OpenGL holds it; null for an empty one.
std::shared_ptr<const PictureTexture> texture_of(const ScreenPicture& picture) {
  if (picture.rgb.empty()) return nullptr;
  return std::make_shared<const PictureTexture>(picture.width, picture.height, picture.rgb);
}

}  // namespace

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
  try_to_write(file, [&] { write_png(file, light_of(picture), 0, ToneMap::srgb, {}); });
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
      return [this, scene, made = std::move(*picture)] { take_(scene, made); };
    });
  }
}

bool Thumbnails::collect() {
  if (!jobs_.collect()) return false;
  begin_next();
  return true;
}

std::vector<fs::path> read_recent_files(const fs::path& list) {
  std::vector<fs::path> files;
  std::ifstream in(list);
  std::error_code ignored;
  for (std::string line; files.size() < max_recent_files && std::getline(in, line);) {
    const fs::path file(line);
    const bool known = std::find(files.begin(), files.end(), file) != files.end();
    if (!known && file.is_absolute() && fs::is_regular_file(file, ignored)) files.push_back(file);
  }
  return files;
}

void add_recent_file(const fs::path& list, const fs::path& file) {
  if (list.empty() || !file.is_absolute() || file.string().find('\n') != std::string::npos) return;
  std::vector<fs::path> files = read_recent_files(list);
  std::erase(files, file);
  files.insert(files.begin(), file);
  files.resize(std::min(files.size(), max_recent_files));
  std::string text;
  for (const fs::path& one : files) text += one.string() + "\n";
  try_to_write(list, [&] { write_text_file(list, text); });
}

Gallery::Gallery(const std::function<void()>& wake)
    : thumbnails(
          within(user_folder("XDG_CACHE_HOME", ".cache"), "tyndall/thumbnails"),
          [this](const std::string& scene, const ScreenPicture& picture) { pictures_[scene] = texture_of(picture); },
          wake),
      list_(within(state_folder(), "recent.txt")),
      recent_(read_recent_files(list_)) {}

void Gallery::note_file(const std::filesystem::path& file) {
  add_recent_file(list_, file);
  recent_ = read_recent_files(list_);
  if (!recent_.empty()) thumbnails.forget(recent_.front().string());
}

ScreenPicture small_picture(const Frame& frame, const Display& display) {
  const bool beauty = frame.view == View::beauty, clean = beauty && frame.clean;
  const std::vector<float>& from = clean ? frame.clean->rgba : beauty ? frame.rgba : frame.beauty;
  const PictureGrid every_pixel{frame.width, frame.height};
  const auto [columns, rows, spacing] = clean ? frame.clean->grid : beauty ? frame.grid : every_pixel;
  if (from.empty() || columns <= 0 || rows <= 0) return {};
  const double fit =
      std::min({1.0, static_cast<double>(slot_width) / columns, static_cast<double>(slot_height) / rows});
  const auto pixels = [fit](int count) { return std::max(1, static_cast<int>(std::lround(fit * count))); };
  return on_sheet({columns, rows, rgb_of(from)}, display, {pixels(columns), pixels(rows)});
}

void store_camera(CameraSlots& slots, const Camera& camera, const Frame* frame, const Display& display) {
  CameraSlot slot{camera, frame ? texture_of(small_picture(*frame, display)) : nullptr};
  std::erase_if(slots, [&](const CameraSlot& other) { return other.camera == camera; });
  if (slots.size() >= max_camera_slots) slots.erase(slots.begin());
  slots.push_back(std::move(slot));
}

std::optional<std::size_t> next_slot(const CameraSlots& slots, const Camera& camera) {
  if (slots.empty()) return {};
  for (std::size_t k = 0; k < slots.size(); ++k)
    if (slots[k].camera == camera) return (k + 1) % slots.size();
  return 0;
}

}  // namespace tyndall
