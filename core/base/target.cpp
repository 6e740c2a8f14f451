#include "core/base/target.h"

#include <algorithm>
#if defined(__x86_64__)
#include <cpuid.h>
#endif
#include <tyndall_targets.h>

namespace tyndall {
namespace {

#if defined(__x86_64__)
// Each function asks the CPU for every feature that the target's files are compiled with, not only for the one that
// gives the target its name: some CPUs and virtual machines have AVX2 without FMA, for example.
bool runs_sse4() {
  return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("aes") && __builtin_cpu_supports("pclmul");
}
/// What the function that compilers have for such questions does not know by name in each of them: half floats, loads
/// of reversed bytes, counts of leading zeros (Intel 64 and IA-32 Architectures Software Developer's Manual, CPUID).
bool has_f16c_movbe_lzcnt() {
  unsigned a = 0, b = 0, c = 0, extended = 0, d = 0;
  if (!__get_cpuid(1, &a, &b, &c, &d)) return false;
  if (!__get_cpuid(0x80000001u, &a, &b, &extended, &d)) return false;
  return (c & bit_F16C) && (c & bit_MOVBE) && (extended & bit_LZCNT);
}
bool runs_avx2() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
         __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("aes") && __builtin_cpu_supports("pclmul") &&
         has_f16c_movbe_lzcnt();
}
bool runs_avx512() {
  return runs_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}
#endif

bool runs(Target target) {
  switch (target) {
    case Target::scalar:
      return true;
#if defined(__x86_64__)
    case Target::sse4:
      return runs_sse4();
    case Target::avx2:
      return runs_avx2();
    case Target::avx512:
      return runs_avx512();
#elif defined(__aarch64__)
    case Target::neon:
      return true;  // every 64-bit ARM processor has it
#elif defined(__wasm__)
    case Target::wasm:
      return true;  // a page without it is not even loaded
#endif
    default:
      return false;
  }
}

constexpr const char* build_all = "; \"TYNDALL_INSTRUCTION_SETS=all ./run version\" builds all instruction sets";

}  // namespace

const char* name_of(Target target) {
  constexpr const char* names[] = {"scalar", "sse4", "avx2", "avx512", "neon", "wasm"};
  return names[static_cast<int>(target)];
}

std::string names_of(const std::vector<Target>& targets, const char* separator) {
  std::string names;
  for (const Target target : targets) names += (names.empty() ? "" : separator) + std::string(name_of(target));
  return names;
}

std::vector<Target> built_targets() { return {TYNDALL_BUILT_TARGETS}; }

std::vector<Target> available_targets() {
  std::vector<Target> list = built_targets();
  std::erase_if(list, [](Target target) { return !runs(target); });
  return list;
}

std::vector<Target> missing_targets() {
  const std::vector<Target> built = built_targets();
  std::vector<Target> list = {TYNDALL_ALL_TARGETS};
  std::erase_if(list, [&](Target t) { return !runs(t) || std::find(built.begin(), built.end(), t) != built.end(); });
  return list;
}

std::optional<Target> find_target(std::string_view name) {
  const std::vector<Target> list = available_targets();
  if (name.empty()) return list.back();
  for (const Target target : list)
    if (name == name_of(target)) return target;
  return std::nullopt;
}

std::string how_to_build(std::string_view name) {
  for (const Target target : missing_targets())
    if (name == name_of(target)) return build_all;
  return "";
}

std::string expected_targets(std::string_view name) {
  std::string text = names_of(available_targets(), " or ");
  text += ", which this build has and this CPU can run";
  return text += how_to_build(name);
}

std::string slow_build_warning() {
  if (available_targets().back() != Target::scalar || missing_targets().empty()) return "";
  return std::string("this build has only the scalar kernels, which take several times as long as those of ") +
         name_of(missing_targets().back()) + " on this CPU" + build_all;
}

}  // namespace tyndall
