#pragma once
#include <cstdlib>
#include <limits>
#include <random>

/// Constants and random numbers. Scenes whose balls lie at random places look the same as in the reader's own program
/// if the same generator is asked in the same order:
/// - TYNDALL_BOOK_ENGINE names the engine if it is not std::rand (std::mt19937, std::mt19937_64), TYNDALL_BOOK_SEED its
///   seed; TYNDALL_BOOK_DRAND48 takes drand48 instead. `tyndall main.cc` looks them up in the reader's own headers.
/// - the compiler chooses the order in which arguments are computed: see vec3::random().
///
/// Functions that readers also write themselves are templates without need: then a plain function of the reader's is
/// preferred, where it would be defined twice otherwise.
#define TYNDALL_BOOK_HELPER \
  template <class = void>   \
  inline

/// Member functions that the reader's own classes have and ours have not: `tyndall main.cc` takes them over by name.
#ifndef TYNDALL_BOOK_VEC3_MEMBERS
#define TYNDALL_BOOK_VEC3_MEMBERS
#endif
#ifndef TYNDALL_BOOK_HIT_MEMBERS  // further pointers to materials, and statements that set them to `&seen`
#define TYNDALL_BOOK_HIT_MEMBERS
#define TYNDALL_BOOK_HIT_MATERIALS
#endif
#ifndef TYNDALL_BOOK_HITTABLE_LIST_MEMBERS
#define TYNDALL_BOOK_HITTABLE_LIST_MEMBERS
#endif
/// Values that the reader's own camera gives its members: `vfov = 20;`.
#ifndef TYNDALL_BOOK_CAMERA_DEFAULTS
#define TYNDALL_BOOK_CAMERA_DEFAULTS
#endif
/// Members of the reader's own camera that decide how its picture is computed or written, and nothing of what it shows.
#ifndef TYNDALL_BOOK_CAMERA_MEMBERS
#define TYNDALL_BOOK_CAMERA_MEMBERS
#endif

#ifndef TYNDALL_BOOK_NO_INFINITY
const double infinity = std::numeric_limits<double>::infinity();
#endif
#ifndef TYNDALL_BOOK_NO_PI
const double pi = 3.14159265358979323846;
#endif

namespace tyndall_book {

constexpr double endless = std::numeric_limits<double>::infinity();
constexpr double half_turn = 3.14159265358979323846;
constexpr double radians_of_degree = half_turn / 180;

/// The next random number in [0, 1).
inline double next_random() {
#if defined(TYNDALL_BOOK_DRAND48)
  return drand48();
#elif defined(TYNDALL_BOOK_ENGINE)
#ifdef TYNDALL_BOOK_SEED
  static TYNDALL_BOOK_ENGINE engine(TYNDALL_BOOK_SEED);
#else
  static TYNDALL_BOOK_ENGINE engine;
#endif
  static std::uniform_real_distribution<double> distribution(0.0, 1.0);
  return distribution(engine);
#else
  return std::rand() / (RAND_MAX + 1.0);
#endif
}

inline void skip_random(int count) {
  for (int k = 0; k < count; ++k) next_random();
}

}  // namespace tyndall_book

TYNDALL_BOOK_HELPER double degrees_to_radians(double degrees) { return degrees * tyndall_book::radians_of_degree; }
TYNDALL_BOOK_HELPER double random_double() { return tyndall_book::next_random(); }
TYNDALL_BOOK_HELPER double random_double(double low, double high) {
  return low + (high - low) * tyndall_book::next_random();
}
TYNDALL_BOOK_HELPER int random_int(int low, int high) {
  return static_cast<int>(low + (high + 1.0 - low) * tyndall_book::next_random());
}
TYNDALL_BOOK_HELPER float random_float() { return static_cast<float>(tyndall_book::next_random()); }
TYNDALL_BOOK_HELPER float random_float(float low, float high) { return low + (high - low) * random_float(); }
TYNDALL_BOOK_HELPER double randomDouble() { return tyndall_book::next_random(); }
TYNDALL_BOOK_HELPER double randomDouble(double low, double high) { return random_double(low, high); }
TYNDALL_BOOK_HELPER float randomFloat() { return random_float(); }
TYNDALL_BOOK_HELPER float randomFloat(float low, float high) { return random_float(low, high); }
TYNDALL_BOOK_HELPER double clamp(double x, double low, double high) { return x < low ? low : x > high ? high : x; }
TYNDALL_BOOK_HELPER double ffmin(double a, double b) { return a <= b ? a : b; }
TYNDALL_BOOK_HELPER double ffmax(double a, double b) { return a >= b ? a : b; }
