#include "app/book/shape_candidates.h"
#include "core/base/math.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace tyndall {
namespace {

/// How an object is placed by what encloses it.
struct Placing {
  std::string moves;      ///< JSON, innermost first, with commas between them
  bool boundary = false;  ///< of a medium: it is written without a material
  bool flipped = false;   ///< its normals point the other way
};

/// The books' translate and rotate_y.
struct Move {
  Vector by{};
  double sine = 0, cosine = 1;
  Vector rotated(Vector a, double s) const { return {cosine * a.x - s * a.z, a.y, s * a.x + cosine * a.z}; }
  Vector out(Vector a) const { return rotated(a, -sine) + by; }
  Shot in(const Shot& a) const { return {rotated(a.from - by, sine), rotated(a.to, sine), a.time}; }
  std::string text() const {
    if (sine != 0 || cosine != 1) return fmt::format("{{\"rotate_y\":{}}}", std::atan2(sine, cosine) * 180 / pi);
    return length(by) > 0 ? "{\"translate\":" + triple(by) + "}" : "";
  }
};
/// By the members of an object that holds another; the last one is none.
std::vector<Move> moves_of(const Described& o) {
  std::vector<Move> moves;
  for (const Vector& by : o.vectors()) moves.push_back({by});
  const std::vector<double> numbers = o.all('n');
  for (std::size_t k = 0; k + 1 < numbers.size(); ++k) {
    const double a = numbers[k], b = numbers[k + 1];
    if (std::fabs(a * a + b * b - 1) > 1e-6) continue;
    moves.push_back({{}, a, b}), moves.push_back({{}, b, a});
  }
  moves.push_back({});
  return moves;
}

class WorldReader {
 public:
  explicit WorldReader(Reading& reading) : r_(reading) {}

  void add(double shape, const Placing& at) {
    if (shape == 0) throw NotTaken{"a null pointer in place of an object"};
    const Described& o = r_.described('s', shape);
    if (++depth_ > 200) o.refuse("holds itself");
    reason_ = "no such shape in Tyndall";
    if (!sphere(shape, o, at) && !flat(shape, o, at) && !medium(shape, o, at) && !group(shape, o, at))
      o.refuse(reason_);
    --depth_;
  }

 private:
  std::vector<ShotAnswer> shoot(double shape, std::vector<Shot> shots, std::size_t count = 0) {
    for (Shot& shot : shots) shot.shape = shape;
    return r_.program.ask<ShotAnswer>('h', 0, shots, count);
  }
  /// Whether hit() answers 300 shots from all sides, in different intervals of t, as the candidate would; then it is
  /// taken over, and met_ is one of the hits, in front if its normal is.
  bool take(double shape, const Described& o, const Candidate& candidate, const Placing& at) {
    RandomNumbers random;
    bool outward = true, against = true;
    std::vector<Shot> shots;
    std::vector<std::vector<Crossing>> crossings;
    for (int k = 0; k < 300; ++k) {
      Shot shot = candidate.aim(random, k % 4 == 0 ? 1 : k % 4 == 1 ? 0 : random.next());
      const auto all = candidate.crossings(shot);
      if (all && set_interval(shot, *all, k)) shots.push_back(shot), crossings.push_back(*all);
    }
    const std::vector<ShotAnswer> answers = shoot(shape, shots);
    met_ = {};
    const char* wrong = nullptr;
    for (std::size_t k = 0; k < shots.size(); ++k) {
      const Shot& shot = shots[k];
      const ShotAnswer& its = answers[k];
      const auto expected = std::find_if(crossings[k].begin(), crossings[k].end(),
                                         [&](const Crossing& one) { return one.t > shot.low && one.t < shot.high; });
      const bool hits = expected != crossings[k].end(), limited = shot.low > 0.001 || shot.high < endless;
      const double scale = std::fmax(candidate.piece.size, largest(candidate.piece.centre)) / length(shot.to);
      if ((its.found != 0) != hits ||
          (hits && !(std::fabs(its.t - expected->t) <= 10 * r_.precision * std::fmax(scale, expected->t)))) {
        if (!limited) return false;
        wrong = "its hit() does not keep the interval of t";
      }
      if (!hits || wrong) continue;
      const double cosine = dot(its.normal, expected->normal), facing = dot(shot.to, expected->normal);
      if (!(std::fabs(std::fabs(cosine) - 1) <= 0.02)) wrong = "its normals are not those of the books";
      outward = outward && cosine > 0;
      against = against && cosine * facing < 0 && (its.front != 0) == (facing < 0);
      if (met_.found != 0 && met_.material != its.material) return false;
      if (met_.found == 0) met_ = its, met_.front = (its.front != 0) == (facing < 0);
    }
    if (wrong) return reason_ = wrong, false;
    if (met_.found == 0 || (candidate.piece.is_solid && !outward && !against)) return false;
    if (!at.boundary && met_.material == 0) o.refuse("it has no material: there is no light to trace in this chapter");
    Piece piece = candidate.piece;
    piece.material = at.boundary ? "" : ",\"material\":" + material_name(r_, met_.material), piece.moves = at.moves;
    push(candidate.text, piece);
    return true;
  }

