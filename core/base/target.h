#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// The instruction sets that parts of the program are compiled for, and which of them this CPU can run.
///
/// A room with fast code compiles a source file once for each wide target of the build, with that target's flags, and
/// has a table from targets to functions. Which target is used is decided here, while the program runs, in the same way
/// for every room.
namespace tyndall {

/// In order of width: those of x86-64, then those of 64-bit ARM and of browsers.
enum class Target { scalar, sse4, avx2, avx512, neon, wasm };
inline constexpr Target all_targets[] = {Target::scalar, Target::sse4, Target::avx2,
                                         Target::avx512, Target::neon, Target::wasm};

/// Number of floats that one register of the target holds.
constexpr int floats_in(Target target) {
  constexpr int counts[] = {1, 4, 8, 16, 4, 4};
  return counts[static_cast<int>(target)];
}

/// The value of --isa, for example "avx2".
const char* name_of(Target target);
std::string names_of(const std::vector<Target>& targets, const char* separator = " ");

/// The targets compiled into this build, narrowest first; Target::scalar is always the first.
std::vector<Target> built_targets();

/// Those of them that this CPU can run.
std::vector<Target> available_targets();

/// The targets that this CPU can run and that this build lacks, though it could have them.
std::vector<Target> missing_targets();

/// The available target of that name; for "" the widest available one; nullopt if there is none.
std::optional<Target> find_target(std::string_view name);

/// Of a missing target "; " and how to build it, as the end of a message; of other names "".
std::string how_to_build(std::string_view name);

/// What a message says after "expected" where find_target() has found nothing for `name`.
std::string expected_targets(std::string_view name);

/// A sentence where the scalar target is the only one available though others are missing, so that pictures take
/// several times as long as they need; else "".
std::string slow_build_warning();

/// use(std::integral_constant<Target, target>()) for a target among those listed: calls what is compiled once for each.
/// TYNDALL_BUILT_TARGETS in <tyndall_targets.h>, which CMake writes, lists those of the build.
template <Target... listed, class Use>
auto use_target(Target target, const Use& use) {
  decltype(use(std::integral_constant<Target, Target::scalar>())) result{};
  static_cast<void>(((target == listed && (result = use(std::integral_constant<Target, listed>()), true)) || ...));
  return result;
}

}  // namespace tyndall
