#include "app/book/inside/shape_candidates.h"
#include "core/base/math.h"
#include "core/base/text.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace tyndall {
namespace {

/// An object of the scene: where it lies for the object that encloses it.
struct Piece {
  std::string body, material{}, moves{}, end{};  ///< JSON; moves: innermost first; end: behind them
  std::string flipped{};                         ///< its body where the sides of what is hit are turned; "": the same
  Vec3d centre{};
  double size = 1;
  bool is_solid = false, is_medium = false;
  std::vector<Vec3d> corners{};  ///< of a rectangle: opposite ones

  std::string text() const {
    return body + material + (moves.empty() ? "" : ",\"transform\":[" + moves + "]") + end + "}";
  }
};

/// The books' translate and rotate_y.
struct Move {
  Vec3d by{};
  double sine = 0, cosine = 1;
  Vec3d out(Vec3d a) const { return {cosine * a.x + sine * a.z, a.y, cosine * a.z - sine * a.x}; }
  book::shot out(const book::shot& a) const { return {{out(a.from) + by, out(a.to), a.time}}; }
  std::string text() const {
    if (sine != 0 || cosine != 1) return fmt::format("{{\"rotate_y\":{}}}", std::atan2(sine, cosine) * 180 / pi);
    return length(by) > 0 ? "{\"translate\":" + triple(by) + "}" : "";
  }
};
/// By the members of an object that holds another; the last one is none.
std::vector<Move> moves_of(const Described& o) {
  std::vector<Move> moves;
  for (const Vec3d& by : o.vectors()) moves.push_back({by});
  const std::vector<double> numbers = o.numbers();
  for (std::size_t k = 0; k + 1 < numbers.size(); ++k) {
    const double a = numbers[k], b = numbers[k + 1];
    if (std::fabs(a * a + b * b - 1) > 1e-6) continue;
    moves.push_back({{}, a, b}), moves.push_back({{}, b, a});
  }
  moves.push_back({});
  return moves;
}

Vec3d lower(Vec3d a, Vec3d b) { return {std::fmin(a.x, b.x), std::fmin(a.y, b.y), std::fmin(a.z, b.z)}; }
Vec3d upper(Vec3d a, Vec3d b) { return -1.0 * lower(-1.0 * a, -1.0 * b); }

class WorldReader {
 public:
  explicit WorldReader(Reading& reading) : r_(reading) {}

  std::string text() {
    if (!book::loop().world) throw NotTaken{"its world is none of its shapes"};
    add(book::loop().world);
    std::vector<std::string> all;
    for (const Piece& one : pieces_) all.push_back(one.text());
    return joined(all, ",\n");
  }

 private:
  void add(const void* shape) {
    if (!shape) throw NotTaken{"a null pointer in place of an object"};
    const Described& o = r_.described('s', shape);
    if (++depth_ > 200) o.refuse("holds itself");
    reason_ = "no such shape in Tyndall";
    if (!sphere(shape, o) && !flat(shape, o) && !medium(shape, o) && !group(shape, o) && !is_never_met(shape, o))
      o.refuse(reason_);
    --depth_;
  }