  bool sphere(double shape, const Described& o, const Placing& at) {
    const std::vector<Motion> motions = motions_of(o);
    const double* radius = o.named("radius");
    if (radius && *radius == 0 && !motions.empty()) return true;
    if (radius && !motions.empty()) reason_ = "its hit() is not that of the books' sphere";
    for (const double size : o.all('n'))
      for (const Motion& centre : motions) {
        if (size == 0 || !take(shape, o, sphere_of(centre, size), at)) continue;
        if (at.boundary && length(centre.end - centre.begin) > 0) o.refuse("fog in a moving sphere");
        return true;
      }
    return false;
  }

  bool flat(double shape, const Described& o, const Placing& at) {
    for (const Plane& plane : planes_of(o)) {
      if (!(length(plane.normal()) > 0)) continue;
      for (Flat flat : {Flat{plane, "quad"}, Flat{plane, "triangle"}, Flat{plane, "disk"}}) {
        if (flat.is_disk() && !measure(shape, flat)) continue;
        if (!take(shape, o, flat_of(flat, r_.precision), at)) continue;
        if (!at.boundary && r_.one_sided.contains(met_.material)) add_back(flat, (met_.front != 0) != at.flipped, at);
        return true;
      }
    }
    return false;
  }
  std::vector<bool> meets(double shape, const Plane& plane, const std::vector<double>& along_u, double along_v) {
    std::vector<Shot> shots;
    for (const double place : along_u) shots.push_back(plane.shot(place, along_v));
    const double allowed = 10 * r_.precision * std::fmax(1, largest(plane.corner) / length(plane.shot(0, 0).to));
    std::vector<bool> all;
    for (const ShotAnswer& its : shoot(shape, shots)) all.push_back(its.found != 0 && std::fabs(its.t - 1) < allowed);
    return all;
  }
  /// Measures the radii of a disk or ring; false: its plane is not met, or everywhere.
  bool measure(double shape, Flat& disk) {
    std::vector<double> radii{100};
    for (int k = 0; k < 150; ++k) radii.push_back(0.01 * k + 0.005);
    const std::vector<bool> met = meets(shape, disk.plane, radii, 1e-3);
    const auto first = std::find(met.begin() + 1, met.end(), true);
    if (first == met.end()) return false;
    reason_ = "its hit() is not that of a quad, a triangle, a disk or a ring";
    const auto holds = [&](double radius) -> bool { return meets(shape, disk.plane, {radius}, 0)[0]; };
    const auto edge = [&](double low, double high) {
      const bool beyond = holds(high);
      for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        (holds(middle) == beyond ? high : low) = middle;
      }
      return std::round(1e6 * high) / 1e6;
    };
    const double begin = radii[static_cast<std::size_t>(first - met.begin())];
    disk.inner = begin > 0.01 ? edge(begin - 0.01, begin) : 0, disk.outer = edge(begin, 100);
    return !met[0];
  }
  /// Black, close behind a light: Tyndall's lights shine on both sides, those of the third book on one.
  void add_back(Flat flat, bool is_front, const Placing& at) {
    const Vector normal = flat.plane.normal();
    const double distance = (is_front ? -1e-5 : 1e-5) * std::sqrt(length(normal));
    flat.plane.corner = flat.plane.corner + distance * normalized(normal);
    const std::string black =
        r_.name_of(-1, "black", r_.materials, [] { return "{\"type\":\"lambertian\",\"albedo\":[0,0,0]}"; });
    Piece piece;
    piece.material = ",\"material\":" + black, piece.moves = at.moves;
    push(flat.text(), piece);
  }

