// Compiled like the scalar kernel, so that every instruction set gets the same boxes.
#include "core/kernel/glints.h"

#include "core/kernel/chain_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>

namespace tyndall {
namespace {

constexpr int most_pairs = 32;              // so that an edit stays quick
constexpr std::uint32_t drawn_words = 512;  // enough to meet every word that is not rare
constexpr int most_roots = 4;               // of a word between two points
constexpr float least_share = 1e-4f;        // of light, below which a word is left out
constexpr std::size_t most_in_pixel = 16;
constexpr float largest = 16;         // box, in pixels across
constexpr float margin = 0.1f;        // of a box, on each side: it is found from a few points of the lamp only
constexpr float uncertainty = 4e-6f;  // of directions, in radians

/// A part of the picture, in pixels.
struct PictureBox {
  float left = 1e30f, top = 1e30f, right = -1e30f, bottom = -1e30f;

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

class Finder {
 public:
  explicit Finder(const SceneView& s) : s_(s) {}

  void find() {
    std::set<std::int32_t> seen;
    for (int k = 0; k < std::min(s_.chains.pairs, most_pairs); ++k) {
      const std::int32_t ball = s_.chains.ball[k], light = s_.chains.light[k];
      lamp_ = load_light<float>(s_.lights, light);
      points_ = points_of(lamp_);
      if (seen.insert(light).second) add([&](Vec3f point, int) { return point - s_.camera.center; }, 1);
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
  /// Adds the boxes of `roots` images. direction(point, root): in which the camera sees that point of the lamp; zero
  /// if it does not.
  void add(auto direction, int roots) {
    for (int root = 0; root < roots; ++root) {
      PictureBox box;
      for (const Vec3f& point : points_) {
        Pair<float> at{};
        const Vec3f d = direction(point, root);
        if (dot(d, d) > 0 && project(s_.camera, d, at)) box.include(at);
        // Most images are not in the picture: their middle tells.
        if (&point == points_.data() && !is_near_picture(box)) break;
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
    const auto direction = [&](Vec3f point, int) {
      const MirrorWay<float> way = mirror_way(m, s_.camera.center, point);
      return way.found ? way.direction : Vec3f{};
    };
    add(direction, 1);
  }

  /// Straight through, and reflected at the faces at the ends of each edge.
  void by_pane(int number) {
    const ChainPane<float> pane = load_pane<float>(s_.chains, number);
    for (std::int32_t across = 0; across < 3; ++across)
      for (const float crossings : {0.0f, 1.0f, 2.0f}) {
        const auto direction = [&](Vec3f point, int) {
          const PaneSight<float> sight = sight_of(pane, s_.camera.center, point, across);
          const bool outside = sight.near_gap > 0 && sight.far_gap > 0;
          if (!outside || sight.same != (crossings != 1)) return Vec3f{};
          const PaneWay<float> way = pane_way(pane, sight, {across, crossings, {0, 0}});
          return way.found ? way.direction : Vec3f{};
        };
        add(direction, 1);
      }
  }

  void by_ball(std::int32_t ball) {
    asked_ = {};
    asked_.ball = load_ball<float>(s_.chains, ball, 0.0f);
    asked_.lamp = lamp_;
    if (!ask(points_.front())) return;
    std::set<std::array<int, 3>> words;
    for (std::uint32_t i = 0; i <= drawn_words; ++i) {
      // The main word, which has the digit 0, first. A word that starts with another digit is drawn octal by octal.
      const std::uint32_t digits = i == 0 ? 0 : 7u << 29 | i * golden_ratio >> 3;
      const DrawnWord<float> drawn = draw_word(asked_.ball, asked_.ends, digits);
      const ChainWord<float>& w = drawn.word;
      const std::array<int, 3> name{static_cast<int>(w.outer), static_cast<int>(w.inner),
                                    static_cast<int>(w.inner_reflected)};
      if (drawn.drawn && words.insert(name).second) by_word(w);
    }
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
    const auto direction = [&](Vec3f point, int root) -> Vec3f {
      if (!ask(point)) return {};
      ChainFound<float> found;
      found.sign = sign;
      found.chain = turn_of(s_.chains, asked_.ball, asked_.ends, word, sign);
      if (!found.chain.possible) return {};
      const TurnRoots<float> roots = list_roots(found.chain.turn, asked_.plane.angle, true);
      const TurnRoot<float> one = take_root(found.chain.turn, roots, asked_.plane.angle, static_cast<float>(root));
      found.found = one.found, found.s = one.s, found.slope = one.slope, found.sense = one.sense;
      const ChainRays<float> rays = rays_of(asked_, word, found);
      return rays.found && rays.share >= least_share ? rays.direction : Vec3f{};
    };
    add(direction, most_roots);
    ask(points_.front());
  }

  const SceneView& s_;
  LightColumns<float> lamp_{};
  std::vector<Vec3f> points_;  // of the lamp, its middle first
  ChainAsked<float> asked_{};
};

/// The parts of a box in the pixels of which it fills less than half: samples hit larger parts often enough.
void cut(PictureBox box, float pixel_angle, const SceneView& s, std::vector<Glint>& glints) {
  const float extra = uncertainty / pixel_angle;
  const float wide = margin * (box.right - box.left) + extra, high = margin * (box.bottom - box.top) + extra;
  box.left -= wide, box.right += wide, box.top -= high, box.bottom += high;
  if (!(box.right - box.left < largest && box.bottom - box.top < largest)) return;
  for (float y = std::max(std::floor(box.top), 0.0f); y < box.bottom && y < static_cast<float>(s.height); ++y)
    for (float x = std::max(std::floor(box.left), 0.0f); x < box.right && x < static_cast<float>(s.width); ++x) {
      Glint g{x, y, std::max(box.left - x, 0.0f), std::max(box.top - y, 0.0f), 0, 0, 0, 0, 0};
      g.width = std::min(box.right - x, 1.0f) - g.left, g.height = std::min(box.bottom - y, 1.0f) - g.top;
      if (g.width > 0 && g.height > 0 && g.width * g.height < 0.5f) glints.push_back(g);
    }
}

/// Gives the glints of each pixel equal shares of the samples that are drawn within them.
std::vector<Glint> share_out(std::vector<Glint> glints) {
  const auto before = [](const Glint& a, const Glint& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; };
  std::stable_sort(glints.begin(), glints.end(), before);
  std::vector<Glint> out;
  for (auto first = glints.begin(); first != glints.end();) {
    const auto last = std::upper_bound(first, glints.end(), *first, before);
    const std::size_t count = std::min(static_cast<std::size_t>(last - first), most_in_pixel);
    const float share = glint_share / static_cast<float>(count);
    for (std::size_t i = 0; i < count; ++i) {
      Glint g = *(first + static_cast<std::ptrdiff_t>(i));
      g.begin = share * static_cast<float>(i);
      g.end = i + 1 == count ? glint_share : share * static_cast<float>(i + 1);
      g.density = (g.end - g.begin) / (g.width * g.height);
      out.push_back(g);
    }
    first = last;
  }
  return out;
}

}  // namespace

std::vector<Glint> find_glints(const SceneView& scene) {
  if (scene.chains.pairs == 0 || scene.needs.lens || scene.needs.shutter) return {};
  Finder finder(scene);
  finder.find();
  const float pixel_angle = length(scene.camera.du) / length(scene.camera.corner);
  std::vector<Glint> glints;
  for (const PictureBox& box : finder.boxes) cut(box, pixel_angle, scene, glints);
  return share_out(std::move(glints));
}

}  // namespace tyndall
