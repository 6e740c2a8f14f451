#include "app/book/inside/shape_candidates.h"

#include <fmt/core.h>

namespace tyndall {

Vec3d Candidate::middle() const {
  if (is_sphere()) return place(0.5, 0);
  return is_disk() ? place(0.5 * (inner + radius), 0) : place(0.3, 0.3);
}
double Candidate::size() const { return is_sphere() ? std::fabs(radius) : radius * std::fmin(length(u), length(v)); }

std::string Candidate::text() const {
  if (is_sphere())
    return fmt::format("{{\"type\":\"sphere\",\"center\":{}{},\"radius\":{}", triple(at),
                       length(u) > 0 ? ",\"center_end\":" + triple(place(1, 0)) : "", radius);
  return fmt::format("{{\"type\":\"{}\",\"{}\":{},\"u\":{},\"v\":{}{}", type, is_disk() ? "center" : "corner",
                     triple(at), triple(radius * u), triple(radius * v),
                     is_disk() ? fmt::format(",\"inner\":{}", inner / radius) : "");
}

book::shot Candidate::shot_at(double a, double b) const {
  const Vec3d away = (length(u) + length(v)) * normalize(normal());
  return {{place(a, b) + away, -1.0 * away}};
}
book::shot Candidate::aim(RandomNumbers& random, double time) const {
  if (is_sphere()) {
    const Vec3d from = place(time, 0) + (size() * random.between(0, 3)) * random.on_sphere();
    return {{from, place(time, 0) + (size() * random.between(0, 1.4)) * random.on_sphere() - from, time}};
  }
  const double low = is_disk() ? -1.6 * radius : -0.6, high = 1.6 * radius;
  const Vec3d target = place(random.between(low, high), random.between(low, high));
  const double distance = random.between(0.5, 3) * (length(u) + length(v));
  const Vec3d from = target + distance * random.on_sphere();
  return {{from, target - from}};
}

std::optional<std::vector<Crossing>> Candidate::crossings(const book::shot& shot, double precision) const {
  if (is_sphere()) {
    const Vec3d from = shot.from - place(shot.time, 0);
    const double a = dot(shot.to, shot.to), b = dot(from, shot.to), square = radius * radius,
                 d = b * b - a * (dot(from, from) - square);
    if (a < 1e-6 * square || std::fabs(d) < 0.02 * a * square) return {};
    std::vector<Crossing> all;
    for (const double root : {-std::sqrt(std::fmax(d, 0)), std::sqrt(std::fmax(d, 0))})
      if (d > 0) all.push_back({(root - b) / a, (1 / radius) * (from + ((root - b) / a) * shot.to)});
    return all;
  }
  // Shots at a flat one are aimed at its plane, which they meet at t = 1.
  const Vec3d across = normal(), met = shot.from + shot.to - at;
  const double a = dot(cross(met, v), across) / dot(across, across),
               b = dot(cross(u, met), across) / dot(across, across);
  double depth = std::fmin(std::fmin(a, b), type == "quad" ? std::fmin(1 - a, 1 - b) : 1 - a - b);
  if (is_disk()) depth = std::fmin(inner > 0 ? std::hypot(a, b) - inner : 1, radius - std::hypot(a, b));
  const double cosine = dot(normalize(shot.to), normalize(across));
  if (std::fabs(depth) < 1e-3 + 5 * precision || std::fabs(cosine) < 0.1) return {};
  return depth > 0 ? std::vector<Crossing>{{1, normalize(across)}} : std::vector<Crossing>{};
}

std::vector<Candidate> spheres_of(const Described& o) {
  std::vector<Candidate> middles, all;
  const std::vector<Vec3d> points = o.vectors();
  const std::vector<double> rays = o.all('r');
  const auto add = [&](Vec3d at, Vec3d motion) { middles.push_back({"sphere", at, motion, {}}); };
  for (std::size_t k = 0; k + 5 < rays.size(); k += 6)
    add({rays[k], rays[k + 1], rays[k + 2]}, {rays[k + 3], rays[k + 4], rays[k + 5]});
  const double start = o.named("time0", 0), span = o.named("time1", start + 1) - start, rate = span > 0 ? 1 / span : 0;
  for (std::size_t a = 0; a < points.size(); ++a)
    for (std::size_t b = a + 1; b < points.size(); ++b)
      for (const Vec3d& motion : {points[b] - points[a], points[b]})
        add(points[a] + (-start * rate) * motion, rate * motion);
  for (const Vec3d& one : points) add(one, {});
  for (const double radius : o.numbers())
    for (Candidate& one : middles) one.radius = radius, all.push_back(one);
  return all;
}

std::vector<Candidate> planes_of(const Described& o) {
  const double x = o.named("x0", 0), y = o.named("y0", 0), z = o.named("z0", 0), k = o.named("k", 0);
  const Vec3d x_side{o.named("x1", 0) - x, 0, 0}, y_side{0, o.named("y1", 0) - y, 0},
      z_side{0, 0, o.named("z1", 0) - z};
  std::vector<Candidate> planes;
  const auto add = [&](Vec3d corner, Vec3d u, Vec3d v) {
    if (length(cross(u, v)) > 0) planes.push_back({"quad", corner, u, v});
  };
  add({x, y, k}, x_side, y_side), add({x, k, z}, x_side, z_side), add({k, y, z}, y_side, z_side);
  const std::vector<Vec3d> points = o.vectors();
  for (std::size_t a = 0; a < points.size(); ++a)
    for (std::size_t b = a + 1; b < points.size(); ++b)
      for (std::size_t c = b + 1; c < points.size(); ++c)
        for (const Vec3d& from : {Vec3d{}, points[a]}) add(points[a], points[b] - from, points[c] - from);
  return planes;
}

}  // namespace tyndall