  /// Lists, trees, and what moves or turns another object: the nearest of its parts is hit.
  bool group(double shape, const Described& o, const Placing& at) {
    if (std::none_of(o.members.begin(), o.members.end(), [](const auto& one) { return one.kind == 's'; })) return false;
    std::vector<double> parts;
    for (const double part : o.all('s'))
      if (part != 0 && std::find(parts.begin(), parts.end(), part) == parts.end()) parts.push_back(part);
    r_.describe('s', parts);
    if (parts.size() != 1) return is_group(shape, parts, {}, at);
    for (const Move& move : moves_of(o))
      if (is_group(shape, parts, move, at)) return true;
    return false;
  }
  /// Takes the parts over; false: hit() does not answer with the nearest of them.
  bool is_group(double shape, const std::vector<double>& parts, const Move& move, Placing at) {
    const std::size_t begin = r_.objects.size();
    if (const std::string text = move.text(); !text.empty()) at.moves = text + (at.moves.empty() ? "" : "," + at.moves);
    const bool had_media = std::exchange(has_media_, false);
    bool flips = false, agrees = true;
    for (int round = 0; round < 2; ++round) {
      for (const double part : parts) add(part, at);
      join_box(begin);
      for (std::size_t k = begin; k < pieces_.size(); ++k) pieces_[k].centre = move.out(pieces_[k].centre);
      agrees = has_media_ || agrees_with_nearest(shape, parts, move, begin, flips);
      if (agrees && (!flips || round == 1)) break;
      drop(begin);
      if (!agrees) break;
      at.flipped = !at.flipped;
    }
    has_media_ = has_media_ || had_media;
    if (!agrees) reason_ = "its hit() is not that of the nearest of its parts";
    return agrees;
  }
  /// flips: whether it turns the sides of all that is hit, as the third edition's flip_face does.
  bool agrees_with_nearest(double shape, const std::vector<double>& parts, const Move& move, std::size_t begin,
                           bool& flips) {
    constexpr std::size_t rounds = 60;
    std::vector<Shot> shots;
    for (std::size_t k = 0; k < rounds; ++k) shots.push_back(aimed(begin)), shots.back().shape = shape;
    for (const double part : parts)
      for (std::size_t k = 0; k < rounds; ++k) shots.push_back(move.in(shots[k])), shots.back().shape = part;
    const std::vector<ShotAnswer> its = r_.program.ask<ShotAnswer>('h', 0, shots);
    std::vector<ShotAnswer> nearest(rounds);
    for (std::size_t k = rounds; k < its.size(); ++k)
      if (ShotAnswer& known = nearest[k % rounds]; its[k].found != 0 && (known.found == 0 || its[k].t < known.t))
        known = its[k];
    bool is_same = false, is_flipped = false;
    for (std::size_t k = 0; k < rounds; ++k) {
      if (its[k].found != nearest[k].found || (its[k].found != 0 && !is_near(its[k].t, nearest[k].t, 0.01)))
        return false;
      if (its[k].found != 0) (its[k].front == nearest[k].front ? is_same : is_flipped) = true;
    }
    flips = is_flipped && !is_same;
    return true;
  }

