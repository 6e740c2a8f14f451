#pragma once
#include "app/files/outputs.h"

#include <cstdint>
#include <string>

/// How much memory a render takes, and how much there is: known before it is taken.
namespace tyndall {

/// What the memory of a render depends on.
struct MemoryPlan {
  std::int64_t width = 0, height = 0;  ///< of what is rendered
  bool emission = false;               ///< whether the film records emission: the scene has lamps
  bool clean = false;                  ///< whether the picture is filtered
  bool checkpoints = false;            ///< whether the film is copied while it is rendered
  std::vector<std::filesystem::path> files;
  ImageForm form{};
};

/// The most memory that the process has during such a render, bytes. The scene and its textures are not counted.
std::uint64_t memory_needed(const MemoryPlan& plan);

/// Memory that this process could still take, bytes, and what limits it, such as "the machine" or "ulimit -v".
struct FreeMemory {
  std::uint64_t bytes = 0;
  std::string limit;
};
FreeMemory free_memory();

/// Throws UsageError, which says how many bytes the render takes, if it does not fit into the memory that is free; and
/// if it has more pixels than image files can hold.
void check_memory(const MemoryPlan& plan, const FreeMemory& free);

}  // namespace tyndall