  /// Whether hit() answers 300 shots from all sides, in different intervals of t, as the candidate would; then it is
  /// taken over, and met_ is one of the hits, in front if its normal is.
  bool take(const void* shape, const Described& o, const Candidate& candidate) {
    RandomNumbers random;
    met_ = {};
    const char* wrong = nullptr;
    bool outward = true, against = true;
    const double place = std::fmax(candidate.size(), largest(candidate.middle()));
    for (int k = 0; k < 300; ++k) {
      book::shot shot = candidate.aim(random, k % 4 == 0 ? 1 : k % 4 == 1 ? 0 : random.next());
      const auto all = candidate.crossings(shot, r_.precision);
      if (!all) continue;
      const double far = all->empty() ? 0 : std::fabs(all->back().t);
      if (k % 3 == 1 && far > 0) shot.low = random.between(0, 2) * far;
      if (k % 3 == 2 && far > 0) shot.high = random.between(0.1, 2) * far;
      const auto is_at_end = [&](const Crossing& one) {
        return std::fmin(std::fabs(one.t - shot.low), std::fabs(one.t - shot.high)) < 0.05 * far;
      };
      if (std::any_of(all->begin(), all->end(), is_at_end)) continue;
      const auto first = std::find_if(all->begin(), all->end(),
                                      [&](const Crossing& one) { return one.t > shot.low && one.t < shot.high; });
      const bool is_met = first != all->end();
      const book::hit_answer its = r_.program.hit(shape, shot);
      const auto is_there = [&] {
        return std::fabs(its.t - first->t) <= 10 * r_.precision * std::fmax(place / length(shot.to), first->t);
      };
      if (its.found != is_met || (is_met && !is_there())) {
        if (shot.low == book::shot().low && shot.high == endless) return false;
        wrong = "its hit() does not keep the interval of t";
      }
      if (!its.found || wrong) continue;
      const double cosine = dot(its.normal, first->normal), facing = dot(shot.to, first->normal);
      if (!(std::fabs(std::fabs(cosine) - 1) <= 0.02)) wrong = "its normals are not those of the books";
      outward = outward && cosine > 0;
      against = against && cosine * facing < 0 && its.front == (facing < 0);
      if (met_.found && met_.material != its.material) return false;
      if (!met_.found) met_ = its, met_.front = its.front == (facing < 0);
    }
    if (wrong) return reason_ = wrong, false;
    if (!met_.found || (candidate.is_sphere() && !outward && !against)) return false;
    if (!is_boundary_ && !met_.material) o.refuse("it has no material: there is no light to trace in this chapter");
    Piece made{candidate.text()};
    if (!is_boundary_) made.material = ",\"material\":" + material_name(r_, met_.material);
    made.centre = candidate.middle(), made.size = candidate.size(), made.is_solid = candidate.is_sphere();
    if (candidate.is_rectangle()) made.corners = {candidate.at, candidate.place(1, 1)};
    pieces_.push_back(made);
    return true;
  }
  bool sphere(const void* shape, const Described& o) {
    const std::vector<Candidate> candidates = spheres_of(o);
    const double radius = o.named("radius", NAN);
    if (radius == 0 && o.vectors().size() + o.all('r').size() > 0) return true;
    if (!std::isnan(radius) && !candidates.empty()) reason_ = "its hit() is not that of the books' sphere";
    for (const Candidate& one : candidates) {
      if (!take(shape, o, one)) continue;
      if (is_boundary_ && length(one.u) > 0) o.refuse("fog in a moving sphere");
      return true;
    }
    return false;
  }

  bool flat(const void* shape, const Described& o) {
    for (Candidate& one : planes_of(o))
      for (const char* type : {"quad", "triangle", "disk"}) {
        one.type = type;
        if ((one.is_disk() && !measure(shape, one)) || !take(shape, o, one)) continue;
        if (!is_boundary_ && r_.one_sided.contains(met_.material)) add_back(one, met_.front);
        return true;
      }
    return false;
  }
  /// Whether it is a rectangle without an area, as those of boxes without a thickness are, and no ray meets it.
  bool is_never_met(const void* shape, const Described& o) {
    std::vector<Vec3d> points = o.vectors();
    const double k = o.named("k", NAN);
    const Vec3d first{o.named("x0", k), o.named("y0", k), o.named("z0", k)},
        side = Vec3d{o.named("x1", k), o.named("y1", k), o.named("z1", k)} - first;
    const bool has_sides = (side.x > 0) + (side.y > 0) + (side.z > 0) == 2;
    const auto is_finite = [](Vec3d one) { return std::isfinite(one.x + one.y + one.z); };
    const bool has_vectors =
        std::all_of(points.begin(), points.end(), [&](Vec3d one) { return is_finite(one) && length(one) > 0; });
    if (std::isnan(k) ? has_vectors : has_sides) return false;
    points.insert(points.end(), {first, first + side});
    std::erase_if(points, [&](Vec3d one) { return !is_finite(one); });
    if (points.empty()) return false;
    Vec3d low = points[0], high = low;
    for (const Vec3d& one : points) low = lower(low, one), high = upper(high, one);
    Piece region;
    region.centre = 0.5 * (low + high), region.size = length(high - low);
    pieces_.push_back(region);
    bool is_met = false;
    for (int n = 0; n < 500; ++n) is_met = is_met || r_.program.hit(shape, aimed(pieces_.size() - 1)).found;
    pieces_.pop_back();
    return !is_met;
  }
  bool meets(const void* shape, const Candidate& plane, double along_u, double along_v) {
    const book::shot shot = plane.shot_at(along_u, along_v);
    const book::hit_answer its = r_.program.hit(shape, shot);
    return its.found && std::fabs(its.t - 1) < 10 * r_.precision * std::fmax(1, largest(plane.at) / length(shot.to));
  }
  /// Measures the radii of a disk or ring; false: its plane is not met, or everywhere.
  bool measure(const void* shape, Candidate& disk) {
    double begin = 0.005;
    while (begin < 1.5 && !meets(shape, disk, begin, 1e-3)) begin += 0.01;
    if (begin > 1.5) return false;
    reason_ = "its hit() is not that of a quad, a triangle, a disk or a ring";
    const auto edge = [&](double low, double high) {
      const bool beyond = meets(shape, disk, high, 0);
      for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        (meets(shape, disk, middle, 0) == beyond ? high : low) = middle;
      }
      return std::round(1e6 * high) / 1e6;
    };
    disk.inner = begin > 0.01 ? edge(begin - 0.01, begin) : 0, disk.radius = edge(begin, 100);
    return !meets(shape, disk, 100, 1e-3);
  }
  /// Black, close behind a light: Tyndall's lights shine on both sides, those of the third book on one.
  void add_back(const Candidate& light, bool is_front) {
    const Vec3d away = (1e-5 * std::sqrt(length(light.normal()))) * normalize(light.normal());
    Candidate below = light, above = light;
    below.at = light.at - away, above.at = light.at + away;
    if (!is_front) std::swap(below, above);
    const std::string black =
        r_.name_of(nullptr, "black", r_.materials, [] { return "{\"type\":\"lambertian\",\"albedo\":[0,0,0]}"; });
    pieces_.push_back({below.text(), ",\"material\":" + black, "", "", above.text()});
  }

