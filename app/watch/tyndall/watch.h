/* Tyndall's window over samples that a function of yours computes: the picture while it becomes sharper, zoom, the
 * values of a pixel, exposure, the estimated error, comparison with a reference, snapshots as PNG and EXR. Or, without
 * a window, a picture file.
 *
 * C++17:  tyndall::watch(width, height, [&](double x, double y, std::uint64_t sample) { return colour; });
 * C99:    tyndall_watch(width, height, function, user, NULL);
 * Link with -ltyndall-watch (pkg-config tyndall-watch), or in CMake find_package(tyndall) and tyndall::watch. */
#ifndef TYNDALL_WATCH_H
#define TYNDALL_WATCH_H

#include <stddef.h>
#include <stdint.h>

#ifdef __GNUC__
#define TYNDALL_WATCH_API __attribute__((visibility("default")))
#else
#define TYNDALL_WATCH_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Computes one sample of the picture. x, y: a point, in pixels from the upper left corner, y down; the points of a
 * pixel are spread over it. sample: which of the pixel's samples it is, from 0 on: may serve as a seed of your own
 * random numbers. rgb: is to be set to linear radiance, without any gamma curve. A function that leaves rgb as it is,
 * or sets it to values that are not finite, has failed: the sample is left out and told with its pixel. May be called
 * from any thread, but by no more at once than options say. */
typedef void (*tyndall_watch_function)(void* user, double x, double y, uint64_t sample, double rgb[3]);

typedef struct tyndall_watch_options {
  size_t size;           /* sizeof(tyndall_watch_options) */
  int threads;           /* that call the function at the same time; 0: 1 */
  uint32_t spp;          /* samples a pixel; 0: 64 in a file, 4,096 in the window */
  uint32_t seed;         /* another one gives other points */
  const char* title;     /* of the window; NULL: "watch" */
  const char* output;    /* write this file instead of opening a window: .png, .exr, .pfm, .hdr, .ppm; NULL: window */
  const char* reference; /* what the picture should look like: a picture of the same size, or a scene; NULL: none */
} tyndall_watch_options;

/* tyndall_watch_options options = TYNDALL_WATCH_OPTIONS; */
#define TYNDALL_WATCH_OPTIONS \
  { sizeof(tyndall_watch_options), 0, 0, 0, NULL, NULL, NULL }

/* Shows the picture until the window is closed, or writes the file. user: is handed to the function. options: may be
 * NULL. Returns 0: all is well; 1: the same, but some samples have failed; 2: an argument or an option is wrong; 3: no
 * display, or the file cannot be written. What is wrong goes to standard error, a line each. One call at a time. */
TYNDALL_WATCH_API int tyndall_watch(int width, int height, tyndall_watch_function function, void* user,
                                    const tyndall_watch_options* options);

/* For use within the function: the present sample has no value, for this reason, which the user is told. */
TYNDALL_WATCH_API void tyndall_watch_fail(const char* reason);

#ifdef __cplusplus
} /* extern "C" */

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <string>
#include <type_traits>

namespace tyndall {

/// Options of watch(); see tyndall_watch_options.
struct WatchOptions {
  int threads = 1;
  std::uint32_t spp = 0;
  std::uint32_t seed = 0;
  std::string title{};
  std::string output{};
  std::string reference{};
};

namespace watch_details {

template <class R, class G, class B>
auto numbers(R r, G g, B b)
    -> decltype(std::array<double, 3>{static_cast<double>(r), static_cast<double>(g), static_cast<double>(b)}) {
  return {static_cast<double>(r), static_cast<double>(g), static_cast<double>(b)};
}

template <class C>
constexpr bool always_false = false;

/// Takes a colour apart by the first of these functions that compiles for its type.
template <class C, class Parts, class... Others>
std::array<double, 3> apart(C& colour, Parts parts, Others... others) {
  if constexpr (std::is_invocable_v<Parts, C&>)
    return parts(colour);
  else if constexpr (sizeof...(others) > 0)
    return apart(colour, others...);
  else
    static_assert(
        always_false<C>,
        "tyndall::watch: the function has to return a colour, with members x, y, z or r, g, b or e[0] to e[2], "
        "with functions x(), y(), z(), or with [0] to [2]");
}

/// Takes a colour apart, whatever its type calls the parts.
template <class C>
std::array<double, 3> take_apart(C colour) {
  return apart(
      colour,  //
      [](auto& c) -> decltype(numbers(c.x, c.y, c.z)) { return numbers(c.x, c.y, c.z); },
      [](auto& c) -> decltype(numbers(c.x(), c.y(), c.z())) { return numbers(c.x(), c.y(), c.z()); },
      [](auto& c) -> decltype(numbers(c.r, c.g, c.b)) { return numbers(c.r, c.g, c.b); },
      [](auto& c) -> decltype(numbers(c[0], c[1], c[2])) { return numbers(c[0], c[1], c[2]); },
      [](auto& c) -> decltype(numbers(c.e[0], c.e[1], c.e[2])) { return numbers(c.e[0], c.e[1], c.e[2]); },
      [](auto& c) -> decltype(numbers(c, c, c)) { return numbers(c, c, c); });
}

}  // namespace watch_details

/// Shows the picture whose samples `function` computes until the window is closed, or writes it to options.output.
/// function(double x, double y, std::uint64_t sample) returns a colour: see tyndall_watch_function. An exception that
/// it throws means that the sample has failed. Returns what tyndall_watch() does.
template <class Function>
int watch(int width, int height, Function&& function, const WatchOptions& options = WatchOptions()) {
  auto sample_of = [&function](double x, double y, std::uint64_t sample) {
    return watch_details::take_apart(function(x, y, sample));
  };
  const auto call = [](void* user, double x, double y, std::uint64_t sample, double* rgb) {
    try {
      const std::array<double, 3> colour = (*static_cast<decltype(sample_of)*>(user))(x, y, sample);
      std::copy(colour.begin(), colour.end(), rgb);
    } catch (const std::exception& error) {
      tyndall_watch_fail(error.what());
    } catch (...) {
      tyndall_watch_fail("an exception that is no std::exception");
    }
  };
  const tyndall_watch_options plain{
      sizeof(tyndall_watch_options), options.threads,          options.spp, options.seed, options.title.c_str(),
      options.output.c_str(),        options.reference.c_str()};
  return tyndall_watch(width, height, call, &sample_of, &plain);
}

}  // namespace tyndall
#endif /* __cplusplus */

#endif
