#pragma once
#include <optional>
#include <string_view>
#include <vector>

/// The instruction sets that parts of the program are compiled for, and which of them this CPU can run.
///
/// A room with fast code has one source file for each target, compiled with that target's flags, and a table from
/// targets to functions. Which target is used is decided here, while the program runs, in the same way for every room.
namespace tyndall {

/// In order of width: those of x86-64, then that of 64-bit ARM. The values are indices into the rooms' tables.
enum class Target { scalar, sse4, avx2, avx512, neon };
inline constexpr int target_count = 5;

/// The value of --isa, for example "avx2".
const char* name_of(Target target);

/// The targets compiled into this build, narrowest first; Target::scalar is always the first.
std::vector<Target> built_targets();

/// Those of them that this CPU can run.
std::vector<Target> available_targets();

/// The available target of that name; for "" the widest available one; nullopt if there is none.
std::optional<Target> find_target(std::string_view name);

}  // namespace tyndall
