#include "app/files/memory.h"

#include "app/text/values.h"
#include "core/film/film.h"
#include "core/image/image_io_file.h"

#include <fmt/core.h>

#include <algorithm>

namespace tyndall {
namespace {

/// Bytes a pixel that writing a file takes beside film and picture. Measured, like the numbers of memory_needed().
std::uint64_t writing(const MemoryPlan& plan, const std::filesystem::path& file) {
  const std::string ending = image_ending(file, plan.form);
  if (ending == ".exr") return 52 + (plan.clean ? 16 : 0);  // layers, one of them also in 16 bits
  if (ending == ".hdr") return 26;
  if (ending == ".ppm") return 3;
  return ending == ".png" ? 20 : 0;
}

/// The most memory that the process then has, bytes. The scene and its textures are not counted. Windows were measured
/// with OpenGL in software.
std::uint64_t memory_needed(const MemoryPlan& plan) {
  constexpr std::uint64_t program = 11'000'000, window = 134'000'000;  // its libraries, fonts and OpenGL
  const std::uint64_t film = bytes_per_pixel(plan.emission), all = static_cast<std::uint64_t>(plan.width * plan.height);
  if (plan.window) {
    constexpr std::uint64_t pictures = 31, filter = 172;
    const std::uint64_t coarse = std::min<std::uint64_t>(all / 4, 256'000);  // pixels of the first clean view
    return program + window + (film + pictures) * all + (plan.clean ? filter * all + (film + filter) * coarse : 0);
  }
  const std::uint64_t picture = 12, estimate = 13, filter = plan.emission ? 153 : 129, shown = 12;
  std::uint64_t written = 0;
  for (const auto& file : plan.files) written = std::max(written, writing(plan, file));
  const std::uint64_t copy = plan.checkpoints ? film : 0, part = plan.parts ? film : 0;
  const std::uint64_t after = picture + std::max(estimate, (plan.clean ? shown : 0) + written);
  return program + all * (film + std::max({copy + estimate, part, copy + (plan.clean ? filter : 0), after}));
}

}  // namespace

bool has_lights(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const auto& material) { return std::holds_alternative<Light<double>>(material.kind); });
}

void check_memory(const MemoryPlan& plan, const FreeMemory& free, const std::string& without_clean) {
  const std::string size = fmt::format("{}x{}", plan.width, plan.height);
  const bool png = std::any_of(plan.files.begin(), plan.files.end(),
                               [&plan](const auto& file) { return image_ending(file, plan.form) == ".png"; });
  if (!plan.window &&
      (plan.width * plan.height > max_image_pixels || (png && (3 * plan.width + 1) * plan.height >= 1 << 30)))
    throw UsageError(
        fmt::format("{}: found {} pixels, expected at most 2^28, which is what image files hold", plan.place, size));
  const auto gigabytes = [](std::uint64_t bytes) {
    return fmt::format("{:.3g} GB", 1e-9 * static_cast<double>(bytes));
  };
  const std::uint64_t needed = memory_needed(plan);
  if (needed <= free.bytes) return;
  MemoryPlan raw = plan;
  raw.clean = false;
  const std::uint64_t needed_raw = memory_needed(raw);
  const bool advise = plan.window && plan.clean && needed_raw <= free.bytes;
  throw UsageError(fmt::format(
      "{} of {} pixels{} takes {} bytes ({}) of memory, and {} are {}{}",
      plan.window  ? "a window"
      : plan.parts ? "merging films"
                   : "a render",
      size, plan.window && plan.clean ? " with its clean view" : "", needed, gigabytes(needed), gigabytes(free.bytes),
      free.limit, advise ? "; without the clean view it takes " + gigabytes(needed_raw) + ": " + without_clean : ""));
}

}  // namespace tyndall
