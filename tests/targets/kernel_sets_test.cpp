#include "core/targets/kernels.h"
#include "tests/support/pictures.h"
#include "tests/support/prepared.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

/// A kernel that leaves models out gives, bit for bit, the picture of the full one.
namespace tyndall::test::kernel_sets_test {

namespace {

std::vector<float> picture(const Kernels& kernels, const RenderScene& scene, const SceneView& view) {
  return resolve(drawn_by(kernels, scene, view, 0, 4));
}

/// The picture of a scene, by its own kernel and by the full one, on every instruction set.
void check_against_full(const std::string& name, const RenderScene& columns, const SceneView& own) {
  SceneView full = own;
  full.kernel = KernelSet::everything;
  for (const Kernels& kernels : available_kernels()) {
    CAPTURE(name);
    CAPTURE(std::string(kernels.isa));
    CHECK(picture(kernels, columns, own) == picture(kernels, columns, full));
  }
}

}  // namespace

TEST_CASE("kernel sets: each built-in scene's own gives bit for bit what the full one gives") {
  int scenes_of[kernel_sets] = {};
  for (const BuiltIn& built_in : built_in_scenes()) {
    const auto prepared = prepare(small_scene(built_in.name, 32, 32, 4));
    ++scenes_of[static_cast<int>(prepared->view().kernel)];
    check_against_full(built_in.name, prepared->columns(), prepared->view());
  }
  for (const int scenes : scenes_of) CHECK(scenes > 0);
}

TEST_CASE("instruction sets: the same samples give the same pixels, except where rounding changes a path's decision") {
  for (const std::string name : {"showroom", "cornell-smoke", "cornell-box", "bouncing-spheres", "perlin-spheres"}) {
    const RenderScene scene = compile(small_scene(name, 48, 48, 4));
    const SceneViewOf view(scene);
    const std::vector<float> plain = resolve(drawn_by(scalar_kernels(), scene, view.view(), 0, 1));
    for (const Kernels& kernels : available_kernels()) {
      const std::vector<float> other = resolve(drawn_by(kernels, scene, view.view(), 0, 1));
      int different = 0;
      for (std::size_t i = 0; i < plain.size(); ++i)
        different += std::abs(plain[i] - other[i]) <= 0.03f * (plain[i] + 0.1f) ? 0 : 1;
      CAPTURE(name);
      CAPTURE(std::string(kernels.isa));
      CHECK(different <= 0.02 * static_cast<double>(plain.size()));
    }
  }
}

TEST_CASE("kernel sets: wide instruction sets have a kernel for each, the others the full one alone, and say so") {
  const SceneViewOf box(compile(load_scene("cornell-box").scene));
  for (const Kernels& kernels : available_kernels()) {
    const std::string isa = kernels.isa;
    CAPTURE(isa);
    const bool wide = isa == "avx2" || isa == "avx512";
    for (int i = 0; i < kernel_sets; ++i) {
      SceneView view = box.view();
      view.kernel = static_cast<KernelSet>(i), view.reuses_paths = false;
      CHECK(kernels.set_for(view) == (wide ? view.kernel : KernelSet::everything));
      view.reuses_paths = true;
      const bool has_both = wide && view.kernel != KernelSet::everything &&
                            view.kernel != KernelSet::specular_paths_only &&
                            view.kernel != KernelSet::guided_paths_only;
      CHECK(kernels.set_for(view) == (has_both ? view.kernel : KernelSet::everything));
      for (int k = 0; k < i; ++k) CHECK((kernels.render[k] == kernels.render[i]) != wide);
    }
  }
}

TEST_CASE("kernel sets: a scene that reuses paths has the picture of the full kernel") {
  for (const char* name : {"cornell-box", "cornell-smoke"}) {
    const RenderScene columns = compile(small_scene(name, 32, 32, 4));
    REQUIRE(columns.may_reuse_paths);
    const SceneViewOf of(columns);
    SceneView reused = of.view(), alone = of.view();
    reused.reuses_paths = true, alone.reuses_paths = false;
    check_against_full(name, columns, reused);
    for (const Kernels& kernels : available_kernels())
      CHECK(picture(kernels, columns, reused) != picture(kernels, columns, alone));
  }
}

TEST_CASE("kernel sets: a scene gets the least that holds its models") {
  CHECK(compile(load_scene("cornell-box").scene).kernel == KernelSet::no_media_no_textures);
  CHECK(compile(load_scene("cornell-smoke").scene).kernel == KernelSet::no_specular_paths);
  CHECK(compile(load_scene("earth").scene).kernel == KernelSet::no_specular_paths);
  CHECK(compile(load_scene("stress-light-in-fog").scene).kernel == KernelSet::no_specular_paths);
  CHECK(compile(load_scene("stress-caustic-glass").scene).kernel == KernelSet::specular_paths_only);
  CHECK(compile(load_scene("stress-caustic-shell").scene).kernel == KernelSet::common_models);
  for (const auto& shape : {Solid3d{Triangle<>{}, 0}, Solid3d{Disk<>{}, 0}}) {
    Scene scene = load_scene("cornell-box").scene;
    scene.objects.push_back({"", shape, {}});
    CHECK(compile(scene).kernel == KernelSet::everything);
  }
}

}  // namespace tyndall::test::kernel_sets_test
