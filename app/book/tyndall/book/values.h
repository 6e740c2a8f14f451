#pragma once
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <optional>
#include <type_traits>
#include <typeinfo>
#include <utility>

namespace tyndall_book {
struct vector {
  double x = 0, y = 0, z = 0;
};
inline vector operator+(vector a, vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline vector operator-(vector a, vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline vector operator*(double s, vector a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(vector a, vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double length(vector a) { return std::sqrt(dot(a, a)); }
}  // namespace tyndall_book
#include "functions.h"

/// Reading of objects whose classes are the reader's: this file is compiled before his code, as C++17.
namespace tyndall_book {

template <class T, class F>
constexpr bool can(F) {
  return std::is_invocable<F, T&>::value;
}
/// Whether an expression of `o`, an object of class T, can be compiled.
#define TYNDALL_HAS(T, ...) (::tyndall_book::can<T>([](auto& o) -> decltype((void)(__VA_ARGS__)) {}))
/// What reads such an expression, for pick().
#define TYNDALL_GET(...) [](auto& o) -> decltype((__VA_ARGS__)) { return __VA_ARGS__; }

struct absent {};
/// In the place of classes that the reader's program does not have.
template <char role>
struct absent_class {
  virtual ~absent_class() = default;
};

/// What the first of the readers that can be compiled reads; absent: none can.
template <class T, class F, class... G>
decltype(auto) pick(T& object, F first, G... rest) {
  if constexpr (std::is_invocable<F, T&>::value)
    return first(object);
  else if constexpr (sizeof...(rest) > 0)
    return pick(object, rest...);
  else
    return absent{};
}
template <class T>
constexpr bool is_absent = std::is_same<std::decay_t<T>, absent>::value;

/// The parts of a vector or colour of the reader's; absent: it is none.
template <class T>
auto parts_of(const T& a) {
  return pick(a, TYNDALL_GET(vector{double(o.x()), double(o.y()), double(o.z())}),
              TYNDALL_GET(vector{double(o.x), double(o.y), double(o.z)}),
              TYNDALL_GET(vector{double(o[0]), double(o[1]), double(o[2])}),
              TYNDALL_GET(vector{double(o.e[0]), double(o.e[1]), double(o.e[2])}),
              TYNDALL_GET(vector{double(o.r()), double(o.g()), double(o.b())}),
              TYNDALL_GET(vector{double(o.r), double(o.g), double(o.b)}));
}
template <class T>
vector to_vector(const T& a) {
  return parts_of(a);
}
template <class T, class D = std::decay_t<T>>
constexpr bool is_vector = !std::is_pointer<D>::value && !TYNDALL_HAS(D, o.push_back(o[0])) &&
                           !TYNDALL_HAS(D, o.get()) && !is_absent<decltype(parts_of(std::declval<const D&>()))>;

/// What a pointer of any kind points to; an object is taken for itself.
template <class P>
auto* pointer(P& p) {
  if constexpr (TYNDALL_HAS(P, *o.get()))
    return p.get();
  else if constexpr (std::is_pointer<std::decay_t<P>>::value)
    return p;
  else
    return &p;
}
/// Whether P is an object of class T, a class derived from it, or a pointer of any kind to one.
template <class T, class P>
constexpr bool leads_to() {
  return std::is_convertible<decltype(pointer(std::declval<std::remove_reference_t<P>&>())), const T*>::value;
}
/// A vector or colour of the reader's class T; black where it is not known how one is made.
template <class T>
T make_vector(vector a) {
  if constexpr (std::is_constructible<T, float, float, float>::value) {
    return T(a.x, a.y, a.z);
  } else {
    T made{};
    if constexpr (TYNDALL_HAS(T, o.x = 0))
      made.x = a.x, made.y = a.y, made.z = a.z;
    else if constexpr (TYNDALL_HAS(T, o.e[0] = 0))
      made.e[0] = a.x, made.e[1] = a.y, made.e[2] = a.z;
    else if constexpr (TYNDALL_HAS(T, o.r = 0))
      made.r = a.x, made.g = a.y, made.b = a.z;
    return made;
  }
}
/// The members of the reader's class T: each(o, f) calls f(key of its name, role, member) for all of them, those of its
/// bases first. Made behind his code for his classes; others have none. Roles are told by names. Of what is hit: n, the
/// normal; f, whether it is in front; u, v. Of cameras: w, h, s, the picture's width, height and samples. 0: none of
/// these.
template <class T>
struct members {
  template <class O, class F>
  static void each(O&, const F&) {}
};

/// An end of an interval of the reader's, the lower one or the other; none (NaN): it has no two numbers.
template <class T>
double end_of(const T& interval, bool upper) {
  double ends[2] = {NAN, NAN};
  int count = 0;
  members<T>::each(interval, [&](const char*, char, const auto& member) {
    if constexpr (std::is_floating_point<std::decay_t<decltype(member)>>::value)
      if (count < 2) ends[count++] = double(member);
  });
  return ends[upper];
}

/// The rays of a class, by any edition's names.
template <class R>
struct ray_traits {
  template <class T>
  static decltype(auto) direction_of(T& ray) {
    return pick(ray, TYNDALL_GET(o.direction()), TYNDALL_GET(o.dir()), TYNDALL_GET(o.dir), TYNDALL_GET(o.direction),
                TYNDALL_GET(o.B), TYNDALL_GET(o.getDirection()), TYNDALL_GET(o.Direction()), TYNDALL_GET(o.d),
                TYNDALL_GET(o.m_direction));
  }
  template <class T>
  static decltype(auto) origin_of(T& ray) {
    return pick(ray, TYNDALL_GET(o.origin()), TYNDALL_GET(o.orig()), TYNDALL_GET(o.orig), TYNDALL_GET(o.origin),
                TYNDALL_GET(o.A), TYNDALL_GET(o.getOrigin()), TYNDALL_GET(o.Origin()), TYNDALL_GET(o.o),
                TYNDALL_GET(o.m_origin));
  }
  using part = std::decay_t<decltype(direction_of(std::declval<const R&>()))>;
  static_assert(is_vector<part>, "a ray has a direction");

  static ray_parts parts(const void* ray) {
    const R& its = *static_cast<const R*>(ray);
    decltype(auto) time = pick(its, TYNDALL_GET(double(o.time())), TYNDALL_GET(double(o.tm)),
                               TYNDALL_GET(double(o._time)), TYNDALL_GET(double(o.time)));
    ray_parts made{to_vector(origin_of(its)), to_vector(direction_of(its))};
    if constexpr (!is_absent<decltype(time)>) made.time = time;
    return made;
  }
  static R make(const ray_parts& parts) {
    part a = make_vector<part>(parts.from), b = make_vector<part>(parts.to);
    if constexpr (std::is_constructible<R, part&, part&, double>::value)
      return R(a, b, parts.time);
    else if constexpr (std::is_constructible<R, part&, part&>::value)
      return R(a, b);
    else
      return R{a, b};
  }
  /// The same, which lives until the next call.
  static const void* kept(const ray_parts& parts) {
    static std::optional<R> made;
    return &made.emplace(make(parts));
  }
  static bool is_float() { return to_vector(make_vector<part>({1.0 / 3, 0, 0})).x != 1.0 / 3; }
};

}  // namespace tyndall_book
