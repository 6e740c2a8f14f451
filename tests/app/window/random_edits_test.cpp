#include "app/window/edit/arrange.h"
#include "app/window/edit/material_edits.h"
#include "app/window/edit/object_list.h"
#include "core/compile/compile.h"
#include "core/render/render.h"
#include "core/scene/load.h"
#include "tests/app/window/opened_session.h"
#include "tests/support/mixed_scene.h"
#include "tests/support/peak_memory.h"
#include "tests/support/prepared.h"
#include "tests/support/thorough.h"

#include <malloc.h>

#include <algorithm>

/// Many edits of all kinds, as a person's hands make them, while a renderer works.
namespace tyndall::test::random_edits_test {

namespace {

/// Edits a session at random. The same seed makes the same edits; how many of them the renderer sees does not depend on
/// it.
class RandomEdits {
 public:
  RandomEdits(Session& session, unsigned seed) : session_(session), engine_(seed) {}

  /// One edit, or an undo, a redo, a pause; and the session's work of one drawing.
  void step() {
    const int what = below(12);
    Editor& editor = session_.editor;
    if (what == 0)
      editor.undo();
    else if (what == 1)
      editor.redo();
    else if (what == 2)
      session_.wanted.paused = !session_.wanted.paused;
    else
      editor.edit(edited(editor.scene()), static_cast<std::uint64_t>(++edits_ / 3 + 1));  // three are one gesture
    session_.collect();
    session_.accuracy.collect();
    session_.send(1e9);
  }

 private:
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine_); }
  double between(double low, double high) { return uniform(engine_, low, high); }
  ObjectPath any_object(const Scene& scene) { return {below(static_cast<int>(scene.objects.size()))}; }

  Scene edited(Scene scene) {
    if (scene.objects.empty() || (scene.objects.size() < 12 && below(4) == 0)) {
      const Spot spot{in_cube(engine_, 2), {0, 1, 0}, between(0.2, 1)};
      additions()[static_cast<std::size_t>(below(static_cast<int>(additions().size())))].add(scene, spot);
      return scene;
    }
    switch (below(8)) {
      case 0:
        scene.camera.look_from = scene.camera.look_from + in_cube(engine_, 0.3);
        break;
      case 1:
        scene.camera.vfov = between(20, 90);
        break;
      case 2:
        set_anchor(scene, any_object(scene), in_cube(engine_, 2));
        break;
      case 3:
        rotate_object(scene, any_object(scene), between(-180, 180));
        break;
      case 4:
        duplicate_or_delete(scene);
        break;
      case 5:
        other_type(scene);
        break;
      case 6:
        other_settings(scene.render);
        break;
      default:
        scene.materials[static_cast<std::size_t>(below(static_cast<int>(scene.materials.size())))].colour =
            Vec3d{between(0, 1), between(0, 1), between(0, 1)};
    }
    return scene;
  }

  void duplicate_or_delete(Scene& scene) {
    if (scene.objects.size() < 8)
      duplicate_objects(scene, {any_object(scene)});
    else
      delete_objects(scene, {any_object(scene)}, {});
  }
  void other_type(Scene& scene) {
    const ObjectPath path = any_object(scene);
    const int type = below(static_cast<int>(surface_types().size()));
    if (surface_type(scene, path) >= 0 && why_not(scene, path, type).empty())
      set_surface_type(scene, path, type, memory_);
  }
  void other_settings(RenderSettings& render) {
    render.integrator = static_cast<Integrator>(below(count_of<Integrator>()));
    render.sampler = static_cast<SamplerKind>(below(count_of<SamplerKind>()));
    render.fresnel = static_cast<FresnelKind>(below(count_of<FresnelKind>()));
    render.seed = static_cast<std::uint32_t>(below(1000));
  }

  Session& session_;
  Engine engine_;
  MaterialMemory memory_;
  int edits_ = 0;
};

/// Makes so many edits, then checks that the picture which is there in the end is that of the saved scene, bit for bit.
/// after(k) is called after each edit, from 1 on.
template <class After>
void check_random_edits(const std::string& name, int edits, unsigned seed, After after) {
  OpenedSession opened(name);
  RandomEdits random(*opened.session, seed);
  for (int k = 1; k <= edits; ++k) {
    random.step();
    after(k);
    if (k % 97 == 0) {  // now and then the picture is waited for
      opened.session->wanted.paused = false;
      REQUIRE(opened.finishes());
    }
  }
  opened.session->wanted.paused = false;
  REQUIRE(opened.finishes());
  opened.session->editor.save("saved.json");
  const Scene saved = load_scene("saved.json").scene;
  // By their texts: glass remembers a colour that no file holds, for when its type is changed back.
  CHECK(write_scene(saved) == write_scene(opened.session->editor.scene()));
  RenderOptions options;
  options.threads = 1;
  options.spp = static_cast<std::uint32_t>(saved.render.spp.value_or(1));
  CHECK(opened.session->renderers.film() == render(compile(saved), options).film);
}

}  // namespace

TEST_CASE("after many random edits with workers running the picture is that of the saved scene, bit for bit") {
  for (unsigned seed = 1; seed <= 8; ++seed) check_random_edits("random_edits", 300, seed, [](int) {});
}

TEST_CASE("12,000 random edits: the picture is that of the saved scene, and memory does not grow with them") {
  if (!thorough()) return;
  // Without a screen this process has 13 MB, and holes that edits leave in its heap come and go by up to 1.3 MB. So
  // these are medians over 2,000 edits, and may differ by 2 MB: 2.5 % of what a window has, and 200 bytes an edit,
  // where a scene that is kept takes thousands.
  std::vector<std::int64_t> early, late;
  check_random_edits("many_random_edits", 12000, 7, [&](int edits) {
    if (edits % 100 != 0 || edits < 1000 || (edits > 3000 && edits < 10000)) return;
    malloc_trim(0);
    (edits <= 3000 ? early : late).push_back(process_memory("VmRSS"));
  });
  const auto median = [](std::vector<std::int64_t> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return static_cast<double>(*middle);
  };
  MESSAGE("kB after 1,000 edits: ", median(early) / 1000, ", after 10,000: ", median(late) / 1000);
  CHECK(median(late) - median(early) < 2e6);
}

}  // namespace tyndall::test::random_edits_test
