#include "core/guide/find_guide.h"
#include "core/guide/guide_trail.h"
#include "core/guide/light_paths.h"
#include "core/guide/lobes.h"
#include "tests/support/pictures.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

/// The guide: where it is made, that its pdf is that of the directions it draws, and that it is a function of the
/// scene.
namespace tyndall::test::guide_test {

namespace {

struct Guided {
  std::shared_ptr<const PreparedScene> prepared;
  const Guide& view() const { return prepared->view().guide; }
  explicit Guided(const char* name) : prepared(prepare(small_scene(name, 64, 48, 1))) {
    REQUIRE(prepared->guide().lobes() > 0);
  }
};

/// A point of the floor, by its place in the scene's own coordinates.
Vec3f on_floor(const Guided& g, double x, double z) {
  const Vec3d p = Vec3d{x, 0, z} - g.prepared->columns().origin;
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

/// All sequences of the cell of a point.
std::vector<GuidedSequence<float>> sequences_at(const Guide& g, Vec3f point) {
  std::vector<GuidedSequence<float>> list;
  const std::int32_t cell = find_cell<float>(g, point, true);
  if (cell < 0) return list;
  const GuideCell& its = g.cells[cell];
  for (std::int32_t i = its.first; i < its.end; ++i) list.push_back({i, its.query_probability * g.sequences[i].weight});
  return list;
}

struct Draws {
  std::mt19937 engine{7};
  float next() { return static_cast<float>(engine() >> 8) * 0x1p-24f; }
};

}  // namespace

TEST_CASE("guide: directions are drawn with the pdf that is stated") {
  for (const char* name : {"stress-small-fuzz", "stress-two-balls"}) {
    CAPTURE(name);
    const Guided g(name);
    Draws draws;
    int tested = 0;
    for (const double x : {-2.0, 0.5, 1.5}) {
      const Vec3f point = on_floor(g, x, 1.5);
      const auto drawn = draw_guided_sequence<float>(g.view(), point, draws.next(), true);
      for (const GuidedSequence<float>& sequence : sequences_at(g.view(), point)) {
        if (sequence.index == drawn.index) CHECK(drawn.probability == doctest::Approx(sequence.probability).scale(0));
        const GuidedDirections<float> directions = guided_directions(g.view(), sequence, point);
        const SeenLobe<float>& seen = directions.lobe;
        if (!seen.exists) continue;
        // Light that was found otherwise, with half of the pdf, has a fifth by the power heuristic.
        const GuideSequence& its = g.view().sequences[sequence.index];
        const OrderedEvents<float> events{its.low, its.high};
        const GuideTrail<float> trail{point, seen.center, 0.5f * guided_pdf(directions, seen.center), events};
        CHECK(mis_weight_beside_guide(g.prepared->view(), trail, events, true) == doctest::Approx(0.2).scale(0));
        // The mean of 1 / pdf over the directions drawn within a cone is the cone's solid angle.
        for (const double factor : {0.5, 3.0, 20.0}) {
          const double angle = std::min(factor * static_cast<double>(seen.length_u), 1.0);
          const double solid_angle = 2 * pi * (1 - std::cos(angle));
          constexpr int count = 200000;
          double sum = 0, squares = 0;
          for (int i = 0; i < count; ++i) {
            bool exists = true;
            const float strategy = draws.next(), u = draws.next();
            const Vec3f direction = draw_guided_direction(directions, strategy, {u, draws.next()}, exists);
            const Vec3f across = cross(direction, seen.center);
            const bool inside =
                exists && dot(direction, seen.center) > 0 && static_cast<double>(length(across)) < std::sin(angle);
            if (!inside) continue;
            const double value = static_cast<double>(sequence.probability / guided_pdf(directions, direction));
            sum += value, squares += value * value;
          }
          const double mean = sum / count, error = std::sqrt((squares / count - mean * mean) / count);
          CAPTURE(angle);
          CHECK(std::abs(mean - solid_angle) < 5 * error + 0.004 * solid_angle);
          ++tested;
        }
      }
    }
    CHECK(tested > 10);
  }
}

TEST_CASE("guide: light seen in a sphere is reflected at equal angles, from near the sphere to far away") {
  std::mt19937 engine{3};
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto on_unit_sphere = [&] {
    const double z = 2 * uniform(engine) - 1, r = std::sqrt(1 - z * z), phi = 2 * pi * uniform(engine);
    return Vec3d{r * std::cos(phi), r * std::sin(phi), z};
  };
  const auto distance = [&] { return 1 + std::pow(10, 3 * uniform(engine) - 2); };
  int hidden = 0, exact = 0, seen = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3d point = distance() * on_unit_sphere(), light = distance() * on_unit_sphere();
    const SeenImage<double> image = see_image(LightImage<double>{light, {}, 1}, point);
    const double nearest = length(cross(point, light - point)) / length(light - point);
    const double before = dot(-point, light - point), behind = dot(light, light - point);
    const bool blocked = before > 0 && behind > 0 && nearest < 1;
    hidden += blocked && !image.exists, seen += image.exists;
    if (!image.exists) continue;
    CHECK_FALSE(blocked);
    const double middle = -dot(point, image.direction);
    const double across = dot(point, point) - middle * middle;
    if (across > 1) continue;  // beside the sphere: counted below
    const Vec3d place = point + (middle - std::sqrt(1 - across)) * image.direction;
    const Vec3d reflected = image.direction - (2 * dot(image.direction, place)) * place;
    exact += length(cross(reflected, light - place)) / length(light - place) < 1e-3;
  }
  CHECK(hidden > 500);
  CHECK(exact > 0.98 * seen);
  const SeenImage<double> straight = see_image(LightImage<double>{{0, 3, 4}, {}, 0}, {0, 0, 0});
  CHECK(straight.exists);
  CHECK(length(straight.direction - Vec3d{0, 0.6, 0.8}) < 1e-15);
}

TEST_CASE("guide: copies of light paths share the light of those that landed") {
  const Guided g("stress-small-fuzz");
  LightPaths paths(g.prepared->view(), list_things(g.prepared->view()));
  paths.trace_pairs(20000);
  const auto power = [&] {
    double sum = 0;
    for (const Landing& landing : paths.landings) sum += landing.weight;
    return sum;
  };
  const double before = power();
  const std::size_t landed = paths.landings.size();
  paths.trace_copies(2000);
  CHECK(paths.landings.size() > landed);
  CHECK(power() == doctest::Approx(before).scale(0));
}

TEST_CASE("guide: the same bits whatever was edited before") {
  const auto scene = std::make_shared<const Scene>(small_scene("stress-small-fuzz", 64, 48, 1));
  const auto fresh = prepare(scene);
  const auto same = [&](const PreparedScene& other) {
    const Guide &a = fresh->guide(), &b = other.guide();
    return a.cells == b.cells && a.sequences == b.sequences && a.thing_of == b.thing_of && a.lobe == b.lobe &&
           a.images == b.images && a.slot_mask == b.slot_mask;
  };
  Scene moved = *scene, brighter = *scene;
  moved.camera.look_from.x += 1;
  moved.render.seed = 5;
  brighter.materials[0].colour = Vec3d{0.2, 0.2, 0.2};
  for (const Scene& before :
       {moved, brighter, small_scene("stress-two-balls", 32, 24, 1), small_scene("cornell-box", 8, 8, 1)})
    CHECK(same(*prepare(scene, prepare(before).get())));
  // It is not made twice for another picture, a name or a key; it is for another shutter.
  const auto is_kept = [&](Scene edited) {
    const auto after = prepare(std::make_shared<const Scene>(std::move(edited)), fresh.get());
    return after->guide().cells.begin() == fresh->guide().cells.begin();
  };
  CHECK(is_kept(moved));
  moved.name = "moved", moved.animation.emplace();
  CHECK(is_kept(moved));
  moved.camera.shutter_close = 1;
  CHECK_FALSE(is_kept(moved));
}

TEST_CASE("guide: none without small lights, or without something near-specular, or where it is switched off") {
  for (const char* name : {"cornell-box", "quads", "cover", "showroom", "next-week", "stress-caustic-glass",
                           "stress-caustic-mirror", "stress-mirror-wall", "stress-pane", "stress-bulb"})
    CHECK_MESSAGE(prepare(small_scene(name, 8, 8, 1))->guide().lobes() == 0, name);
  CHECK(prepare(small_scene("quads", 8, 8, 1))->guide().light_paths == 0);
  const auto lobes = [](auto change) {
    Scene scene = small_scene("stress-small-fuzz", 8, 8, 1);
    change(scene.render);
    return prepare(scene)->guide().lobes();
  };
  CHECK(lobes([](RenderSettings&) {}) > 0);
  CHECK(lobes([](RenderSettings& s) { s.caustics = Caustics::scatter; }) == 0);
  CHECK(lobes([](RenderSettings& s) { s.integrator = Integrator::nee; }) == 0);
  CHECK(lobes([](RenderSettings& s) { s.integrator = Integrator::path; }) == 0);
  CHECK(lobes([](RenderSettings& s) { s.fresnel = FresnelKind::schlick; }) == 0);
}

TEST_CASE("guide: sequences of events are told apart by surface, kind and order, up to ten of them") {
  using Events = OrderedEvents<float>;
  const Events a = append_event(append_event(Events::none(), 3, true), 7, false);
  const Events b = append_event(append_event(Events::none(), 7, false), 3, true);
  CHECK_FALSE(same_events(a, b));
  CHECK_FALSE(same_events(a, append_event(append_event(Events::none(), 3, true), 7, true)));
  CHECK_FALSE(append_event(a, -1, true).is_known());
  Events all = Events::none();
  for (int i = 0; i < max_guided_events; ++i) {
    all = append_event(all, max_guided_things - 1, true);
    CHECK(all.is_known());
  }
  CHECK_FALSE(append_event(all, 0, false).is_known());
}

}  // namespace tyndall::test::guide_test
