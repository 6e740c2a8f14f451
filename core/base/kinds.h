#pragma once
#include <cstdint>
#include <type_traits>
#include <variant>

/// Lists of kinds: a std::variant lists all materials, textures or shapes, and compiled scenes store a kind as its
/// index in that list. The index is always derived from the type.
namespace tyndall {

template <class Kind, class... Kinds>
constexpr std::int32_t find_place_in(const std::variant<Kinds...>*) {
  static_assert((std::is_same_v<Kind, Kinds> || ...), "this kind is not in the list");
  std::int32_t place = 0;
  (void)((std::is_same_v<Kind, Kinds> || (++place, false)) || ...);
  return place;
}

/// The index of a kind in a list, from 0.
template <class Kind, class List>
inline constexpr std::int32_t place_in = find_place_in<Kind>(static_cast<const List*>(nullptr));

/// A set of functions for std::visit, one for each kind. A kind without a function does not compile.
template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;  // Clang before 17 does not find it by itself

}  // namespace tyndall
