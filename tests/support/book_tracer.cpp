#include "tests/support/book_tracer.h"

#include "core/base/math.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <variant>

namespace tyndall::test {
namespace {

using V = Vec3d;

struct SplitMix {
  using result_type = std::uint64_t;
  std::uint64_t state;
  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return ~result_type{0}; }
  result_type operator()() {
    std::uint64_t z = state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
};

/// rand() of the GNU library: a sum of the numbers 3 and 31 before it, whose last bit is left out.
struct StdRand {
  using result_type = std::uint32_t;
  std::uint32_t state[31] = {};
  std::size_t at = 0;
  explicit StdRand(std::uint64_t seed) {
    std::minstd_rand0 first(static_cast<std::uint32_t>(seed));
    for (std::size_t k = 0; k < 31; ++k) state[k] = static_cast<std::uint32_t>(first());
    for (int k = 0; k < 310; ++k) (*this)();
  }
  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return 0x7fffffff; }
  result_type operator()() {
    at = (at + 1) % 31;
    return (state[at] += state[(at + 28) % 31]) >> 1;
  }
};

struct Random {
  std::variant<SplitMix, std::mt19937_64, std::minstd_rand, StdRand> engine;
  Random(Generator generator, std::uint64_t seed) : engine(SplitMix{seed}) {
    const auto small_seed = static_cast<std::uint32_t>(SplitMix{seed}() >> 33);
    if (generator == Generator::mersenne_twister) engine = std::mt19937_64(seed);
    if (generator == Generator::minimal_standard) engine = std::minstd_rand(small_seed);
    if (generator == Generator::std_rand) engine = StdRand(small_seed);
  }
  double next() {
    return std::visit(
        [](auto& draw) {
          const auto range = static_cast<double>(draw.max() - draw.min()) + 1;
          return static_cast<double>(draw() - draw.min()) / range * (1 - 0x1p-53);
        },
        engine);
  }
  V in_ball() {
    while (true) {
      const V p{2 * next() - 1, 2 * next() - 1, 2 * next() - 1};
      if (dot(p, p) < 1 && dot(p, p) > 1e-12) return p;
    }
  }
  V unit() { return normalize(in_ball()); }
};

struct R {
  V origin, direction;
  double time;
};

struct Material0 {
  enum { matt, metal, glass, light, smoke } kind = matt;
  V colour, other;  ///< other: of the odd cubes of a checker
  double checker = 0, number = 0;
};

struct Meeting {
  double t = std::numeric_limits<double>::infinity();
  V normal;  ///< outward
  const Material0* material = nullptr;
};

struct Ball {
  V center, end;
  double radius;
};
struct Plate {
  V corner, u, v;
};

/// The nearest distance within (low, high) at which a ball or a plate is met.
bool meet(const Ball& b, const R& r, double low, double high, Meeting& m) {
  const V center = b.center + r.time * (b.end - b.center), oc = center - r.origin;
  const double a = dot(r.direction, r.direction), h = dot(r.direction, oc), c = dot(oc, oc) - b.radius * b.radius;
  const double root = h * h - a * c;
  if (root < 0) return false;
  for (const double t : {(h - std::sqrt(root)) / a, (h + std::sqrt(root)) / a}) {
    if (t <= low || t >= high) continue;
    m.t = t, m.normal = (1 / b.radius) * (r.origin + t * r.direction - center);
    return true;
  }
  return false;
}
bool meet(const Plate& p, const R& r, double low, double high, Meeting& m) {
  const V n = cross(p.u, p.v);
  const double along = dot(n, r.direction);
  if (std::abs(along) < 1e-12) return false;
  const double t = dot(n, p.corner - r.origin) / along;
  if (t <= low || t >= high) return false;
  const V at = r.origin + t * r.direction - p.corner, w = (1 / dot(n, n)) * n;
  const double alpha = dot(w, cross(at, p.v)), beta = dot(w, cross(p.u, at));
  if (alpha < 0 || alpha > 1 || beta < 0 || beta > 1) return false;
  m.t = t, m.normal = normalize(n);
  return true;
}

struct Part {
  std::vector<Ball> balls;
  std::vector<Plate> plates;
  Material0 material;
  double density = 0;  ///< of smoke
  bool meet_any(const R& r, double low, double high, Meeting& m) const {
    bool met = false;
    for (const Ball& b : balls) met = meet(b, r, low, met ? m.t : high, m) || met;
    for (const Plate& p : plates) met = meet(p, r, low, met ? m.t : high, m) || met;
    return met;
  }
};

class Program {
 public:
  Program(const Scene& scene, const BookProgramPlan& plan) : scene_(scene), plan_(plan) {
    add(scene.objects, {});
    const Camera& c = scene.camera;
    w_ = normalize(c.look_from - c.look_at), u_ = normalize(times(c.vup, w_)), v_ = times(w_, u_);
    focus_ = c.focus_distance.value_or(length(c.look_from - c.look_at));
    height_ = 2 * std::tan(c.vfov * pi / 360) * focus_;
    lens_ = plan.plant == Plant::no_defocus ? 0 : focus_ * std::tan(c.defocus_angle * pi / 360);
  }

