#include "app/book/inside/reading.h"
#include "core/base/math.h"

#include <fmt/core.h>

#include <algorithm>

namespace tyndall {
namespace {

struct CameraValues {
  Vec3d look_from, look_at, vup;
  double vfov = 0, defocus_angle = 0, focus_distance = 1;  ///< angles in degrees
};

/// Without the last digits, which are noise.
std::string rounded(Vec3d a) {
  const double unit = std::pow(10, std::ceil(std::log10(largest(a))) - 10);
  const auto whole = [&](double value) { return unit > 0 ? std::round(value / unit) * unit : 0; };
  return fmt::format("[{:.10g},{:.10g},{:.10g}]", whole(a.x), whole(a.y), whole(a.z));
}
double degrees(double opposite, double adjacent) { return 360 / pi * std::atan(opposite / adjacent); }

class CameraReader {
 public:
  explicit CameraReader(Reading& reading)
      : r_(reading), picture_(reading.picture), o_(reading.described('k', nullptr)) {}

  std::string text() {
    fit();
    const CameraValues fitted = camera_;
    take_members();
    if (!agrees()) camera_ = fitted;
    if (!agrees()) throw NotTaken{"get_ray(): its rays are not those of the books' camera"};
    return fmt::format(
        "\"camera\":{{\"look_from\":{},\"look_at\":{},\"vup\":{},\"vfov\":{:.10g},\"defocus_angle\":{:.10g},"
        "\"focus_distance\":{:.10g},\"shutter\":{}}}",
        rounded(camera_.look_from), rounded(camera_.look_at), rounded(camera_.vup), camera_.vfov, camera_.defocus_angle,
        camera_.focus_distance, shutter());
  }

 private:
  /// By the means of many rays at the corners: jitter and lens move single ones.
  void fit() {
    const double inset = picture_.less ? 0 : 0.5, right = picture_.width - 1 + inset,
                 above = inset + picture_.first_row, below = above + picture_.height - 1;
    constexpr std::size_t rounds = 2000;
    std::vector<book::ray_parts> all;
    for (const double row : {above, below})
      for (const double column : {inset, right})
        for (std::size_t k = 0; k < rounds; ++k) all.push_back(book::ray_at(column, row));
    Vec3d forward, from, ends[4];
    for (const book::ray_parts& ray : all) forward = forward + normalize(ray.to);
    const bool is_unit = std::all_of(all.begin(), all.end(), [](const book::ray_parts& ray) {
      return std::fabs(length(ray.to) - 1) < 1e-3;  // then directions do not end in the plane of focus
    });
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (is_unit) all[k].to = (1 / dot(all[k].to, normalize(forward))) * all[k].to;
      from = from + (0.25 / rounds) * all[k].from;
      ends[k / rounds] = ends[k / rounds] + (1.0 / rounds) * (all[k].from + all[k].to);
    }
    const Vec3d middle = 0.25 * (ends[0] + ends[1] + ends[2] + ends[3]),
                across = (1 + 2 * inset / (right - inset)) * (ends[1] - ends[0]),
                down = (1 + 2 * inset / (below - above)) * (ends[2] - ends[0]), w = normalize(cross(down, across));
    const double distance = std::fabs(dot(middle - from, w));
    double lens = 0, jitter = 0;
    for (std::size_t k = 0; k < rounds; ++k) {
      lens = std::fmax(lens, length(all[k].from - from));
      jitter = std::fmax(jitter, length(all[k].from + all[k].to - ends[0]));
    }
    noise_ = 1e-3 * r_.precision + 0.1 * jitter / std::fmin(length(across), length(down));
    if (lens < 1e-3 * r_.precision * std::fmax(1, largest(from))) lens = 0;
    camera_ = {middle + distance * w,   middle,  -1.0 * normalize(down), degrees(0.5 * length(down), distance),
               degrees(lens, distance), distance};
  }

