#pragma once
#include "core/base/choice.h"
#include "core/base/vec.h"

/// Random numbers as a pure function of (seed, pixel, sample, dimension): every thread, tile, pass and machine gets the
/// same number, and no state has to be kept or ordered.
namespace tyndall {

/// The fixed table of dimensions, one for each use of a random number. A sample has the dimensions of the camera, then
/// `per_event` dimensions for each scattering event, used or not, so that leaving out a model never shifts the numbers
/// of another.
namespace dimension {
// camera
inline constexpr std::uint32_t pixel = 0;  // and 1
inline constexpr std::uint32_t lens = 2;   // and 3
inline constexpr std::uint32_t time = 4;
inline constexpr std::uint32_t camera_count = 8;
// within an event
inline constexpr std::uint32_t free_flight = 0;
inline constexpr std::uint32_t lobe = 1;
inline constexpr std::uint32_t direction = 2;  // and 3
inline constexpr std::uint32_t radius = 4;
inline constexpr std::uint32_t light_choice = 5;
inline constexpr std::uint32_t light_point = 6;  // and 7
inline constexpr std::uint32_t roulette = 8;
inline constexpr std::uint32_t near_pair = 9;
inline constexpr std::uint32_t near_distance = 10;
inline constexpr std::uint32_t near_point = 12;      // and 13
inline constexpr std::uint32_t specular_point = 14;  // and 15
inline constexpr std::uint32_t per_event = 16;
// Within an event as well, but far from the numbers above, so that these may grow: for Sampler::independent_bits().
inline constexpr std::uint32_t event_sequence = 0x40000000u;
inline constexpr std::uint32_t specular_root = 0x40000001u;
inline constexpr std::uint32_t specular_connect = 0x40000002u;
inline constexpr std::uint32_t specular_pair = 0x40000003u;
inline constexpr std::uint32_t event_sequence_tail = 0x40000004u;
inline constexpr std::uint32_t guided_query = 0x40000005u;
inline constexpr std::uint32_t guided_events = 0x40000006u;
inline constexpr std::uint32_t guided_strategy = 0x40000007u;
inline constexpr std::uint32_t guided_direction = 0x40000008u;  // and the next one
inline constexpr std::uint32_t guided_path = 0x50000000u;       // the first of the events of a guided path
inline constexpr std::uint32_t sky_place = 0x4000000au;         // and the next one
}  // namespace dimension

inline constexpr std::uint32_t golden_ratio = 0x9e3779b9u;  ///< 2^32 / φ, odd: spreads consecutive dimensions

/// A bijection of 32 bits in which every input bit moves every output bit about half of the time.
/// Form and constants: C. Wellons, hash-prospector (multiply and xor-shift with two rounds).
template <class U>
TYNDALL_INLINE U hash(U x) {
  x = x ^ shift_right<16>(x);
  x = x * U(0x21f0aaadu);
  x = x ^ shift_right<15>(x);
  x = x * U(0xd35a2d97u);
  return x ^ shift_right<15>(x);
}

/// Turns random bits into a number in [0, 1): a multiple of 2^-24, which float holds exactly; never 1.
template <class F>
TYNDALL_INLINE F unit_interval(UintOf<F> h) {
  return from_int<F>(as_int(shift_right<8>(h))) * F(0x1p-24f);
}
/// Turns random bits into a number in (0, 1] that keeps its precision towards 0 (2^-32): for logarithms.
template <class F>
TYNDALL_INLINE F unit_interval_open(UintOf<F> h) {
  return (from_int<F>(as_int(shift_right<1>(h))) + F(0.5f)) * F(0x1p-31f);
}

template <class F>
struct Pair {
  F x, y;
};

/// The order of the bits reversed.
template <class U>
TYNDALL_INLINE U reverse_bits(U x) {
  x = shift_left<16>(x) | shift_right<16>(x);
  x = (shift_left<8>(x & U(0x00ff00ffu))) | (shift_right<8>(x) & U(0x00ff00ffu));
  x = (shift_left<4>(x & U(0x0f0f0f0fu))) | (shift_right<4>(x) & U(0x0f0f0f0fu));
  x = (shift_left<2>(x & U(0x33333333u))) | (shift_right<2>(x) & U(0x33333333u));
  return (shift_left<1>(x & U(0x55555555u))) | (shift_right<1>(x) & U(0x55555555u));
}

/// A random permutation, chosen by `seed`, of an index whose bits are reversed. Each digit depends on higher digits
/// only, so the strata of the sequence stay (nested uniform scrambling). Laine & Karras, Stratified Sampling for
/// Stochastic Transparency, EGSR 2011, section 3; the constants are N. Vegdahl's.
template <class U>
TYNDALL_INLINE U shuffle_index(U x, U seed) {
  x = x ^ (x * U(0x3d20adeau));
  x = x + seed;
  x = x * (shift_right<16>(seed) | U(1u));
  x = x ^ (x * U(0x05526c56u));
  return x ^ (x * U(0x53a22864u));
}

/// Second dimension of Sobol' points from the reversed index: the Pascal matrix modulo 2, as a butterfly.
template <class U>
TYNDALL_INLINE U sobol_second(U x) {
  x = x ^ shift_left<16>(x);
  x = x ^ shift_left<8>(x & U(0x00ff00ffu));
  x = x ^ shift_left<4>(x & U(0x0f0f0f0fu));
  x = x ^ shift_left<2>(x & U(0x33333333u));
  return x ^ shift_left<1>(x & U(0x55555555u));
}

/// The source of a path's random numbers. To add a sampler, add its value and label here and its cases in Sampler.
enum class SamplerKind { random, sobol };

constexpr Label label(SamplerKind sampler) {
  switch (sampler) {
    case SamplerKind::random:
      return {"random", "independent numbers"};
    case SamplerKind::sobol:
      return {"sobol", "a scrambled Sobol' sequence, less noise"};
  }
  return {};
}

/// The random numbers of one sample. `random`: independent, counter-based. `sobol`: each dimension or pair of
/// dimensions is a (0,2)-sequence of its own over the samples of a pixel, shuffled and digitally shifted (Burley,
/// Practical Hash-based Owen Scrambling, JCGT 9(4), 2020, section 4, with a digital shift in place of the scrambling);
/// sample i is point i/2 of randomisation i mod 2.
template <class F>
struct Sampler {
  using U = UintOf<F>;
  U low,
      high;  ///< random: 64 bits that name (seed, x, y, sample); sobol: pixel and half, and the point's reversed index
  U event;   ///< golden_ratio · the first dimension of the current event
  SamplerKind kind;