  std::vector<std::uint8_t> picture() const {
    const int w = scene_.width, h = scene_.height;
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(3 * w * h));
    const auto rows = [&](int first) {
      for (int y = first; y < h; y += 2) {
        Random random(plan_.generator, plan_.seed * 1000003 + static_cast<std::uint64_t>(y));
        for (int x = 0; x < w; ++x) {
          V sum{};
          for (int k = 0; k < plan_.spp; ++k) {
            const V light = colour(camera_ray(x, y, random), random);
            sum = sum + (plan_.plant == Plant::cut_samples
                             ? V{std::min(light.x, 1.0), std::min(light.y, 1.0), std::min(light.z, 1.0)}
                             : light);
          }
          write(bytes.data() + 3 * place(x, y), (1.0 / plan_.spp) * sum);
        }
      }
    };
    std::thread odd(rows, 1);
    rows(0);
    odd.join();
    return bytes;
  }

 private:
  std::ptrdiff_t place(int x, int y) const {
    const int column = plan_.plant == Plant::mirrored ? scene_.width - 1 - x : x;
    const int row = plan_.plant == Plant::upside_down ? scene_.height - 1 - y : y;
    return static_cast<std::ptrdiff_t>(row) * scene_.width + column;
  }
  V times(V a, V b) const {
    V c = cross(a, b);
    if (plan_.plant == Plant::wrong_cross) c.z = a.x * b.y + a.y * b.x;
    return c;
  }

  void write(std::uint8_t* to, V light) const {
    if (plan_.plant == Plant::red_blue) std::swap(light.x, light.z);
    for (const double value : {light.x, light.y, light.z}) {
      double code = std::sqrt(std::max(value, 0.0));
      if (plan_.plant == Plant::no_gamma) code = value;
      if (plan_.srgb) code = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
      *to++ = static_cast<std::uint8_t>(256 * std::clamp(code, 0.0, 0.999));
    }
  }

  Material0 material_of(const Material& from) const {
    Material0 m;
    if (const auto* colour = std::get_if<Vec3d>(&from.colour)) m.colour = m.other = *colour;
    if (const auto* index = std::get_if<TextureIndex>(&from.colour)) {
      const auto& kind = scene_.textures[static_cast<std::size_t>(index->index)].kind;
      const auto* checker = std::get_if<Checker<>>(&kind);
      if (!checker) throw std::invalid_argument("book_picture: a texture that is no checker");
      m.checker = checker->scale, m.colour = checker->even, m.other = checker->odd;
    }
    if (const auto* metal = std::get_if<Metal<>>(&from.kind)) m.kind = Material0::metal, m.number = metal->fuzz;
    if (const auto* glass = std::get_if<Dielectric<>>(&from.kind))
      m.kind = Material0::glass, m.number = glass->refractive_index, m.colour = m.other = {1, 1, 1};
    if (std::holds_alternative<Light<>>(from.kind)) m.kind = Material0::light;
    if (m.kind == Material0::matt && plan_.plant == Plant::by_value) m.colour = m.other = {};
    return m;
  }

