#include "core/kernel/kernels.h"

namespace tyndall {
namespace {

// Every feature that a file was compiled with is asked for, not just the set's namesake.
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

void Kernels::render_unit(const SceneView& scene, const Unit& unit, double film_unit, FilmPixel* pixels,
                          UnitCounts& counts) const {
  render_units[static_cast<int>(scene.kernel)](scene, unit, film_unit, pixels, counts);
}

std::vector<Kernels> available_kernels() {
  std::vector<Kernels> list{scalar_kernels()};
#if defined(TYNDALL_HAVE_SSE4)
  if (runs_sse4()) list.push_back(sse4_kernels());
#endif
#if defined(TYNDALL_HAVE_AVX2)
  if (runs_avx2()) list.push_back(avx2_kernels());
#endif
#if defined(TYNDALL_HAVE_AVX512)
  if (runs_avx512()) list.push_back(avx512_kernels());
#endif
  return list;
}

std::optional<Kernels> choose_kernels(std::string_view isa) {
  const std::vector<Kernels> list = available_kernels();
  if (isa.empty()) return list.back();
  if (isa == "double") return double_kernels();
  for (const Kernels& kernels : list)
    if (kernels.isa == isa) return kernels;
  return std::nullopt;
}

}  // namespace tyndall
