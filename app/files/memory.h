#pragma once
#include "app/files/outputs.h"
#include "core/system/processors.h"

#include <cstdint>
#include <string>

/// How much memory rendering, merging, filtering or a window takes, and how much there is: known before it is taken.
namespace tyndall {

/// What memory depends on. All commands hold one film, and write files of it.
struct MemoryPlan {
  std::int64_t width = 0, height = 0;  ///< of the film
  std::string place{};                 ///< what says so, as messages call it: "cover.json: /image"
  bool emission = false;               ///< whether the film records emission: the scene has lights
  bool clean = false;                  ///< whether the picture is filtered, or a window's clean view is on
  bool checkpoints = false;            ///< whether the film is copied while it is rendered
  bool parts = false;                  ///< whether another film is added to it
  std::vector<std::filesystem::path> files{};
  ImageForm form{};
  bool window = false;  ///< whether a window renders the picture, not a command
};

/// Whether films of the scene record emission.
bool has_lights(const Scene& scene);

/// Throws UsageError, which says how many bytes the picture takes, if it does not fit into the memory that is free; and
/// if it has more pixels than image files can hold. without_clean: tells how to switch a window's clean view off.
void check_memory(const MemoryPlan& plan, const FreeMemory& free, const std::string& without_clean = "");

}  // namespace tyndall
