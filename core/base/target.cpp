#include "core/base/target.h"

#if defined(TYNDALL_HAVE_AVX2)
#include <cpuid.h>
#endif

namespace tyndall {
namespace {

// Each function asks the CPU for every feature that the target's files are compiled with, not only for the one that
// gives the target its name: some CPUs and virtual machines have AVX2 without FMA, for example.
#if defined(TYNDALL_HAVE_SSE4)
bool runs_sse4() {
  return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("aes") && __builtin_cpu_supports("pclmul");
}
#endif
#if defined(TYNDALL_HAVE_AVX2)
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
#endif
#if defined(TYNDALL_HAVE_AVX512)
bool runs_avx512() {
  return runs_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}
#endif

/// Whether this CPU runs a target that this build has.
bool runs(Target target) {
  switch (target) {
#if defined(TYNDALL_HAVE_SSE4)
    case Target::sse4:
      return runs_sse4();
#endif
#if defined(TYNDALL_HAVE_AVX2)
    case Target::avx2:
      return runs_avx2();
#endif
#if defined(TYNDALL_HAVE_AVX512)
    case Target::avx512:
      return runs_avx512();
#endif
    default:
      return true;  // one number at a time runs everywhere, and every 64-bit ARM processor has NEON
  }
}

}  // namespace

const char* name_of(Target target) {
  constexpr const char* names[target_count] = {"scalar", "sse4", "avx2", "avx512", "neon"};
  return names[static_cast<int>(target)];
}

std::vector<Target> built_targets() {
  return {
    Target::scalar,
#if defined(TYNDALL_HAVE_SSE4)
        Target::sse4,
#endif
#if defined(TYNDALL_HAVE_AVX2)
        Target::avx2,
#endif
#if defined(TYNDALL_HAVE_AVX512)
        Target::avx512,
#endif
#if defined(TYNDALL_HAVE_NEON)
        Target::neon,
#endif
  };
}

std::vector<Target> available_targets() {
  std::vector<Target> list = built_targets();
  std::erase_if(list, [](Target target) { return !runs(target); });
  return list;
}

std::optional<Target> find_target(std::string_view name) {
  const std::vector<Target> list = available_targets();
  if (name.empty()) return list.back();
  for (const Target target : list)
    if (name == name_of(target)) return target;
  return std::nullopt;
}

}  // namespace tyndall
