#pragma once
#include "core/film/film.h"

#include <string_view>

/// Detects whether a stored film was read back unchanged.
namespace tyndall {

/// A checksum of size, region, first sample, quantum, sums, counts and planned rounds, and of the text that goes with
/// them. Films or texts that differ in a single bit always get different ones, others almost always. Not safe against
/// films made by an adversary.
std::uint64_t film_checksum(const Film& film, std::string_view text);

}  // namespace tyndall
