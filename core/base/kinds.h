#pragma once
#include <cstdint>
#include <type_traits>
#include <variant>

/// Lists of kinds: a std::variant names every material, texture or shape there is, and compiled scenes carry a kind's
/// place in that list. The place is always found from the type, never counted by hand.
namespace tyndall {

template <class Kind, class List>
struct PlaceInList;
template <class Kind, class... Kinds>
struct PlaceInList<Kind, std::variant<Kinds...>> {
  static constexpr std::int32_t find() {
    static_assert((std::is_same_v<Kind, Kinds> || ...), "this kind is not in the list");
    std::int32_t place = 0;
    (void)((std::is_same_v<Kind, Kinds> || (++place, false)) || ...);
    return place;
  }
};

/// The place of a kind in a list, counted from 0.
template <class Kind, class List>
inline constexpr std::int32_t place_in = PlaceInList<Kind, List>::find();

/// Functions for std::visit, one a kind: a kind without one does not compile.
template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;  // Clang before 17 does not find it by itself

}  // namespace tyndall