  /// Takes what the camera's members say in place of what was measured, where it is nearly that.
  void take_members() {
    const Vec3d to = normalize(camera_.look_at - camera_.look_from), up = camera_.vup;
    const auto take_point = [&](Vec3d& to_set, const char* name, const auto& is) {
      const std::vector<Vec3d> points = o_.vectors(name);
      if (const auto one = std::find_if(points.begin(), points.end(), is); one != points.end()) to_set = *one;
    };
    const auto have_one_direction = [&](Vec3d a, Vec3d b) { return length(normalize(a) - normalize(b)) < noise_; };
    take_point(camera_.look_from, "",
               [&](Vec3d one) { return is_near(one, camera_.look_from, noise_ * camera_.focus_distance); });
    camera_.look_at = camera_.look_from + camera_.focus_distance * to;
    take_point(camera_.look_at, "at", [&](Vec3d one) { return have_one_direction(one - camera_.look_from, to); });
    take_point(camera_.vup, "up", [&](Vec3d one) { return have_one_direction(cross(to, one), cross(to, up)); });
    const auto take = [&](double& to_set, double allowed, const auto& value) {
      const double measured = to_set;
      double nearest = allowed * measured;
      for (const double number : o_.numbers())
        if (const double one = value(number); std::fabs(one - measured) < nearest)
          nearest = std::fabs(one - measured), to_set = one;
      return to_set != measured;
    };
    const auto itself = [](double number) { return number; };
    take(camera_.vfov, noise_, itself), take(camera_.focus_distance, noise_, itself);
    const auto of_lens = [&](double radius) { return degrees(radius, camera_.focus_distance); };
    take(camera_.defocus_angle, 0.03, of_lens) || take(camera_.defocus_angle, 0.03, itself) ||
        take(camera_.defocus_angle, 0.03, [&](double width) { return of_lens(width / 2); });
  }

  /// Whether 2,000 rays leave the lens, all of its parts alike, and meet the plane of focus in their pixels.
  bool agrees() {
    const Vec3d w = normalize(camera_.look_from - camera_.look_at), u = normalize(cross(camera_.vup, w)),
                v = cross(w, u);
    if (!(largest(u) <= 1)) return false;
    const double height = 2 * std::tan(camera_.vfov * pi / 360) * camera_.focus_distance,
                 size = height / picture_.height;
    const double lens = camera_.focus_distance * std::tan(camera_.defocus_angle * pi / 360);
    const double rounding = 0.01 * r_.precision * largest(camera_.look_from) / size;
    const double wide = (picture_.by_pixels ? 1.01 : picture_.less ? 1.52 : 0.02) + rounding;
    RandomNumbers random;
    constexpr int rounds = 2000;
    double widest = 0, squares = 0;
    for (int k = 0; k < rounds; ++k) {
      const double x = random.between(0, picture_.width), y = random.between(0, picture_.height);
      const book::ray_parts ray = book::ray_at(x, y);
      const Vec3d from = ray.from - camera_.look_from, to = ray.to;
      const double forward = -dot(to, w);
      if (!(forward > 0)) return false;
      const Vec3d point = from + ((camera_.focus_distance + dot(from, w)) / forward) * to;
      const auto place = [&](double at) { return picture_.by_pixels ? std::floor(at) + 0.5 : at; };
      const double column = place(x) - 0.5 * picture_.width, row = 0.5 * picture_.height - place(y);
      if (!(std::fabs(dot(point, u) / size - column) <= wide && std::fabs(dot(point, v) / size - row) <= wide))
        return false;
      widest = std::fmax(widest, length(from)), squares += dot(from, from) / rounds;
    }
    const double error = r_.precision * std::fmax(1, largest(camera_.look_from));
    return std::fabs(widest - lens) <= 0.1 * lens + error &&
           std::fabs(squares - 0.5 * lens * lens) <= 0.05 * lens * lens + error * error;
  }

  /// By the times of 2,000 rays, and two numbers of the members between which they lie.
  std::string shutter() {
    double low = endless, high = -endless;
    for (int k = 0; k < 2000; ++k) {
      const double time = book::ray_at(0.5, 0.5).time;
      low = std::fmin(low, time), high = std::fmax(high, time);
    }
    if (high - low < 1e-9) return fmt::format("[{},{}]", low, low);
    const std::vector<double> numbers = o_.numbers();
    for (std::size_t k = 0; k + 1 < numbers.size(); ++k) {
      const double open = numbers[k], close = numbers[k + 1], span = close - open;
      if (low >= open && high <= close && high - low > 0.98 * span) return fmt::format("[{},{}]", open, close);
    }
    return fmt::format("[{},{}]", std::round(low * 50) / 50, std::round(high * 50) / 50);
  }