  /// Returns the key of one sample. x, y: pixel in full-image coordinates. `random`: two chains of hashes in different
  /// orders, so that two samples have the same key only with probability 2^-64. The seed is hashed before it is
  /// combined with a coordinate: otherwise neighbouring seeds would give the same picture with its rows exchanged.
  TYNDALL_INLINE static Sampler of(std::uint32_t seed, U x, U y, U sample, SamplerKind kind = SamplerKind::random) {
    const U a = hash(hash(U(hash(seed ^ 0x68bc21ebu)) ^ y) ^ x);
    switch (kind) {
      case SamplerKind::sobol:
        return {hash(a ^ (sample & U(1u))), reverse_bits(shift_right<1>(sample)), U(0u), kind};
      case SamplerKind::random:
        break;
    }
    const U b = hash(hash(U(hash(seed + 0x02e5be93u)) ^ sample) ^ y);
    return {hash(a ^ sample), hash(b ^ x), U(0u), kind};
  }
  /// Returns 32 random bits for dimension `offset` of the current event.
  TYNDALL_INLINE U random_bits(std::uint32_t offset) const {
    U x = low + event + U(offset * golden_ratio);
    switch (kind) {
      case SamplerKind::sobol:
        x = hash(x);
        return shuffle_index(high, x) ^ (x * U(0x9e3779b1u));
      case SamplerKind::random:
        break;
    }
    x = x ^ shift_right<16>(x);
    x = x * U(0x21f0aaadu);
    x = (x ^ shift_right<15>(x)) + high;
    x = x * U(0xd35a2d97u);
    return x ^ shift_right<15>(x);
  }
  TYNDALL_INLINE F next_1d(std::uint32_t offset) const { return unit_interval<F>(random_bits(offset)); }
  /// Like random_bits(), but independent of the pixel's other samples also with `sobol`. Evenly spread numbers are
  /// slightly correlated between dimensions; a choice that decides the meaning of other numbers, such as the event
  /// sequence of a specular path, must be independent.
  TYNDALL_INLINE U independent_bits(std::uint32_t offset) const {
    if (kind != SamplerKind::sobol) return random_bits(offset);
    return hash(hash(low + event + U(offset * golden_ratio)) ^ high);
  }
  TYNDALL_INLINE F independent_1d(std::uint32_t offset) const { return unit_interval<F>(independent_bits(offset)); }
  /// Returns dimensions offset and offset + 1: a point of the unit square, spread evenly together with the points of
  /// the pixel's other samples.
  TYNDALL_INLINE Pair<F> next_2d(std::uint32_t offset) const {
    if (kind != SamplerKind::sobol) return {next_1d(offset), next_1d(offset + 1)};
    const U seed = hash(low + event + U(offset * golden_ratio));
    const U index = shuffle_index(high, seed);
    return {unit_interval<F>(index ^ (seed * U(0x9e3779b1u))),
            unit_interval<F>(sobol_second(index) ^ (seed * U(0x85ebca6bu)))};
  }
  /// Returns a number in (0, 1], for -log(u). Media that share one event each have their own `stream`.
  TYNDALL_INLINE F open(std::uint32_t offset, std::uint32_t stream) const {
    return unit_interval_open<F>(random_bits(offset + stream * 0x10000u));
  }
  TYNDALL_INLINE void next_event() { event = event + U(dimension::per_event * golden_ratio); }
};

}  // namespace tyndall
