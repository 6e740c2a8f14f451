#pragma once
#include "core/film/film.h"

#include <string_view>

/// Tells whether a film that was stored came back as it was.
namespace tyndall {

/// A number that another film or text hardly shares, and none that differs in one bit alone: of size, region, first
/// sample, unit, sums, counts and planned rounds, and of the text that goes with them. Not for films that an adversary
/// made.
std::uint64_t film_checksum(const Film& film, std::string_view text);

}  // namespace tyndall