  static V moved(V p, const std::vector<Transform>& transforms, bool direction) {
    for (auto list = transforms.rbegin(); list != transforms.rend(); ++list)
      for (const auto& one : *list) {
        if (const auto* turn = std::get_if<RotateY>(&one)) {
          const double s = std::sin(turn->degrees * pi / 180), c = std::cos(turn->degrees * pi / 180);
          p = {c * p.x + s * p.z, p.y, -s * p.x + c * p.z};
        } else if (!direction) {
          p = p + std::get<Translate>(one).offset;
        }
      }
    return p;
  }
  void add_shape(Part& part, const auto& shape, const std::vector<Transform>& transforms) const {
    using Shape = std::decay_t<decltype(shape)>;
    const auto point = [&](V p) { return moved(p, transforms, false); };
    const auto way = [&](V p) { return moved(p, transforms, true); };
    if constexpr (std::is_same_v<Shape, Sphere<>>) {
      const double radius = plan_.plant == Plant::positive_radius ? std::abs(shape.radius) : shape.radius;
      part.balls.push_back({point(shape.center), point(shape.center_end.value_or(shape.center)), radius});
    } else if constexpr (std::is_same_v<Shape, Quad<>>) {
      part.plates.push_back({point(shape.corner), way(shape.u), way(shape.v)});
    } else if constexpr (!std::is_same_v<Shape, Box<>>) {
      throw std::invalid_argument(std::string("the books have no ") + Shape::type);
    } else {
      const V size = shape.max - shape.min, x = way({size.x, 0, 0}), y = way({0, size.y, 0}), z = way({0, 0, size.z});
      const V low = point(shape.min), high = point(shape.max);
      for (const auto& [a, b] : {std::pair{x, y}, std::pair{y, z}, std::pair{z, x}}) {
        part.plates.push_back({low, b, a});
        part.plates.push_back({high, -1.0 * a, -1.0 * b});
      }
    }
  }
  void add(const std::vector<Object>& objects, const std::vector<Transform>& outer) {
    for (const Object& object : objects) {
      std::vector<Transform> transforms = outer;
      transforms.push_back(object.transform);
      if (const auto* group = std::get_if<Group>(&object.kind)) {
        add(group->objects, transforms);
        continue;
      }
      Part part;
      if (const auto* solid = std::get_if<Solid3d>(&object.kind)) {
        part.material = material_of(scene_.materials[static_cast<std::size_t>(solid->material)]);
        std::visit([&](const auto& shape) { add_shape(part, shape, transforms); }, solid->shape);
      } else {
        const auto& volume = std::get<Volume>(object.kind);
        transforms.push_back(volume.boundary_transform);
        part.material = {Material0::smoke, std::get<Vec3d>(volume.albedo), std::get<Vec3d>(volume.albedo)};
        part.density = volume.medium.density;
        std::visit([&](const auto& shape) { add_shape(part, shape, transforms); }, volume.boundary);
      }
      parts_.push_back(part);
    }
  }

  R camera_ray(int x, int y, Random& random) const {
    const double w = scene_.width, h = scene_.height, width = height_ * w / h;
    double s = (x + random.next()) / w, t = (h - 1 - y + random.next()) / h;
    if (plan_.edition == 2 || plan_.edition == 3) s *= w / (w - 1), t *= h / (h - 1);
    V from = scene_.camera.look_from;
    const V at = from - focus_ * w_ + (s - 0.5) * width * u_ + (t - 0.5) * height_ * v_;
    if (lens_ > 0) {
      V p{2, 0, 0};
      while (p.x * p.x + p.y * p.y >= 1) p = {2 * random.next() - 1, 2 * random.next() - 1, 0};
      from = from + lens_ * p.x * u_ + lens_ * p.y * v_;
    }
    const Camera& c = scene_.camera;
    return {from, at - from, c.shutter_open + random.next() * (c.shutter_close - c.shutter_open)};
  }

  V sky(V direction) const {
    if (plan_.plant == Plant::own_sky) return {1, 0.4, 0.6};
    if (const auto* colour = std::get_if<Vec3d>(&scene_.background)) return *colour;
    const auto& gradient = std::get<Gradient>(scene_.background);
    const double y = normalize(direction).y, a = plan_.plant == Plant::sky_brackets ? 0.5 * y + 1.0 : 0.5 * (y + 1.0);
    return (1 - a) * gradient.bottom + a * gradient.top;
  }

