#pragma once
#include "core/base/lanes_simd.h"
#include "core/base/math.h"
#include "core/base/random.h"
#include "tests/base/lanes_report.h"

/// Each operation of core/base/lanes_simd.h against the same on float, lane by lane. Included by one file per
/// instruction set, which is compiled with that set's flags, defines Wide, the number type that is checked, before, and
/// holds nothing else.
namespace tyndall::test {
namespace {

inline constexpr int width = lanes_of<Wide>;

/// Inputs with every kind of number that a kernel can meet.
const float special_numbers[] = {0.0f,  -0.0f,   1.0f,    -1.0f,    0.5f,    -2.5f, 1e-38f, -1e30f,
                                 1e20f, 3.7e-5f, 8388607, 16777216, -123.4f, 2.0f,  0.3f,   __builtin_inff()};

[[maybe_unused]] float number(int i) {
  const std::uint32_t h = hash(static_cast<std::uint32_t>(i) * 3u + 1u);
  if (h % 4u == 0) return special_numbers[h / 4u % 16u];
  return (unit_interval<float>(h) - 0.5f) * (h % 4u == 1 ? 4.0f : 1000.0f);
}

/// Counts lanes in which something differs from what one path at a time would do.
struct Differences {
  int count = 0;
  void expect(const float* wide, const float* plain) {
    for (int k = 0; k < width; ++k)
      count += float_bits(wide[k]) != float_bits(plain[k]) && !(wide[k] != wide[k] && plain[k] != plain[k]);
  }
  void expect(const std::int32_t* wide, const std::int32_t* plain) {
    for (int k = 0; k < width; ++k) count += wide[k] != plain[k];
  }
  void expect(std::uint32_t wide, const bool* plain) {
    for (int k = 0; k < width; ++k) count += (wide >> k & 1u) != (plain[k] ? 1u : 0u);
    if constexpr (width < 32) count += wide >> width != 0;
  }
};

/// Inputs of one round: three groups of floats and two of whole numbers.
struct Inputs {
  float a[width], b[width], c[width];
  std::int32_t i[width], j[width];
  bool m[width], n[width];
  explicit Inputs(int round) {
    for (int k = 0; k < width; ++k) {
      const int at = 7 * (round * width + k);
      a[k] = number(at), b[k] = number(at + 1), c[k] = number(at + 2);
      i[k] = as_int(hash(static_cast<std::uint32_t>(at + 3)));
      j[k] = k % 3 ? i[k] : as_int(hash(static_cast<std::uint32_t>(at + 4)));  // often equal
      if (round % 2) i[k] %= 100, j[k] %= 100;
      m[k] = at % 3 == 1, n[k] = at % 5 < 2;
    }
  }
};

template <class WideF, class PlainF>
void check_floats(Differences& d, const Inputs& in, WideF wide, PlainF plain) {
  float got[width], expected[width];
  store(got, wide(load<Wide>(in.a), load<Wide>(in.b), load<Wide>(in.c)));
  for (int k = 0; k < width; ++k) expected[k] = plain(in.a[k], in.b[k], in.c[k]);
  d.expect(got, expected);
}
template <class F>
void check_floats(Differences& d, const Inputs& in, F f) {
  check_floats(d, in, f, f);
}
template <class F>
void check_ints(Differences& d, const Inputs& in, F f) {
  std::int32_t got[width], expected[width];
  store(got, f(load<Wide>(in.i), load<Wide>(in.j)));
  for (int k = 0; k < width; ++k) expected[k] = f(in.i[k], in.j[k]);
  d.expect(got, expected);
}
template <class F>
void check_masks(Differences& d, const Inputs& in, F f) {
  bool expected[width];
  for (int k = 0; k < width; ++k) expected[k] = f(in.a[k], in.b[k], in.i[k], in.j[k]);
  d.expect(bits(f(load<Wide>(in.a), load<Wide>(in.b), load<Wide>(in.i), load<Wide>(in.j))), expected);
}

[[maybe_unused]] std::uint32_t bits_of(const bool* m) {
  std::uint32_t b = 0;
  for (int k = 0; k < width; ++k) b |= (m[k] ? 1u : 0u) << k;
  return b;
}

[[maybe_unused]] int differences_in_arithmetic(int rounds) {
  Differences d;
  for (int round = 0; round < rounds; ++round) {
    const Inputs in(round);
    check_floats(d, in, [](auto a, auto b, auto) { return a + b; });
    check_floats(d, in, [](auto a, auto b, auto) { return a - b; });
    check_floats(d, in, [](auto a, auto b, auto) { return a * b; });
    check_floats(d, in, [](auto a, auto b, auto) { return a / b; });
    check_floats(d, in, [](auto a, auto, auto) { return -a; });
    check_floats(d, in, [](auto a, auto, auto) { return abs(a); });
    check_floats(d, in, [](auto a, auto, auto) { return sqrt(abs(a)); });
    check_floats(d, in, [](auto a, auto b, auto) { return min(a, b); });
    check_floats(d, in, [](auto a, auto b, auto) { return max(a, b); });
    check_floats(d, in, [](auto a, auto b, auto) { return copy_sign(a, b); });
    check_floats(d, in, [](auto a, auto, auto) { return floor(a) + decltype(a)(0.0f); });  // either zero will do
    // Fused or not, as the target has it; never anything else.
#if defined(__FMA__) || defined(__ARM_FEATURE_FMA)
    const auto fused = [](float a, float b, float c) { return __builtin_fmaf(a, b, c); };
#else
    const auto fused = [](float a, float b, float c) { return a * b + c; };
#endif
    check_floats(
        d, in, [](Wide a, Wide b, Wide c) { return mul_add(a, b, c); }, fused);
    check_floats(
        d, in, [](Wide a, Wide b, Wide c) { return neg_mul_add(a, b, c); },
        [&](float a, float b, float c) { return fused(-a, b, c); });
  }
  return d.count;
}

[[maybe_unused]] int differences_in_whole_numbers(int rounds) {
  Differences d;
  for (int round = 0; round < rounds; ++round) {
    const Inputs in(round);
    const auto u = [](auto i) { return as_uint(i); };
    check_ints(d, in, [&](auto i, auto j) { return as_int(u(i) + u(j)); });
    check_ints(d, in, [&](auto i, auto j) { return as_int(u(i) * u(j)); });
    check_ints(d, in, [&](auto i, auto j) { return as_int(u(i) ^ u(j)); });
    check_ints(d, in, [&](auto i, auto j) { return as_int(u(i) & u(j)); });
    check_ints(d, in, [&](auto i, auto j) { return as_int(u(i) | u(j)); });
    check_ints(d, in, [&](auto i, auto) { return as_int(shift_left<7>(u(i))); });
    check_ints(d, in, [&](auto i, auto) { return as_int(shift_right<7>(u(i))); });
    check_ints(d, in, [&](auto i, auto j) { return as_int(hash(u(i) ^ u(j))); });
    check_ints(d, in, [](auto i, auto j) { return i & j; });
    if (round % 2) {
      check_ints(d, in, [](auto i, auto j) { return i + j; });
      check_ints(d, in, [](auto i, auto j) { return i - j; });
      check_ints(d, in, [](auto i, auto j) { return i * j; });
    }
    float got[width], expected[width];
    store(got, from_int<Wide>(load<Wide>(in.i)));
    for (int k = 0; k < width; ++k) expected[k] = from_int<float>(in.i[k]);
    d.expect(got, expected);
    std::int32_t whole[width], plain[width];
    float small[width];
    for (int k = 0; k < width; ++k) small[k] = static_cast<float>(in.i[k]) * 0.3f;
    store(whole, to_int(load<Wide>(small)));
    for (int k = 0; k < width; ++k) plain[k] = to_int(small[k]);
    d.expect(whole, plain);
    store(whole, as_int(float_bits(load<Wide>(in.a))));
    for (int k = 0; k < width; ++k) plain[k] = as_int(float_bits(in.a[k]));
    d.expect(whole, plain);
    store(got, float_from_bits(float_bits(load<Wide>(in.a))));
    d.expect(got, in.a);
    std::uint32_t words[width];
    store(words, load<Wide>(reinterpret_cast<const std::uint32_t*>(in.i)));
    for (int k = 0; k < width; ++k) whole[k] = as_int(words[k]);
    d.expect(whole, in.i);
  }
  return d.count;
}

[[maybe_unused]] int differences_in_masks(int rounds) {
  Differences d;
  for (int round = 0; round < rounds; ++round) {
    const Inputs in(round);
    check_masks(d, in, [](auto a, auto b, auto, auto) { return less(a, b); });
    check_masks(d, in, [](auto a, auto b, auto, auto) { return less_equal(a, b); });
    check_masks(d, in, [](auto a, auto b, auto, auto) { return equal(a, b); });
    check_masks(d, in, [](auto, auto, auto i, auto j) { return less(i, j); });
    check_masks(d, in, [](auto, auto, auto i, auto j) { return less_equal(i, j); });
    check_masks(d, in, [](auto, auto, auto i, auto j) { return equal(i, j); });
    check_masks(d, in, [](auto a, auto b, auto i, auto j) { return mask_and(less(a, b), less(i, j)); });
    check_masks(d, in, [](auto a, auto b, auto i, auto j) { return mask_or(less(a, b), less(i, j)); });
    check_masks(d, in, [](auto a, auto b, auto i, auto j) { return mask_and_not(less(a, b), less(i, j)); });
    check_masks(d, in, [](auto a, auto b, auto, auto) { return mask_not(less(a, b)); });
    const auto m = mask_from_bits<Wide>(bits_of(in.m));
    d.expect(bits(m), in.m);
    float got[width], expected[width];
    store(got, select(m, load<Wide>(in.a), load<Wide>(in.b)));
    for (int k = 0; k < width; ++k) expected[k] = in.m[k] ? in.a[k] : in.b[k];
    d.expect(got, expected);
    std::int32_t whole[width], plain[width];
    for (int k = 0; k < width; ++k) plain[k] = in.m[k] ? in.i[k] : in.j[k];
    store(whole, select(m, load<Wide>(in.i), load<Wide>(in.j)));
    d.expect(whole, plain);
    store(whole, as_int(select(m, as_uint(load<Wide>(in.i)), as_uint(load<Wide>(in.j)))));
    d.expect(whole, plain);
  }
  constexpr std::uint32_t full = width == 32 ? 0xffffffffu : (1u << width % 32) - 1u;
  for (std::uint32_t one = 1; one & full; one <<= 1) {
    d.count += any(mask_from_bits<Wide>(one)) ? 0 : 1;
    d.count += all(mask_from_bits<Wide>(full & ~one)) ? 1 : 0;
    d.count += bits(mask_from_bits<Wide>(one)) != one;
  }
  d.count += any(mask_from_bits<Wide>(0)) + !all(mask_from_bits<Wide>(full));
  return d.count;
}

/// The lanes of in.m, next to each other. What is before them stays as it was.
template <class T>
void check_append(Differences& d, const Inputs& in, const T* table) {
  constexpr int before = 3;
  T got[before + 2 * width] = {}, expected[before + width] = {};
  int count = before;
  for (int k = 0; k < width; ++k)
    if (in.m[k]) expected[count++] = table[k];
  const auto lanes = mask_from_bits<Wide>(bits_of(in.m));
  d.count += append(got + before, load<Wide>(table), lanes) != count - before;
  for (int k = 0; k < count; ++k) d.count += got[k] != expected[k];
}

/// Entries of tables of all lengths: what lies beyond is never read.
template <class T>
void check_lookup(Differences& d, const Inputs& in, const T* table, int count) {
  table += 256 - count;
  std::int32_t at[width];
  T got[width], expected[width];
  for (int k = 0; k < width; ++k) at[k] = (in.i[k] & 0xffff) % count, expected[k] = table[at[k]];
  store(got, lookup<Wide>(table, count, load<Wide>(at)));
  d.expect(got, expected);
}

[[maybe_unused]] int differences_in_memory(int rounds) {
  Differences d;
  float table[256];
  std::int32_t whole_table[256];
  for (int k = 0; k < 256; ++k) table[k] = static_cast<float>(k * k), whole_table[k] = 7 - k * k;
  for (int round = 0; round < rounds; ++round) {
    const Inputs in(round);
    std::int32_t at[width], whole[width], plain[width];
    float got[width], expected[width];
    for (int k = 0; k < width; ++k) at[k] = in.i[k] & 255, expected[k] = table[at[k]], plain[k] = whole_table[at[k]];
    store(got, gather<Wide>(table, load<Wide>(at)));
    d.expect(got, expected);
    store(whole, gather<Wide>(whole_table, load<Wide>(at)));
    d.expect(whole, plain);
    check_append(d, in, table), check_append(d, in, whole_table);
    for (const int count : {1, 7, 16, 31, 32, 33, 48, 64, 65, 256})
      check_lookup(d, in, table, count), check_lookup(d, in, whole_table, count);
    float minimum = expected[0];
    for (const float e : expected) minimum = e < minimum ? e : minimum;
    d.count += min_lane(load<Wide>(expected)) != minimum;
    store(got, splat<Wide>(in.a[0]));
    for (float& e : expected) e = in.a[0];
    d.expect(got, expected);
    store(whole, splat<Wide>(in.i[0]));
    for (std::int32_t& p : plain) p = in.i[0];
    d.expect(whole, plain);
  }
  return d.count;
}

/// Largest distances of the elementary functions from the plain ones, in units of what math.h promises.
[[maybe_unused]] float worst_function(int rounds) {
  float worst = 0;
  // The promise is relative to results of a size from `minimum` to `maximum`.
  const auto compare = [&](auto f, const float* x, float promise, float minimum, float maximum) {
    float got[width];
    store(got, f(load<Wide>(x)));
    for (int k = 0; k < width; ++k) {
      const float plain = f(x[k]);
      const float off = abs(got[k] - plain) / (promise * min(max(abs(plain), minimum), maximum));
      worst = off <= worst ? worst : off;  // what is not a number counts
    }
  };
  for (int round = 0; round < rounds; ++round) {
    float u[width], x[width];
    for (int k = 0; k < width; ++k) {
      u[k] = unit_interval_open<float>(hash(static_cast<std::uint32_t>(round * width + k)));
      x[k] = 20 * u[k] - 10;
    }
    compare([](auto t) { return sin_cos_2pi(t).sin; }, u, 2.5e-7f, 1, 1);
    compare([](auto t) { return sin_cos_2pi(t).cos; }, u, 2.5e-7f, 1, 1);
    compare([](auto t) { return log(t); }, u, 2e-7f, 1, 100);
    compare([](auto t) { return exp(t); }, x, 4e-7f, 0, 1e9f);
    compare([](auto t) { return cube_root(t); }, u, 2e-6f, 0, 1);
    compare([](auto t) { return atan2(t, decltype(t)(-0.3f)); }, x, 3e-7f, 1, 1);
    compare([](auto t) { return acos(t); }, u, 4e-7f, 1, 1);
  }
  return worst;
}

[[maybe_unused]] LanesReport lanes_report() {
  return {width,
          differences_in_arithmetic(2000),
          differences_in_whole_numbers(2000),
          differences_in_masks(2000),
          differences_in_memory(2000),
          worst_function(20000)};
}

}  // namespace
}  // namespace tyndall::test