  /// Lists, trees, and what moves or turns another object: the nearest of its parts is hit.
  bool group(const void* shape, const Described& o) {
    if (!o.has('s')) return false;
    std::vector<const void*> parts;
    for (const void* part : o.objects('s'))
      if (std::find(parts.begin(), parts.end(), part) == parts.end()) parts.push_back(part);
    const std::size_t begin = pieces_.size();
    for (const void* part : parts) add(part);
    join_box(begin);
    for (const Move& move : parts.size() == 1 ? moves_of(o) : std::vector<Move>(1))
      if (const std::optional<bool> flips = flips_nearest(shape, parts, move, begin)) {
        for (std::size_t k = begin; k < pieces_.size(); ++k) place(pieces_[k], move, *flips);
        return true;
      }
    pieces_.resize(begin);
    reason_ = "its hit() is not that of the nearest of its parts";
    return false;
  }
  static void place(Piece& piece, const Move& move, bool flips) {
    const std::string text = move.text();
    piece.moves += (piece.moves.empty() || text.empty() ? "" : ",") + text;
    piece.centre = move.out(piece.centre) + move.by;
    if (flips && !piece.flipped.empty()) std::swap(piece.body, piece.flipped);
  }
  /// Whether it turns the sides of all that is hit, as the third edition's flip_face does; nothing: its hit() is not
  /// that of the nearest part.
  std::optional<bool> flips_nearest(const void* shape, const std::vector<const void*>& parts, const Move& move,
                                    std::size_t begin) {
    for (std::size_t k = begin; k < pieces_.size(); ++k)
      if (pieces_[k].is_medium) return false;  // whose hits are random
    bool is_same = false, is_flipped = false;
    for (int k = 0; k < 60; ++k) {
      const book::shot inside = aimed(begin);
      const book::hit_answer its = r_.program.hit(shape, move.out(inside));
      book::hit_answer nearest;
      for (const void* part : parts)
        if (const book::hit_answer one = r_.program.hit(part, inside);
            one.found && !(nearest.found && nearest.t <= one.t))
          nearest = one;
      if (its.found != nearest.found || (its.found && !is_near(its.t, nearest.t, 0.01))) return {};
      if (its.found) (its.front == nearest.front ? is_same : is_flipped) = true;
    }
    return is_flipped && !is_same;
  }

