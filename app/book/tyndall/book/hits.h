#pragma once
#include "materials.h"

/// What the reader's hit() answers to rays, and which of the books' shapes answers so.
namespace tyndall_book {

constexpr double endless = HUGE_VAL;

/// What the reader's hit() answers.
template <class N>
struct answer {
  bool found = false, front = true;
  double t = 0;
  vector normal;
  const typename N::material* material = nullptr;
};
template <class N>
answer<N> shoot(const typename N::shape& shape, vector from, vector to, double time = 0, double low = 0.001,
                double high = endless) {
  typename N::record record{};
  answer<N> a;
  a.found = N::hit(shape, ray_traits<typename N::ray>::make(from, to, time), low, high, record);
  if (!a.found) return a;
  a.t = double(record.t), a.normal = to_vector(record.normal);
  a.front = is_front(record, to, a.normal);
  a.material = material_in<N>(record);
  return a;
}

/// The middle of a sphere that moves evenly.
struct motion {
  vector begin, end;  ///< at the times 0 and 1
  vector at(double time) const { return begin + time * (end - begin); }
};
/// Whether 200 rays from all sides, and from within, meet the sphere where they should, at both ends of an interval.
template <class N>
bool is_sphere(const typename N::shape& o, const motion& centre, double radius, random_numbers& random,
               const typename N::material*& material) {
  const double size = std::fabs(radius);
  bool outward = true, against = true;
  for (int k = 0; k < 200; ++k) {
    const double time = k % 4 == 0 ? 1 : k % 4 == 1 ? 0 : random.next();
    const vector middle = centre.at(time);
    const vector from = middle + (size * random.between(0, 3)) * random.on_sphere();
    const vector to = middle + (size * random.between(0, 1.4)) * random.on_sphere() - from;
    const double a = dot(to, to), b = dot(from - middle, to), c = dot(from - middle, from - middle) - size * size;
    const double d = b * b - a * c, scale = std::fmax(size, largest(middle)) / std::sqrt(a);
    if (a < 1e-6 * size * size || std::fabs(d) < 0.02 * a * size * size) continue;
    double roots[2] = {(-b - std::sqrt(std::fmax(d, 0))) / a, (-b + std::sqrt(std::fmax(d, 0))) / a};
    if (std::fabs(roots[0]) < 0.01 || std::fabs(roots[1]) < 0.01) continue;
    const double low = k % 3 == 1 && d > 0 && roots[0] > 0 ? roots[0] + 0.1 * (roots[1] - roots[0]) : 0.001;
    double high = k % 3 == 2 && d > 0 && roots[1] > 0 ? 0.5 * (std::fmax(roots[0], 0) + roots[1]) : endless;
    if (k % 6 == 5 && roots[0] > 0) high = 0.9 * roots[0];
    if (high <= low) continue;
    double expected = endless;
    for (double root : {roots[1], roots[0]})
      if (d > 0 && root > low && root < high) expected = root;
    const answer<N> its = shoot<N>(o, from, to, time, low, high);
    if (its.found != (expected < endless)) return false;
    if (!its.found) continue;
    if (std::fabs(its.t - expected) > ray_traits<typename N::ray>::precision() * 10 * std::fmax(scale, expected))
      return false;
    const vector normal = (1 / radius) * (from + expected * to - middle);
    const double along = dot(its.normal, normal), facing = dot(to, normal);
    if (std::fabs(std::fabs(along) - 1) > 0.02) return false;
    outward = outward && along > 0;
    against = against && along * facing < 0 && its.front == (facing < 0);
    if (material && material != its.material) return false;
    material = its.material;
  }
  return outward || against;
}

/// What hit() leaves of the plane q + a u + b v.
struct outline {
  const char* type = nullptr;  ///< "quad", "triangle" or "disk"; null: none of them
  double inner = 0, outer = 1;
};
template <class F>
double edge_of(const F& holds, double low, double high) {
  const bool beyond = holds(high);
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (holds(middle) == beyond ? high : low) = middle;
  }
  return std::round(1e6 * high) / 1e6;
}
template <class F>
outline outline_of(const F& holds) {
  const auto is = [&](const auto& expected) {
    constexpr int cells = 23;
    for (int i = 0; i < cells; ++i)
      for (int k = 0; k < cells; ++k) {
        const double a = 3.3 * (i + 0.5) / cells - 1.61, b = 3.3 * (k + 0.5) / cells - 1.61;
        if (holds(a, b) != expected(a, b)) return false;
      }
    return true;
  };
  if (is([](double a, double b) { return 0 < a && a < 1 && 0 < b && b < 1; })) return {"quad", 0, 1};
  if (is([](double a, double b) { return 0 < a && 0 < b && a + b < 1; })) return {"triangle", 0, 1};
  outline disk{"disk", 0, 0};
  const auto at = [&](double radius) { return holds(radius, 0.0); };
  double within = 0;
  while (within < 1.5 && !at(within)) within += 0.01;
  if (within >= 1.5 || at(100)) return {};
  if (within > 0) disk.inner = edge_of(at, within - 0.01, within);
  disk.outer = edge_of(at, within, 100);
  const auto on_ring = [&](double a, double b) {
    const double radius = std::sqrt(a * a + b * b);
    return disk.inner < radius && radius < disk.outer;
  };
  return is(on_ring) ? disk : outline{};
}
struct line {
  vector from, to;
};

/// The books' translate and rotate_y.
struct move {
  vector by{};
  double sine = 0, cosine = 1;
  vector rotated(vector a, double s) const { return {cosine * a.x - s * a.z, a.y, s * a.x + cosine * a.z}; }
  vector out(vector a) const { return rotated(a, -sine) + by; }
  line in(const line& a) const { return {rotated(a.from - by, sine), rotated(a.to, sine)}; }
  std::string text() const {
    if (sine != 0 || cosine != 1)
      return "{\"rotate_y\":" + number(std::atan2(sine, cosine) * 180 / 3.14159265358979323846) + "}";
    return length(by) > 0 ? "{\"translate\":" + triple(by) + "}" : "";
  }
};

}  // namespace tyndall_book
