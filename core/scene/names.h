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
};

inline constexpr Named<Integrator> integrators[] = {{Integrator::path, "path"},
                                                    {Integrator::nee, "nee"},
                                                    {Integrator::mis, "mis"}};
inline constexpr Named<SamplerKind> samplers[] = {{SamplerKind::random, "random"},
                                                  {SamplerKind::sobol, "sobol"}};
inline constexpr Named<FresnelKind> fresnel_rules[] = {{FresnelKind::exact, "exact"},
                                                       {FresnelKind::schlick, "schlick"}};
inline constexpr Named<ToneMap> tone_maps[] = {{ToneMap::srgb, "srgb"}, {ToneMap::aces, "aces"}};
inline constexpr Named<Noise<>::Style> noise_styles[] = {
    {Noise<>::Style::perlin, "perlin"}, {Noise<>::Style::turbulence, "turbulence"}, {Noise<>::Style::marble, "marble"}};

/// The entry of a name; null if there is none.
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

template <class E, std::size_t n>
std::vector<std::string_view> names_in(const Named<E> (&table)[n]) {
  std::vector<std::string_view> names;
  for (const auto& entry : table) names.emplace_back(entry.name);
  return names;
}

}  // namespace tyndall
