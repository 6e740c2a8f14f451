#include "core/base/target.h"

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
bool runs_avx2() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
         __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("aes") && __builtin_cpu_supports("pclmul") &&
         __builtin_cpu_supports("f16c");
}
#endif
#if defined(TYNDALL_HAVE_AVX512)
bool runs_avx512() {
  return __builtin_cpu_supports("x86-64-v4") && __builtin_cpu_supports("aes") && __builtin_cpu_supports("pclmul");
}
#endif

}  // namespace

const char* name_of(Target target) {
  constexpr const char* names[target_count] = {"scalar", "sse4", "avx2", "avx512"};
  return names[static_cast<int>(target)];
}

std::vector<Target> available_targets() {
  std::vector<Target> list{Target::scalar};
#if defined(TYNDALL_HAVE_SSE4)
  if (runs_sse4()) list.push_back(Target::sse4);
#endif
#if defined(TYNDALL_HAVE_AVX2)
  if (runs_avx2()) list.push_back(Target::avx2);
#endif
#if defined(TYNDALL_HAVE_AVX512)
  if (runs_avx512()) list.push_back(Target::avx512);
#endif
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