  /// Fog has a boundary, a phase function, and a density.
  bool medium(const void* shape, const Described& o) {
    const std::vector<const void*> boundary = o.objects('s'), phase = o.objects('m');
    const double inverse = o.named("dens", NAN);
    if (boundary.size() != 1 || phase.size() != 1 || std::isnan(inverse)) return false;
    if (std::exchange(is_boundary_, true)) o.refuse("fog within fog");
    const std::size_t begin = pieces_.size();
    add(boundary[0]);
    is_boundary_ = false;
    if (pieces_.size() != begin + 1 || !pieces_.back().is_solid) o.refuse("Tyndall's fog fills one sphere or one box");
    const double extinction = inverse < 0 ? -1 / inverse : inverse;
    check_passing(shape, o, boundary[0], extinction, aimed(begin));
    Piece& whole = pieces_.back();
    whole.body = "{\"type\":\"medium\",\"boundary\":" + whole.body;
    whole.end = fmt::format("}},\"density\":{},\"albedo\":{}", extinction, medium_colour(r_, phase[0]));
    whole.is_solid = false, whole.is_medium = true;
    return true;
  }
  /// Counts how often rays pass the fog.
  void check_passing(const void* shape, const Described& o, const void* boundary, double extinction, book::shot shot) {
    shot.to = normalize(shot.to), shot.time = 0;
    book::shot whole = shot;
    whole.low = -1e9;
    const book::hit_answer in = r_.program.hit(boundary, whole);
    whole.low = in.t + 1e-4;
    const book::hit_answer out = r_.program.hit(boundary, whole);
    if (!in.found || !out.found) return;
    constexpr int rounds = 4000;
    int passed = 0;
    for (int k = 0; k < rounds; ++k) passed += r_.program.hit(shape, shot).found ? 0 : 1;
    const double expected = rounds * std::exp(-extinction * (out.t - in.t));
    if (std::fabs(passed - expected) > 5 * std::sqrt(expected + 1) + 3)
      o.refuse("it is denser or thinner than the books' fog");
  }

  /// A ray near one of the objects from that one on, if there are any.
  book::shot aimed(std::size_t begin) {
    const double count = static_cast<double>(pieces_.size() - begin);
    const Piece one = count > 0 ? pieces_[begin + static_cast<std::size_t>(random_.between(0, count))] : Piece{};
    const Vec3d at = one.centre + (random_.between(0, 0.7) * one.size) * random_.on_sphere();
    const Vec3d from = one.centre + (random_.between(1.5, 6) * one.size) * random_.on_sphere();
    return {{from, at - from, 0.5}};
  }

  /// Six rectangles that enclose a box are one, as the books' box() makes them: each is one of its sides.
  void join_box(std::size_t begin) {
    if (pieces_.size() != begin + 6 || pieces_[begin].corners.empty()) return;
    const Piece first = pieces_[begin];
    Vec3d low = first.corners[0], high = low;
    for (std::size_t k = begin; k < begin + 6; ++k)
      for (const Vec3d& corner : pieces_[k].corners) low = lower(low, corner), high = upper(high, corner);
    const double allowed = r_.precision * std::fmax(largest(low), largest(high));
    unsigned sides = 0;
    for (std::size_t k = begin; k < begin + 6; ++k) {
      const Piece& one = pieces_[k];
      if (one.corners.empty() || one.material != first.material || one.moves != first.moves) return;
      const Vec3d from = lower(one.corners[0], one.corners[1]) - low, to = high - upper(one.corners[0], one.corners[1]);
      unsigned away = 0;  // a bit for each side of the box that it does not touch
      for (const double distance : {from.x, from.y, from.z, to.x, to.y, to.z})
        away = 2 * away + (distance > allowed ? 1 : 0);
      if ((away & (away - 1)) != 0) return;
      sides |= away;
    }
    if (sides != 63) return;
    pieces_.resize(begin);
    pieces_.push_back({"{\"type\":\"box\",\"min\":" + triple(low) + ",\"max\":" + triple(high), first.material,
                       first.moves, "", "", 0.5 * (low + high), 0.5 * length(high - low), true});
  }

  Reading& r_;
  std::vector<Piece> pieces_;
  RandomNumbers random_;
  book::hit_answer met_;
  std::string reason_;
  int depth_ = 0;
  bool is_boundary_ = false;  ///< of a medium: it is written without a material
};

}  // namespace

std::string read_world(Reading& reading) { return WorldReader(reading).text(); }

}  // namespace tyndall
