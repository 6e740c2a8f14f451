// Compiled like the scalar kernel, so that every instruction set gets the same boxes.
#include "core/specular/find_glints.h"

#include "core/specular/chain_light.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>

namespace tyndall {
namespace {

constexpr int most_pairs = 32;        // so that an edit stays quick
constexpr int most_reflections = 4;   // of a word; more carry too little light to be seen
constexpr int most_roots = 4;         // of a word between two points
constexpr float least_share = 1e-6f;  // of light, below which a word is left out
constexpr float seldom_share = 0.1f;  // of light, below which a word's whole image is steered for
constexpr std::ptrdiff_t most_in_pixel = 16;
constexpr float largest = 16;         // box, in pixels across
constexpr float margin = 0.1f;        // of a box, on each side: it is found from a few points of the lamp only
constexpr float uncertainty = 4e-6f;  // of directions, in radians

/// Glint::route
std::int32_t route_by(int reflections, int crossings) {
  return reflections > 0 ? pack_route(reflections, std::min(crossings, 15)) : 0;
}

/// A part of the picture, in pixels.
struct PictureBox {
  float left = 1e30f, top = 1e30f, right = -1e30f, bottom = -1e30f;
  std::int32_t route = 0;  // see Glint
  float share = 0;         // of the light of the lamp's middle that the surfaces send this way

  void include(Pair<float> at) {
    left = std::min(left, at.x), right = std::max(right, at.x);
    top = std::min(top, at.y), bottom = std::max(bottom, at.y);
  }
  bool empty() const { return right < left; }
};

/// Where a direction from the camera meets the picture. false: behind the camera.
bool project(const CameraColumns& c, Vec3f direction, Pair<float>& at) {
  const Vec3f normal = cross(c.du, c.dv);
  const float scale = dot(c.corner, normal) / dot(direction, normal);
  if (!(scale > 0)) return false;
  const Vec3f place = scale * direction - c.corner;
  at = {dot(place, c.du) / dot(c.du, c.du), dot(place, c.dv) / dot(c.dv, c.dv)};
  return true;
}

/// The lamp's middle, and points around it.
std::vector<Vec3f> points_of(const LightColumns<float>& lamp) {
  std::vector<Vec3f> points;
  if (lamp.kind != Lights::sphere) {
    for (const float u : {0.5f, 0.0f, 1.0f})
      for (const float v : {0.5f, 0.0f, 1.0f})
        points.push_back(lamp.corner + u * lamp.length_u * lamp.edge_u + v * lamp.length_v * lamp.edge_v);
    return points;
  }
  const Vec3f center = sphere_light_center(lamp, 0.0f);
  points.push_back(center);
  for (const float x : {-1.0f, 0.0f, 1.0f})
    for (const float y : {-1.0f, 0.0f, 1.0f})
      for (const float z : {-1.0f, 0.0f, 1.0f}) {
        const Vec3f corner{x, y, z};
        const float far = length(corner);
        if (far > 0) points.push_back(center + (lamp.length_u / far) * corner);
      }
  return points;
}

/// How the camera sees a point of a lamp.
struct Sight {
  Vec3f direction;
  float share = 0;  // of light that the surfaces send this way; 0: not seen
};

class Finder {
 public:
  explicit Finder(const SceneView& s) : s_(s) {}

  void find() {
    std::set<std::int32_t> seen;
    for (int k = 0; k < std::min(s_.chains.pairs, most_pairs); ++k) {
      const std::int32_t ball = s_.chains.ball[k], light = s_.chains.light[k];
      lamp_ = load_light<float>(s_.lights, light);
      points_ = points_of(lamp_);
      if (seen.insert(light).second) add([&](Vec3f point, int) { return Sight{point - s_.camera.center, 1}; }, 1, 0);
      if (ball >= s_.chains.first_pane)
        by_pane(ball - s_.chains.first_pane);
      else if (ball >= s_.chains.first_mirror)
        by_mirror(ball - s_.chains.first_mirror);
      else
        by_ball(ball);
    }
  }

  std::vector<PictureBox> boxes;

 private:
  /// Adds the boxes of `roots` images. sight(point, root): of that point of the lamp. route: see Glint.
  void add(auto sight, int roots, std::int32_t route) {
    for (int root = 0; root < roots; ++root) {
      PictureBox box;
      box.route = route;
      for (const Vec3f& point : points_) {
        Pair<float> at{};
        const Sight seen = sight(point, root);
        if (seen.share > 0 && project(s_.camera, seen.direction, at)) box.include(at);
        // Most images are not in the picture: their middle tells.
        if (&point != points_.data()) continue;
        if (!is_near_picture(box)) break;
        box.share = seen.share;
      }
      if (is_near_picture(box)) boxes.push_back(box);
    }
  }

