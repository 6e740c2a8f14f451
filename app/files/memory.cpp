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

constexpr std::uint64_t program_bytes = 11'000'000;

std::uint64_t pixels(std::int64_t width, std::int64_t height) {
  return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

/// what: such as "a render of 4x3 pixels". advice: what could be done.
void check_needed(const std::string& what, std::uint64_t needed, const FreeMemory& free,
                  const std::string& advice = "") {
  if (needed > free.bytes)
    throw UsageError(fmt::format("{} takes {} bytes ({:.3g} GB) of memory, and {:.3g} GB are {}{}", what, needed,
                                 1e-9 * static_cast<double>(needed), 1e-9 * static_cast<double>(free.bytes), free.limit,
                                 advice));
}

/// The most memory that the process then has, bytes. The scene and its textures are not counted.
std::uint64_t memory_needed(const MemoryPlan& plan) {
  const std::uint64_t film = bytes_per_pixel(plan.emission);
  const std::uint64_t picture = 12, estimate = 13, filter = plan.emission ? 153 : 129, shown = 12;
  std::uint64_t written = 0;
  for (const auto& file : plan.files) written = std::max(written, writing(plan, file));
  const std::uint64_t copy = plan.checkpoints ? film : 0, part = plan.parts ? film : 0;
  const std::uint64_t after = picture + std::max(estimate, (plan.clean ? shown : 0) + written);
  const std::uint64_t pixel = film + std::max({copy + estimate, part, copy + (plan.clean ? filter : 0), after});
  return program_bytes + pixel * pixels(plan.width, plan.height);
}

/// The memory that a window takes that renders one picture, bytes. Measured with OpenGL in software.
std::uint64_t memory_needed(const WindowPlan& plan) {
  constexpr std::uint64_t libraries = 134'000'000;  // of the window, fonts and OpenGL
  const std::uint64_t pictures = 31, filter = 172, film = bytes_per_pixel(plan.emission);
  const std::uint64_t all = pixels(plan.width, plan.height);
  const std::uint64_t coarse = std::min<std::uint64_t>(all / 4, 256'000);  // pixels of the first clean view
  const std::uint64_t clean = plan.clean ? filter * all + (film + filter) * coarse : 0;
  return program_bytes + libraries + (film + pictures) * all + clean;
}

}  // namespace

bool has_lights(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const auto& material) { return std::holds_alternative<Light<double>>(material.kind); });
}

void check_memory(const MemoryPlan& plan, const FreeMemory& free) {
  const std::string size = fmt::format("{}x{}", plan.width, plan.height);
  const bool png = std::any_of(plan.files.begin(), plan.files.end(),
                               [&plan](const auto& file) { return image_ending(file, plan.form) == ".png"; });
  if (plan.width * plan.height > max_image_pixels || (png && (3 * plan.width + 1) * plan.height >= 1 << 30))
    throw UsageError(
        fmt::format("{}: found {} pixels, expected at most 2^28, which is what image files hold", plan.place, size));
  check_needed((plan.parts ? "merging films of " : "a render of ") + size + " pixels", memory_needed(plan), free);
}

void check_memory(const WindowPlan& plan, const FreeMemory& free, const std::string& without_clean) {
  const std::string size = fmt::format("a window of {}x{} pixels", plan.width, plan.height);
  const WindowPlan raw{plan.width, plan.height, plan.emission, false};
  const bool advise = plan.clean && memory_needed(raw) <= free.bytes;
  check_needed(size + (plan.clean ? " with its clean view" : ""), memory_needed(plan), free,
               advise ? fmt::format("; without the clean view it takes {:.3g} GB: {}",
                                    1e-9 * static_cast<double>(memory_needed(raw)), without_clean)
                      : "");
}

}  // namespace tyndall