  /// Fog has a boundary, a phase function, and a density.
  bool medium(double shape, const Described& o, const Placing& at) {
    const std::vector<double> boundary = o.all('s'), phase = o.all('m');
    const double* inverse = o.named("dens");
    if (boundary.size() != 1 || phase.size() != 1 || !inverse) return false;
    if (at.boundary) o.refuse("fog within fog");
    Placing inside = at;
    inside.boundary = true;
    const std::size_t begin = r_.objects.size();
    add(boundary[0], inside);
    if (r_.objects.size() != begin + 1 || !pieces_.back().is_solid)
      o.refuse("Tyndall's fog fills one sphere or one box");
    const double extinction = *inverse < 0 ? -1 / *inverse : *inverse;
    check_passing(shape, o, boundary[0], extinction, aimed(begin));
    r_.objects.back() = fmt::format("{{\"type\":\"medium\",\"boundary\":{},\"density\":{},\"albedo\":{}}}",
                                    r_.objects.back(), extinction, medium_colour(r_, phase[0]));
    pieces_.back() = {pieces_.back().centre, pieces_.back().size};
    return has_media_ = true;
  }
  /// Counts how often rays pass the fog.
  void check_passing(double shape, const Described& o, double boundary, double extinction, Shot shot) {
    shot.to = normalized(shot.to);
    const ShotAnswer in = shoot(boundary, {{shot.from, shot.to, 0, -1e9}})[0],
                     out = shoot(boundary, {{shot.from, shot.to, 0, in.t + 1e-4}})[0];
    if (in.found == 0 || out.found == 0) return;
    constexpr int rounds = 4000;
    int passed = 0;
    for (const ShotAnswer& one : shoot(shape, {{shot.from, shot.to}}, rounds)) passed += one.found != 0 ? 0 : 1;
    const double expected = rounds * std::exp(-extinction * (out.t - in.t));
    if (std::fabs(passed - expected) > 5 * std::sqrt(expected + 1) + 3)
      o.refuse("it is denser or thinner than the books' fog");
  }

  void push(const std::string& body, const Piece& piece) {
    const std::string transform = piece.moves.empty() ? "" : ",\"transform\":[" + piece.moves + "]";
    r_.objects.push_back(body + piece.material + transform + "}");
    pieces_.push_back(piece);
  }
  void drop(std::size_t begin) { r_.objects.resize(begin), pieces_.resize(begin); }
  /// A ray near one of the objects from that one on, if there are any.
  Shot aimed(std::size_t begin) {
    const double count = static_cast<double>(pieces_.size() - begin);
    const Piece one = count > 0 ? pieces_[begin + static_cast<std::size_t>(random_.between(0, count))] : Piece{};
    const Vector at = one.centre + (random_.between(0, 0.7) * one.size) * random_.on_sphere();
    const Vector from = one.centre + (random_.between(1.5, 6) * one.size) * random_.on_sphere();
    return {from, at - from, 0.5};
  }

  /// Six rectangles that enclose a box are one, as the books' box() makes them: each is one of its sides.
  void join_box(std::size_t begin) {
    if (r_.objects.size() != begin + 6) return;
    const Piece first = pieces_[begin];
    const auto each = [](Vector a, Vector b, auto f) { return Vector{f(a.x, b.x), f(a.y, b.y), f(a.z, b.z)}; };
    const auto lower = [&](Vector a, Vector b) {
      return each(a, b, [](double x, double y) { return std::fmin(x, y); });
    };
    const auto upper = [&](Vector a, Vector b) {
      return each(a, b, [](double x, double y) { return std::fmax(x, y); });
    };
    Vector low = first.corners[0], high = low;
    for (std::size_t k = begin; k < begin + 6; ++k)
      for (const Vector& corner : pieces_[k].corners) low = lower(low, corner), high = upper(high, corner);
    const double allowed = r_.precision * std::fmax(largest(low), largest(high));
    int sides = 0;
    for (std::size_t k = begin; k < begin + 6; ++k) {
      const Piece& one = pieces_[k];
      if (!one.is_rectangle || one.material != first.material || one.moves != first.moves) return;
      const Vector from = lower(one.corners[0], one.corners[1]) - low,
                   to = high - upper(one.corners[0], one.corners[1]);
      const double distances[6] = {from.x, from.y, from.z, to.x, to.y, to.z};
      int away = -1;
      for (int side = 0; side < 6; ++side) {
        if (distances[side] <= allowed) continue;
        if (away >= 0) return;
        away = side;
      }
      if (away >= 0) sides |= 1 << away;
    }
    if (sides != 63) return;
    drop(begin);
    push("{\"type\":\"box\",\"min\":" + triple(low) + ",\"max\":" + triple(high),
         {0.5 * (low + high), 0.5 * length(high - low), true, false, {}, first.material, first.moves});
  }

  Reading& r_;
  std::vector<Piece> pieces_;  ///< one for each object of the scene
  RandomNumbers random_;
  ShotAnswer met_;
  std::string reason_;
  int depth_ = 0;
  bool has_media_ = false;
};

}  // namespace

void read_world(Reading& reading) { WorldReader(reading).add(reading.picture.world, {}); }

}  // namespace tyndall