  Meeting closest(const R& r, Random& random) const {
    constexpr double endless = std::numeric_limits<double>::infinity();
    const double low = plan_.plant == Plant::acne ? 0 : 0.001;
    Meeting best;
    for (const Part& part : parts_) {
      Meeting m;
      if (part.material.kind != Material0::smoke) {
        if (!part.meet_any(r, low, best.t, m)) continue;
      } else {
        Meeting in, out;
        if (!part.meet_any(r, -endless, endless, in) || !part.meet_any(r, in.t + 0.0001, endless, out)) continue;
        const double begin = std::max({in.t, low, 0.0}), end = std::min(out.t, best.t);
        const double t = begin - std::log(1 - random.next()) / (part.density * length(r.direction));
        if (begin >= end || t >= end) continue;
        m.t = t, m.normal = {1, 0, 0};
      }
      best = m, best.material = &part.material;
    }
    return best;
  }

  double schlick(double cosine, double ratio) const {
    const double root = (1 - ratio) / (1 + ratio), r0 = root * root, power = std::pow(1 - cosine, 5);
    return plan_.plant == Plant::schlick_is_one ? r0 + (1 - r0) + power : r0 + (1 - r0) * power;
  }

  /// The direction in which a ray goes on; nothing: it is absorbed.
  std::optional<V> scatter(const Material0& m, const R& r, V n, bool front, Random& random) const {
    const V unit = normalize(r.direction);
    if (m.kind == Material0::smoke) return random.unit();
    if (m.kind == Material0::metal) {
      const V mirror = plan_.plant == Plant::long_mirror ? reflect(r.direction, n) : reflect(unit, n);
      const V out = mirror + m.number * (plan_.edition == 4 ? random.unit() : random.in_ball());
      return dot(out, n) > 0 ? std::optional(out) : std::nullopt;
    }
    if (m.kind == Material0::glass) {
      const bool enters = (plan_.plant == Plant::inverted_index) != front;
      const double ratio = enters ? 1 / m.number : m.number;
      const double cosine = std::min(-dot(unit, n), 1.0), sine = std::sqrt(1 - cosine * cosine);
      if (ratio * sine > 1 || schlick(cosine, ratio) > random.next()) return reflect(unit, n);
      const V across = ratio * (unit + cosine * n);
      return across - std::sqrt(std::abs(1 - dot(across, across))) * n;
    }
    const V random_unit = random.unit();
    if (plan_.plant == Plant::hemisphere) return dot(random_unit, n) > 0 ? random_unit : -random_unit;
    if (plan_.edition == 1) return n + random.in_ball();
    return n + random_unit;
  }

  V colour(R r, Random& random) const {
    const double bright = plan_.plant == Plant::bright_lights ? 1.1 : 1;
    V carried{bright, bright, bright};
    const int rays = plan_.plant == Plant::short_paths ? 3 : scene_.render.max_depth + 1;
    for (int k = 0; k < rays; ++k) {
      const Meeting m = closest(r, random);
      if (!m.material) return carried * sky(r.direction);
      const V point = r.origin + m.t * r.direction;
      V albedo = m.material->colour;
      if (m.material->checker > 0) {
        const double cell = m.material->checker;
        const auto sum =
            static_cast<long>(std::floor(point.x / cell) + std::floor(point.y / cell) + std::floor(point.z / cell));
        if (sum % 2 != 0) albedo = m.material->other;
      }
      if (m.material->kind == Material0::light) return carried * albedo;
      const bool front = dot(r.direction, m.normal) < 0;
      const auto out = scatter(*m.material, r, front ? m.normal : -m.normal, front, random);
      if (!out) return {};
      carried = carried * albedo;
      if (plan_.plant == Plant::twice) carried = carried * albedo;
      r = {point, *out, plan_.plant == Plant::lost_time ? 0 : r.time};
    }
    return {};
  }

  const Scene& scene_;
  const BookProgramPlan& plan_;
  std::vector<Part> parts_;
  V u_, v_, w_;
  double focus_ = 1, height_ = 1, lens_ = 0;
};

}  // namespace

std::vector<std::uint8_t> book_picture(const Scene& scene, const BookProgramPlan& plan) {
  return Program(scene, plan).picture();
}

std::string ppm_text(int width, int height, const std::vector<std::uint8_t>& bytes) {
  std::string text = "P3\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
  for (std::size_t k = 0; k < bytes.size(); ++k) text += std::to_string(bytes[k]) + (k % 3 == 2 ? "\n" : " ");
  return text;
}

}  // namespace tyndall::test
