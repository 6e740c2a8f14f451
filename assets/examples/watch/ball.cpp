// A path tracer of one grey ball on a plain under a sky, in Tyndall's window: ball [OUTPUT.png].
#include <tyndall/watch.h>

#include <cmath>
#include <cstdint>

struct Vec {
  double x, y, z;
};
Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator*(double s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec unit(Vec a) { return (1 / std::sqrt(dot(a, a))) * a; }

// Random numbers in [0, 1): SplitMix64 (G. Steele, D. Lea, C. Flood, Fast Splittable Pseudorandom Number Generators).
struct Random {
  std::uint64_t state;
  double next() {
    std::uint64_t z = state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
};

Vec on_sphere(Random& random) {
  const double z = 2 * random.next() - 1, r = std::sqrt(1 - z * z), phi = 6.283185307179586 * random.next();
  return {r * std::cos(phi), r * std::sin(phi), z};
}

// The distance to a sphere along a ray, or -1.
double hit(Vec centre, double radius, Vec origin, Vec direction) {
  const Vec to = centre + -1 * origin;
  const double along = dot(to, direction), root = along * along - dot(to, to) + radius * radius;
  if (root < 0) return -1;
  const double near = along - std::sqrt(root), far = along + std::sqrt(root);
  return near > 1e-4 ? near : far > 1e-4 ? far : -1;
}

// The light that comes along a ray.
Vec light(Vec origin, Vec direction, Random& random, int depth) {
  const double ball = hit({0, 0, -3}, 1, origin, direction), ground = hit({0, -1001, -3}, 1000, origin, direction);
  if (ball < 0 && ground < 0) return {0.5 + 0.3 * direction.y, 0.7 + 0.2 * direction.y, 1};
  if (depth == 0) return {0, 0, 0};
  const bool is_ball = ball > 0 && (ground < 0 || ball < ground);
  const Vec point = origin + (is_ball ? ball : ground) * direction;
  const Vec normal = unit(point + -1 * (is_ball ? Vec{0, 0, -3} : Vec{0, -1001, -3}));
  const Vec next = unit(normal + on_sphere(random));
  return 0.6 * light(point, next, random, depth - 1);
}

int main(int count, char** arguments) {
  constexpr int width = 320, height = 180;
  tyndall::WatchOptions options;
  options.title = "ball";
  options.threads = 2;  // nothing below is shared between two calls
  if (count > 1) options.output = arguments[1];
  return tyndall::watch(
      width, height,
      [&](double x, double y, std::uint64_t sample) {
        Random random{(sample * height + std::uint64_t(y)) * width + std::uint64_t(x)};
        const Vec direction = unit({(2 * x - width) / height, 1 - 2 * y / height, -2});
        return light({0, 0, 0}, direction, random, 10);
      },
      options);
}
