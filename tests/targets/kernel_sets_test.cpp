#include "core/targets/kernels.h"
#include "tests/support/pictures.h"
#include "tests/support/prepared.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

/// A kernel that leaves models out gives, bit for bit, the picture of the full one.
namespace tyndall::test::kernel_sets_test {

namespace {

std::vector<float> picture(const Kernels& kernels, const RenderScene& scene, const SceneView& view) {
  return resolve(drawn_by(kernels, scene, view, 0, 4));
}
std::vector<float> picture(const Kernels& kernels, const RenderScene& scene) {
  return picture(kernels, scene, SceneViewOf(scene).view());
}

}  // namespace

TEST_CASE("kernel sets: each built-in scene's own gives bit for bit what the full one gives") {
  int scenes_of[kernel_sets] = {};
  for (const BuiltIn& scene : built_in_scenes()) {
    const RenderScene own = compile(small_scene(scene.name, 32, 32, 4));
    ++scenes_of[static_cast<int>(own.kernel)];
    RenderScene full = own;
    full.kernel = KernelSet::everything;
    CAPTURE(scene.name);
    for (const Kernels& kernels : available_kernels()) {
      CAPTURE(std::string(kernels.isa));
      CHECK(picture(kernels, own) == picture(kernels, full));
    }
  }
  for (int set = 0; set < kernel_sets; ++set)  // whether a scene has a guide is found after compile()
    CHECK((scenes_of[set] > 0) == (static_cast<KernelSet>(set) != KernelSet::guided_paths_only));
}

TEST_CASE("kernel sets: the one with a guide gives bit for bit what the full one gives") {
  for (const char* name : {"stress-two-balls", "stress-small-fuzz"}) {
    const auto prepared = prepare(small_scene(name, 32, 32, 4));
    CAPTURE(name);
    REQUIRE(prepared->view().kernel == KernelSet::guided_paths_only);
    for (const Kernels& kernels : available_kernels()) {
      CAPTURE(std::string(kernels.isa));
      SceneView full = prepared->view();
      full.kernel = KernelSet::everything;
      CHECK(picture(kernels, prepared->columns(), prepared->view()) == picture(kernels, prepared->columns(), full));
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
    Scene scene = load_scene(name).scene;
    scene.width = scene.height = 32;
    const RenderScene columns = compile(scene);
    const SceneViewOf of(columns);
    SceneView own = of.view();
    own.reuses_paths = true;
    SceneView full = own, alone = own;
    full.kernel = KernelSet::everything, alone.reuses_paths = false;
    CAPTURE(name);
    REQUIRE(columns.may_reuse_paths);
    for (const Kernels& kernels : available_kernels()) {
      const std::vector<float> reused = picture(kernels, columns, own);
      CHECK(reused == picture(kernels, columns, full));
      CHECK(reused != picture(kernels, columns, alone));
    }
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
