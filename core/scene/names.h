#pragma once
#include "core/scene/scene.h"

#include <string_view>
#include <vector>

/// The names of choices, as scene files and the command line spell them.
namespace tyndall {

template <class E>
struct Named {
  E value;
  const char* name;
  const char* missing = nullptr;  ///< not null: this build cannot do it, and why
};

inline constexpr Named<Integrator> integrators[] = {{Integrator::path, "path"},
                                                    {Integrator::nee, "nee", "light sampling is not built yet"},
                                                    {Integrator::mis, "mis", "light sampling is not built yet"}};
inline constexpr Named<SamplerKind> samplers[] = {{SamplerKind::random, "random"},
                                                  {SamplerKind::sobol, "sobol", "Sobol' sampling is not built yet"}};
inline constexpr Named<FresnelKind> fresnel_rules[] = {{FresnelKind::exact, "exact"},
                                                       {FresnelKind::schlick, "schlick"}};
inline constexpr Named<ToneMap> tone_maps[] = {{ToneMap::srgb, "srgb"}, {ToneMap::aces, "aces"}};
inline constexpr Named<Noise<>::Style> noise_styles[] = {
    {Noise<>::Style::perlin, "perlin"}, {Noise<>::Style::turbulence, "turbulence"}, {Noise<>::Style::marble, "marble"}};

/// The entry of a name; null if there is none. The entry may be `missing`.
template <class E, std::size_t n>
constexpr const Named<E>* find_name(const Named<E> (&table)[n], std::string_view name) {
  for (const auto& entry : table)
    if (name == entry.name) return &entry;
  return nullptr;
}

template <class E, std::size_t n>
constexpr const char* name_of(const Named<E> (&table)[n], E value) {
  for (const auto& entry : table)
    if (entry.value == value) return entry.name;
  return "";
}

/// The names that this build can do.
template <class E, std::size_t n>
std::vector<std::string_view> available_names(const Named<E> (&table)[n]) {
  std::vector<std::string_view> names;
  for (const auto& entry : table)
    if (!entry.missing) names.emplace_back(entry.name);
  return names;
}

}  // namespace tyndall