  bool is_near_picture(const PictureBox& box) const {
    return !box.empty() && box.right > -1 && box.left < static_cast<float>(s_.width) + 1 && box.bottom > -1 &&
           box.top < static_cast<float>(s_.height) + 1;
  }

  void by_mirror(int mirror) {
    const ChainMirror<float> m = load_mirror<float>(s_.chains, mirror);
    const auto sight = [&](Vec3f point, int) {
      const MirrorWay<float> way = mirror_way(m, s_.camera.center, point);
      return way.found ? Sight{way.direction, 1} : Sight{};
    };
    add(sight, 1, 0);
  }

  /// Straight through, reflected at the outside, and reflected within, by the faces at the ends of each edge.
  void by_pane(int number) {
    const ChainPane<float> pane = load_pane<float>(s_.chains, number);
    for (std::int32_t across = 0; across < 3; ++across)
      for (int crossings = 0; crossings <= most_reflections + 1; ++crossings) {
        const auto sight = [&](Vec3f point, int) {
          const PaneSight<float> ends = sight_of(pane, s_.camera.center, point, across);
          const bool outside = ends.near_gap > 0 && ends.far_gap > 0;
          if (!outside || ends.same != (crossings % 2 == 0)) return Sight{};
          const PaneWay<float> way = pane_way(pane, ends, {across, static_cast<float>(crossings), {0, 0}});
          return way.found && way.share >= least_share ? Sight{way.direction, way.share} : Sight{};
        };
        add(sight, 1, crossings == 0 ? route_by(1, 0) : route_by(crossings - 1, 2));
      }
  }

  void by_ball(std::int32_t ball) {
    asked_ = {};
    asked_.ball = load_ball<float>(s_.chains, ball, 0.0f);
    asked_.lamp = lamp_;
    if (!ask(points_.front())) return;
    const bool hollow = asked_.ball.hollow, both_out = asked_.ends.both_out;
    if (both_out) by_word({1, 0, 0});
    if (asked_.ball.mirror) return;
    for (int reflections = 0; reflections <= most_reflections; ++reflections) {
      if (hollow) by_layers(reflections);
      if (!hollow || (both_out && is_thick(asked_.ball))) by_word(word_of(reflections, 0, 0));
    }
  }

  /// Words that meet a shell's inner sphere, with so many reflections at the outer one. On each of its ways through the
  /// shell, from the outer sphere to the outer sphere, light is reflected at the inner one, or goes through it, perhaps
  /// reflected within.
  void by_layers(int reflections) {
    const int ways = reflections + crossings() - 1, halves = 2 - crossings();
    for (int turned = 0; turned <= ways; ++turned) {
      const int through = 2 * (ways - turned) + halves,
                most = through > 0 ? most_reflections - reflections - turned : 0;
      for (int within = 0; within <= most; ++within)
        by_word(word_of(reflections, turned + through + within, turned + within));
    }
  }

  /// How often light is let in or out at the outer sphere.
  int crossings() const { return asked_.ends.both_out ? 2 : 1; }

  ChainWord<float> word_of(int outer_reflected, int inner, int inner_reflected) const {
    return {static_cast<float>(crossings() + outer_reflected), static_cast<float>(inner),
            static_cast<float>(inner_reflected)};
  }

  bool ask(Vec3f point) {
    asked_.at.point = point;
    asked_.plane = plane_of(asked_.ball, s_.camera.center, point);
    asked_.ends = ends_of(asked_.ball, asked_.plane.near, asked_.plane.far);
    return asked_.ends.valid && asked_.plane.sine > 1e-7f;
  }

  /// An end within the ball can be left in two ways: see EndSigns.
  void by_word(const ChainWord<float>& word) {
    const bool near_in = asked_.plane.near < asked_.ball.radius;
    add_word(word, {1, 1});
    if (!asked_.ends.both_out) add_word(word, near_in ? EndSigns<float>{-1, 1} : EndSigns<float>{1, -1});
  }

