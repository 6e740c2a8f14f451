#include "core/scene/scene.h"
#include "tests/support/allocations.h"
#include "tests/support/thorough.h"
#include "tests/support/watched_renderer.h"

#include <doctest/doctest.h>

/// Edits: the newest wins, nothing is shown that was not asked for, nothing restarts without need.
namespace tyndall::test::renderer_edits_test {

namespace {

/// An empty room whose walls all shine alike: each picture is one colour, whatever its samples.
Scene plain(double brightness, int spp = 3) {
  Scene scene;
  scene.width = 120, scene.height = 90;
  scene.background = Vec3d{brightness, brightness, brightness};
  scene.render.spp = spp;
  return scene;
}

bool is_plain(const Frame& frame, float brightness) {
  for (const float v : rgb_of(frame))
    if (v != brightness) return false;
  return true;
}

}  // namespace

TEST_CASE("edits: of 300 quick ones the newest is shown, each frame whole and of its own edit, in order") {
  WatchedRenderer renderer;
  std::uint64_t edit = 0;
  for (int i = 1; i <= 300; ++i) {
    edit = renderer.submit(plain(i));
    CHECK(edit == static_cast<std::uint64_t>(i));
    if (i % 20 == 0) let_it_work(std::chrono::milliseconds(3));
  }
  renderer.wait_finished(edit);
  std::uint64_t before = 0;
  for (const FramePointer& frame : renderer.frames()) {
    REQUIRE(frame->edit >= before);
    before = frame->edit;
    REQUIRE(is_plain(*frame, static_cast<float>(frame->edit)));  // never black, torn or of another edit
  }
  CHECK(before == 300);
}

TEST_CASE("edits: a coarse first picture has samples of the final one, and what lies between them") {
  Scene scene = small_scene("showroom", 200, 150, 1);
  WatchedRenderer renderer(1);
  renderer.wait_finished(renderer.submit(scene));
  const FramePointer first = renderer.frames().front(), last = renderer->latest();
  CHECK(first->step == 8);  // nothing is known about the machine's speed yet
  CHECK(first->spp == 0);
  CHECK_FALSE(first->finished);
  CHECK(first->grid.spacing == 4);
  CHECK(first->grid.columns == 50);
  CHECK(first->grid.rows == 38);
  CHECK(last->grid.spacing == 1);
  CHECK(last->grid.columns == 200);
  const std::vector<float> coarse = rgb_of(*first), fine = rgb_of(*last);
  const auto pixel = [](const std::vector<float>& rgb, int columns, int x, int y) {
    const std::size_t at = static_cast<std::size_t>(y * columns + x) * 3;
    return Vec3f{rgb[at], rgb[at + 1], rgb[at + 2]};
  };
  for (int y = 0; y < 150; y += 8)
    for (int x = 0; x < 200; x += 8) {
      REQUIRE(pixel(coarse, 50, x / 4, y / 4) == pixel(fine, 200, x, y));
      if (x + 8 >= 200 || y + 8 >= 150) continue;
      const Vec3f a = pixel(fine, 200, x, y), b = pixel(fine, 200, x + 8, y), c = pixel(fine, 200, x, y + 8),
                  d = pixel(fine, 200, x + 8, y + 8), seen = pixel(coarse, 50, x / 4 + 1, y / 4 + 1);
      const Vec3f middle = 0.25f * (a + b + c + d), one = 0.5f * (a + d), other = 0.5f * (b + c);
      const float off = std::min({length(middle - seen), length(one - seen), length(other - seen)});
      REQUIRE(off < 1e-5f * (1 + length(middle)));
    }
}

TEST_CASE("edits: a camera without a lens can be focused anywhere without starting over, one with a lens cannot") {
  WatchedRenderer renderer;
  Scene scene = plain(2);
  const std::uint64_t edit = renderer.submit(scene);
  scene.camera.focus_distance = 3;
  CHECK(renderer.submit(scene) == edit);
  renderer.wait_finished(edit);
  CHECK(rgb_of(*renderer->latest()) == reference_picture(scene));
  scene.camera.defocus_angle = 1;
  CHECK(renderer.submit(scene) == edit + 1);
  scene.camera.focus_distance = 4;
  CHECK(renderer.submit(scene) == edit + 2);
}

TEST_CASE("edits: first pictures sample no more pixels than are shown") {
  Scene scene = small_scene("showroom", 64, 64, 2);
  WatchedRenderer renderer;
  renderer.set(&RenderRequest::shown_pixels, 16 * 16);
  for (int i = 0; i < 4; ++i) {
    scene.camera.look_from.x += 0.01;
    const std::uint64_t edit = renderer.submit(scene);
    renderer.wait_finished(edit);
    CHECK(renderer.wait_for([&](const Frame& f) { return f.edit == edit; })->step >= 4);
  }
}

TEST_CASE("edits: what is equal, or differs in name and display only, restarts nothing") {
  WatchedRenderer renderer;
  Scene scene = plain(2);
  const std::uint64_t edit = renderer.submit(scene);
  renderer.wait_finished(edit);
  const std::uint64_t pass = renderer->latest()->pass;
  CHECK(renderer.submit(scene) == edit);
  scene.name = "another name";
  CHECK(renderer.submit(scene) == edit);
  scene.display.exposure = 2;
  scene.display.tone_map = ToneMap::aces;
  CHECK(renderer.submit(scene) == edit);
  renderer.set_view(View::beauty);
  renderer.set(&RenderRequest::threads, 2);
  renderer.catch_up();
  CHECK(renderer->latest()->pass == pass);
  scene.render.seed = 1;
  CHECK(renderer.submit(scene) == edit + 1);
  renderer.wait_finished(edit + 1);
}

TEST_CASE("edits: on its way to compile a scene is copied nowhere") {
  constexpr std::size_t many = 997;
  Scene scene = plain(2);
  scene.materials = {{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  scene.objects.resize(many, Object{"", Solid3d{Sphere<>{{0, 0, 9}, 1, {}}, 0}, {}});
  WatchedRenderer renderer;
  renderer.wait_finished(renderer.submit(scene));
  scene.camera.vfov -= 1;
  const auto shared = std::make_shared<const Scene>(scene);
  const AllocationCount copies(many * sizeof(Object));
  renderer.wait_finished(renderer.submit(shared));
  CHECK(copies.count() == 0);
}

TEST_CASE("edits: what has changed is the camera, something else, or nothing that samples depend on") {
  const Scene scene = small_scene("showroom", 40, 30, 4);
  Scene other = scene;
  CHECK(change_between(scene, other).none());
  other.name = "another name";
  other.display.exposure = 3;
  other.render.spp = 99;
  CHECK(change_between(scene, other).none());
  other.camera.vfov += 1;
  CHECK(change_between(scene, other).camera);
  CHECK_FALSE(change_between(scene, other).others);
  const auto changes_others = [&](const auto& edit) {
    Scene edited = scene;
    edit(edited);
    const SceneChange change = change_between(scene, edited);
    return change.others && !change.camera;
  };
  CHECK_FALSE(change_between(scene, other).light);
  other.camera.shutter_close += 1;
  CHECK(change_between(scene, other).light);
  CHECK(changes_others([](Scene& s) { ++s.width; }));
  CHECK(changes_others([](Scene& s) { ++s.height; }));
  CHECK(changes_others([](Scene& s) { s.background = Vec3d{1, 2, 3}; }));
  CHECK(changes_others([](Scene& s) { ++s.render.seed; }));
  CHECK(changes_others([](Scene& s) { s.textures.emplace_back(); }));
  CHECK(changes_others([](Scene& s) { s.materials[0].name += "x"; }));
  CHECK(changes_others([](Scene& s) { s.objects.pop_back(); }));
}

TEST_CASE("edits: a restart throws the samples away and renders the same again") {
  WatchedRenderer renderer;
  const Scene scene = small_scene("cornell-box", 80, 80, 6);
  const std::uint64_t edit = renderer.submit(scene);
  const FramePointer once = renderer.wait_finished(edit);
  const std::size_t before = renderer.frames().size();
  renderer.restart();
  const FramePointer again = renderer.wait_finished(edit, before);
  CHECK(again->rgba == once->rgba);
  CHECK(renderer.frames()[before]->spp <= 1);
}

TEST_CASE("edits: a paused renderer takes no more samples, but shows a new scene") {
  WatchedRenderer renderer;
  Scene scene = small_scene("cornell-box", 80, 80, 1000000);
  renderer.submit(scene);
  renderer.wait_for([](const Frame& f) { return f.spp >= 2; });
  renderer.pause(true);
  renderer.catch_up();  // lets the pass that is under way end
  const std::uint64_t pass = renderer->latest()->pass;
  renderer.catch_up();
  CHECK(renderer->latest()->pass == pass);
  scene.camera.look_from.x += 50;
  const double submitted = wall_seconds();
  const std::uint64_t edit = renderer.submit(scene);
  const FramePointer shown = renderer.wait_for([&](const Frame& f) { return f.edit == edit && f.spp == 1; });
  CHECK_FALSE(shown->finished);
  const double until_shown = wall_seconds() - submitted;
  renderer.catch_up();
  CHECK(renderer->latest()->spp == 1);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // the length of the pause does not matter
  const std::size_t before = renderer.frames().size();
  const double resumed = wall_seconds();
  renderer.pause(false);
  const FramePointer next = renderer.wait_for([](const Frame& f) { return f.spp > 1; }, before);
  CHECK(next->seconds <= until_shown + wall_seconds() - resumed);  // pauses are no rendering time
}

TEST_CASE("edits: a scene that cannot be compiled leaves the last picture and says what is wrong") {
  WatchedRenderer renderer;
  const Scene good = plain(2);
  const std::uint64_t first = renderer.submit(good);
  const FramePointer last = renderer.wait_finished(first);
  Scene gigantic = good;
  gigantic.width = gigantic.height = 2000000000;  // no machine has the memory
  for (int round = 0; round < 2; ++round) {
    const std::uint64_t bad = renderer.submit(gigantic);
    renderer.wait_until([&] { return renderer->reply().problem && renderer->reply().problem->edit == bad; });
    CHECK(renderer->reply().problem->edit == bad);
    CHECK(renderer->reply().problem->what.size() > 0);
    CHECK(is_plain(*renderer->latest(), 2));
    CHECK(renderer->latest()->edit < bad);
    CHECK(renderer->latest()->width == 120);
    renderer.set_view(round == 0 ? View::albedo : View::beauty);
    CHECK(renderer->pick(5, 5).object.empty());
    CHECK(renderer->film().pixels.size() == 120 * 90);
    const std::size_t so_far = renderer.frames().size();
    renderer.restart();  // of the scene that is still shown
    CHECK(renderer.wait_for([](const Frame& f) { return f.finished; }, so_far)->edit < bad);
    const std::size_t before = renderer.frames().size();
    renderer.set_view(View::beauty);
    const std::uint64_t undone = renderer.submit(good);
    CHECK(undone == bad + 1);
    CHECK(is_plain(*renderer.wait_finished(undone, before), 2));
    CHECK(renderer->reply().problem == nullptr);
  }
  CHECK(last->edit == first);
}

TEST_CASE("edits: a renderer that is destroyed while it renders ends at once") {
  double going = 0;  // seconds of processor time
  for (int round = 0; round < (thorough() ? 20 : 8); ++round) {
    auto renderer = std::make_unique<WatchedRenderer>();
    renderer->submit(small_scene(round % 2 ? "next-week" : "showroom", 300, 200, 100000));
    renderer->wait_for([&](const Frame& f) { return f.pass > static_cast<std::uint64_t>(round % 8); });
    let_it_work(std::chrono::milliseconds(round));
    const double before = cpu_seconds();
    renderer.reset();
    going += cpu_seconds() - before;
  }
  CHECK(going < 0.5);
  Renderer idle({1, ""});  // never used
  CHECK(idle.latest() == nullptr);
  CHECK(idle.reply().problem == nullptr);
  CHECK(idle.film().pixels.empty());
  CHECK(idle.pick(0, 0).object.empty());
}

}  // namespace tyndall::test::renderer_edits_test