  Reading& r_;
  const book::picture_told& picture_;
  const Described& o_;
  CameraValues camera_;
  double noise_ = 0;  ///< of what was measured, as a part of it
};

void expect(Vec3d wanted, Vec3d found, double precision, const char* of) {
  if (!is_near(wanted, found, 100 * precision))
    throw NotTaken{
        fmt::format("ray_color(): of {} it makes {}, the books' would make {}", of, triple(found), triple(wanted))};
}

}  // namespace

std::string read_camera(Reading& reading) { return CameraReader(reading).text(); }

std::string read_sky(Reading& reading) {
  const auto colour = [&](const book::ray_parts& ray) {
    return reading.program.light({nullptr, 0, nullptr, 0, ray.from, ray.to}).colour;
  };
  const Vec3d bottom = colour({{}, {0, -1, 0}}), top = colour({{}, {0, 1, 0}});
  const auto check = [&](const book::ray_parts& ray) {
    const double a = 0.5 * (normalize(ray.to).y + 1);
    const Vec3d found = colour(ray);
    if (!(largest(found - ((1 - a) * bottom + a * top)) <= reading.precision * std::fmax(1, largest(top))))
      throw NotTaken{"the sky of ray_color() is neither one colour nor a gradient from top to bottom"};
    if (!(found.x >= 0 && found.y >= 0 && found.z >= 0)) throw NotTaken{"the sky of ray_color() is darker than black"};
  };
  RandomNumbers random;
  Vec3d eye;
  for (int k = 0; k < 20000; ++k) {  // what the camera sees
    const double x = random.between(0, reading.picture.width), y = random.between(0, reading.picture.height);
    const book::ray_parts ray = book::ray_at(x, y);
    check(ray), eye = ray.from;
  }
  constexpr int rows = 1024, columns = 2048;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double y = 1 - 2 * (row + 0.5) / rows, angle = 2 * pi * (column + 0.5) / columns, r = std::sqrt(1 - y * y);
      check({column % 2 ? eye : Vec3d{30.0 * row, -40, 7.0 * column},
             (1.0 + column % 3) * Vec3d{r * std::cos(angle), y, r * std::sin(angle)}});
    }
  return is_near(top, bottom, 1e-9)
             ? triple(top)
             : "{\"type\":\"gradient\",\"bottom\":" + triple(bottom) + ",\"top\":" + triple(top) + "}";
}

int read_depth(Reading& reading) {
  const int told = std::max(reading.picture.depth - 1, 0);
  const void *matt = reading.matt, *shining = reading.shining;
  const book::light_answer sky = reading.program.light({});
  if (sky.high == 0 || !(matt || shining)) return told;  // its world cannot be replaced, or has neither
  if (sky.low <= 0)
    throw NotTaken{"ray_color() takes hits at t = 0, so that half of the light meets the surface that it leaves"};
  if (!(sky.low <= 0.05 && sky.high >= 1e4))
    throw NotTaken{fmt::format("ray_color() looks for hits at t from {} to {} only", sky.low, sky.high)};
  if (shining) expect(reading.light, reading.program.light({shining, 1}).colour, reading.precision, "a light");
  if (!matt) return told;
  if (!reading.picture.draws_by_pdf) {
    const book::light_answer hit = reading.program.light({matt, 1});
    const Vec3d beyond = reading.program.light({nullptr, 0, nullptr, 0, {}, hit.second}).colour;
    expect(reading.albedo * beyond, hit.colour, reading.precision, "one hit");
    if (shining)
      expect(reading.albedo * reading.light, reading.program.light({matt, 1, shining, 1}).colour, reading.precision,
             "a hit and a light");
  }
  constexpr int limit = 3000;
  int hits = 0;
  for (int k = 0; k < 10; ++k) hits = std::max(hits, reading.program.light({matt, limit}).hits);
  return hits >= limit ? 100000 : hits - 1;
}

}  // namespace tyndall
