#include "app/book/shape_candidates.h"

#include <fmt/core.h>

namespace tyndall {

std::vector<Motion> motions_of(const Described& o) {
  std::vector<Motion> motions;
  const std::vector<Vector> points = o.vectors();
  const std::vector<double> rays = o.all('r');
  for (std::size_t k = 0; k + 5 < rays.size(); k += 6) {
    const Vector from{rays[k], rays[k + 1], rays[k + 2]};
    motions.push_back({from, from + Vector{rays[k + 3], rays[k + 4], rays[k + 5]}});
  }
  const double *begin = o.named("time0"), *end = o.named("time1");
  const double start = begin ? *begin : 0, span = end ? *end - start : 1, rate = span > 0 ? 1 / span : 0;
  for (std::size_t a = 0; a < points.size(); ++a)
    for (std::size_t b = a + 1; b < points.size(); ++b)
      for (const Vector& motion : {points[b] - points[a], points[b]})
        motions.push_back({points[a] + (-start * rate) * motion, points[a] + ((1 - start) * rate) * motion});
  for (const Vector& one : points) motions.push_back({one, one});
  return motions;
}
Candidate sphere_of(const Motion& centre, double radius) {
  const double size = std::fabs(radius);
  const bool moves = length(centre.end - centre.begin) > 0;
  return {fmt::format("{{\"type\":\"sphere\",\"center\":{}{},\"radius\":{}", triple(centre.begin),
                      moves ? ",\"center_end\":" + triple(centre.end) : "", radius),
          {centre.at(0.5), size, true},
          [=](RandomNumbers& random, double time) {
            const Vector from = centre.at(time) + (size * random.between(0, 3)) * random.on_sphere();
            return Shot{from, centre.at(time) + (size * random.between(0, 1.4)) * random.on_sphere() - from, time};
          },
          [=](const Shot& shot) -> std::optional<std::vector<Crossing>> {
            const Vector from = shot.from - centre.at(shot.time);
            const double a = dot(shot.to, shot.to), b = dot(from, shot.to),
                         d = b * b - a * (dot(from, from) - size * size);
            if (a < 1e-6 * size * size || std::fabs(d) < 0.02 * a * size * size) return {};
            std::vector<Crossing> all;
            for (const double root : {-std::sqrt(std::fmax(d, 0)), std::sqrt(std::fmax(d, 0))})
              if (d > 0) all.push_back({(root - b) / a, (1 / radius) * (from + ((root - b) / a) * shot.to)});
            return all;
          }};
}

std::vector<Plane> planes_of(const Described& o) {
  const auto value = [&](const char* name) { return o.named(name) ? *o.named(name) : 0; };
  const double x = value("x0"), y = value("y0"), z = value("z0"), k = value("k");
  const Vector x_side{value("x1") - x, 0, 0}, y_side{0, value("y1") - y, 0}, z_side{0, 0, value("z1") - z};
  std::vector<Plane> planes{{{x, y, k}, x_side, y_side}, {{x, k, z}, x_side, z_side}, {{k, y, z}, y_side, z_side}};
  const std::vector<Vector> points = o.vectors();
  for (std::size_t a = 0; a < points.size(); ++a)
    for (std::size_t b = a + 1; b < points.size(); ++b)
      for (std::size_t c = b + 1; c < points.size(); ++c)
        for (const Vector& from : {Vector{}, points[a]})
          planes.push_back({points[a], points[b] - from, points[c] - from});
  return planes;
}
std::string Flat::text() const {
  const std::string radius = is_disk() ? fmt::format(",\"inner\":{}", inner / outer) : "";
  return fmt::format("{{\"type\":\"{}\",\"{}\":{},\"u\":{},\"v\":{}{}", type, is_disk() ? "center" : "corner",
                     triple(plane.corner), triple(outer * plane.u), triple(outer * plane.v), radius);
}
double Flat::depth(double a, double b) const {
  const double radius = std::sqrt(a * a + b * b);
  if (is_disk()) return std::fmin(inner > 0 ? radius - inner : 1, outer - radius);
  return std::fmin(std::fmin(a, b), type == "quad" ? std::fmin(1 - a, 1 - b) : 1 - a - b);
}
Candidate flat_of(const Flat& flat, double precision) {
  const Plane plane = flat.plane;
  const double low = flat.is_disk() ? -1.6 * flat.outer : -0.6, high = 1.6 * flat.outer;
  const Vector across = plane.normal();
  return {flat.text(),
          {flat.middle(),
           flat.outer * std::fmin(length(plane.u), length(plane.v)),
           false,
           flat.type == "quad" && is_near(dot(plane.u, plane.v), 0, 1e-9),
           {plane.at(0, 0), plane.at(1, 1)}},
          [=](RandomNumbers& random, double) {
            const Vector target = plane.at(random.between(low, high), random.between(low, high));
            const double distance = random.between(0.5, 3) * (length(plane.u) + length(plane.v));
            const Vector from = target + distance * random.on_sphere();
            return Shot{from, target - from};
          },
          [=](const Shot& shot) -> std::optional<std::vector<Crossing>> {
            const Vector at = shot.from + shot.to - plane.corner;
            const double depth = flat.depth(dot(cross(at, plane.v), across) / dot(across, across),
                                            dot(cross(plane.u, at), across) / dot(across, across));
            const double cosine = dot(normalized(shot.to), normalized(across));
            if (std::fabs(depth) < 1e-3 + 5 * precision || std::fabs(cosine) < 0.1) return {};
            return depth > 0 ? std::vector<Crossing>{{1, normalized(across)}} : std::vector<Crossing>{};
          }};
}

bool set_interval(Shot& shot, const std::vector<Crossing>& met, int k) {
  if (met.empty()) return true;
  const double first = met.front().t, last = met.back().t;
  if (std::fabs(first) < 0.01 || std::fabs(last) < 0.01) return false;
  if (k % 3 == 1 && first > 0) shot.low = first + 0.1 * (met.size() > 1 ? last - first : first);
  if (k % 3 == 2 && last > 0 && met.size() > 1) shot.high = 0.5 * (std::fmax(first, 0) + last);
  if ((k % 6 == 5 || (k % 3 == 2 && met.size() == 1)) && first > 0) shot.high = 0.9 * first;
  return shot.high > shot.low;
}

}  // namespace tyndall
