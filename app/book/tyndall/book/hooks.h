#pragma once
#include "values.h"

/// The calls that `tyndall main.cc` inserts into the reader's functions.
namespace tyndall_book {

/// Whether this thread is asked by us, which the inserted calls look at: then his functions do what they always do.
static thread_local bool is_ours = false;
/// A world that does not answer by itself what a ray meets, and who does in its place. The record is the reader's.
static thread_local const void* replaced_world = nullptr;
static thread_local bool (*answer_of_world)(const void* ray, double low, double high, void* record) = nullptr;

/// Defined behind the reader's code.
template <class C>
void describe_camera(const C& camera, description& to);
[[noreturn]] void take_over();

/// What the camera's members tell of the picture.
template <class C>
void tell_size(const C& camera, picture_told& size) {
  members<C>::each(camera, [&](const char*, char role, const auto& member) {
    using M = std::decay_t<decltype(member)>;
    int* to = role == 'w' ? &size.width : role == 'h' ? &size.height : role == 's' ? &size.samples : nullptr;
    if constexpr (std::is_integral<M>::value && !std::is_same<M, bool>::value)
      if (to && *to == 0) *to = static_cast<int>(member);
  });
}

/// Inserted into get_ray(). call: calls it. Each place has a type of its own, so that what is kept is one for each.
template <class C, class F, class A, class B>
void ray_wanted(const C& camera, F call, A first, B second) {
  using ray = decltype(call(first, second));
  if (loop().alone) return;
  static const C* seen;
  static std::optional<F> kept;
  const one_thread only;
  seen = &camera, kept.emplace(call);
  keep_place(first, second);
  program_loop& its = loop();
  its.by_pixels = std::is_integral<A>::value;
  its.tell_size = [](picture_told& size) { tell_size(*seen, size); };
  its.describe_camera = [](description& to) { describe_camera(*seen, to); };
  its.parts = ray_traits<ray>::parts;
  its.ray = [](double a, double b) -> const void* {
    static std::optional<ray> made;
    return &made.emplace((*kept)(static_cast<A>(a), static_cast<B>(b)));
  };
}

/// The first whole number of all; 0: there is none.
template <class... A>
int first_whole(const A&... all) {
  std::optional<int> first;
  const auto look = [&](const auto& one) {
    using M = std::decay_t<decltype(one)>;
    if constexpr (std::is_integral<M>::value && !std::is_same<M, bool>::value)
      if (!first) first = static_cast<int>(one);
  };
  (look(all), ...);
  return first.value_or(0);
}

/// Inserted into the function that computes the colour of a ray, in place of what it does. ask: calls it; has_camera:
/// there is a get_ray().
template <class Shape, bool has_camera, class F, class R, class W>
auto colour_wanted(F ask, R& ray, W& world, int depth) -> decltype(ask(ray)) {
  using ray_class = std::remove_const_t<R>;
  const auto known = [] { return make_vector<decltype(ask(ray))>({known_light[0], known_light[1], known_light[2]}); };
  program_loop& its = loop();
  if (its.alone) return known();
  const one_thread only;
  is_ours = true;
  if (has_camera && !its.ray) {  // no camera yet: a test of the reader's
    auto made = ask(ray);
    is_ours = false;
    return made;
  }
  static F* query;
  query = &ask;
  if constexpr (leads_to<Shape, W>()) its.world = static_cast<const Shape*>(pointer(world));
  its.depth = depth;
  its.colour = [](const void* one) { return to_vector((*query)(*static_cast<const ray_class*>(one))); };
  its.parts = ray_traits<ray_class>::parts, its.made = ray_traits<ray_class>::kept;
  is_ours = knows_loop(&ray);
  if (!is_ours) return {};
  is_ours = !goes_on_alone();
  if (!is_ours) return known();
  take_over();
}

}  // namespace tyndall_book