  void add_word(const ChainWord<float>& word, EndSigns<float> sign) {
    const auto sight = [&](Vec3f point, int root) -> Sight {
      if (!ask(point)) return {};
      ChainFound<float> found{turn_of(s_.chains, asked_.ball, asked_.ends, word, sign), sign, {}};
      if (!found.chain.possible) return {};
      const TurnRoots<float> roots = list_roots(found.chain.turn, asked_.plane.angle, true);
      found.root = take_root(found.chain.turn, roots, asked_.plane.angle, static_cast<float>(root));
      const ChainRays<float> rays = rays_of(asked_, word, found);
      return rays.found && rays.share >= least_share ? Sight{rays.direction, rays.share} : Sight{};
    };
    add(sight, most_roots, route_of(word));
    ask(points_.front());
  }

  /// Samples that start within the glass are not steered.
  std::int32_t route_of(const ChainWord<float>& w) const {
    if (asked_.ball.mirror || asked_.plane.near < asked_.ball.radius) return 0;
    if (w.outer < static_cast<float>(crossings())) return route_by(1, 0);  // off the outside of the glass
    const int reflections = static_cast<int>(w.outer + w.inner_reflected) - crossings();
    return route_by(reflections, static_cast<int>(w.outer + w.inner) - reflections);
  }

  const SceneView& s_;
  LightColumns<float> lamp_{};
  std::vector<Vec3f> points_;  // of the lamp, its middle first
  ChainAsked<float> asked_{};
};

struct WeighedGlint {
  Glint glint;
  float weight;  // among those of its pixel
};

/// The parts of a box in the pixels of which it fills less than half: samples hit larger parts often enough. All of its
/// parts where glass sends little light its way: there samples would seldom take it.
void cut(PictureBox box, float pixel_angle, const SceneView& s, std::vector<WeighedGlint>& glints) {
  const float extra = uncertainty / pixel_angle;
  const float wide = margin * (box.right - box.left) + extra, high = margin * (box.bottom - box.top) + extra;
  box.left -= wide, box.right += wide, box.top -= high, box.bottom += high;
  if (!(box.right - box.left < largest && box.bottom - box.top < largest)) return;
  for (float y = std::max(std::floor(box.top), 0.0f); y < box.bottom && y < static_cast<float>(s.height); ++y)
    for (float x = std::max(std::floor(box.left), 0.0f); x < box.right && x < static_cast<float>(s.width); ++x) {
      Glint g{x, y, std::max(box.left - x, 0.0f), std::max(box.top - y, 0.0f), 0, 0, 0, 0, 0, box.route};
      g.width = std::min(box.right - x, 1.0f) - g.left, g.height = std::min(box.bottom - y, 1.0f) - g.top;
      const bool seldom_met = g.width * g.height < 0.5f || (box.route > 0 && box.share < seldom_share);
      if (g.width > 0 && g.height > 0 && seldom_met) glints.push_back({g, std::sqrt(std::sqrt(box.share))});
    }
}

/// Gives each glint its part of the samples of its pixel that are drawn within boxes, by weight. Were that the light
/// which each brings, the darkest would be met by single samples, which then count for much.
std::vector<Glint> share_out(std::vector<WeighedGlint> glints) {
  const auto before = [](const WeighedGlint& a, const WeighedGlint& b) {
    return a.glint.y != b.glint.y ? a.glint.y < b.glint.y : a.glint.x < b.glint.x;
  };
  std::stable_sort(glints.begin(), glints.end(), before);
  std::vector<Glint> out;
  for (auto first = glints.begin(); first != glints.end();) {
    const auto next = std::upper_bound(first, glints.end(), *first, before);
    std::stable_sort(first, next, [](const WeighedGlint& a, const WeighedGlint& b) { return a.weight > b.weight; });
    const auto last = first + std::min<std::ptrdiff_t>(next - first, most_in_pixel);
    const auto add = [](float sum, const WeighedGlint& g) { return sum + g.weight; };
    const float scale = glint_share / std::accumulate(first, last, 0.0f, add);
    float begin = 0, weight = 0;
    for (auto at = first; at != last; ++at) {
      Glint g = at->glint;
      weight += at->weight;
      g.begin = begin, g.end = begin = at + 1 == last ? glint_share : scale * weight;
      g.density = (g.end - g.begin) / (g.width * g.height);
      if (g.begin < g.end) out.push_back(g);
    }
    first = next;
  }
  return out;
}

}  // namespace

std::vector<Glint> find_glints(const SceneView& scene) {
  if (scene.chains.pairs == 0 || scene.needs.lens || scene.needs.shutter) return {};
  Finder finder(scene);
  finder.find();
  const float pixel_angle = length(scene.camera.du) / length(scene.camera.corner);
  std::vector<WeighedGlint> glints;
  for (const PictureBox& box : finder.boxes) cut(box, pixel_angle, scene, glints);
  return share_out(std::move(glints));
}

}  // namespace tyndall
