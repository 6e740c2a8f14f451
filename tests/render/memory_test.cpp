#include "core/image/image_io.h"
#include "core/scene/load.h"
#include "tests/support/allocations.h"
#include "tests/support/scratch.h"
#include "tests/support/watched_renderer.h"

#include <doctest/doctest.h>

namespace tyndall::test::memory_test {

namespace {

// Without chains: to make a guide for each refused request would take a minute.
const std::string text = R"({"tyndall": 1, "image": {"width": 16, "height": 12}, "render": {"caustics": "scatter"},
  "camera": {"look_from": [0, 1, 4], "look_at": [0, 0.5, 0]},
  "materials": {"white": {"type": "lambertian", "albedo": [0.7, 0.7, 0.7]},
                "lamp": {"type": "light", "radiance": [5, 5, 5]},
                "glass": {"type": "dielectric", "refractive_index": 1.5}},
  "objects": [{"type": "sphere", "center": [0, 0.5, 0], "radius": 0.5, "material": "glass"},
              {"type": "quad", "corner": [-3, 0, -3], "u": [6, 0, 0], "v": [0, 0, 6], "material": "white"},
              {"type": "quad", "corner": [-1, 3, -1], "u": [2, 0, 0], "v": [0, 0, 2], "material": "lamp"}]})";

/// Loads, renders one pass and saves. The scene and its text carry no names that lie in other threads.
void load_render_save(const std::filesystem::path& folder) {
  const Scene scene = read_scene(text, "a.json", ".");
  const RenderScene compiled = compile(scene);
  const RenderResult result =
      render(compiled, {.threads = 1, .isa = "scalar", .region = Region{0, 0, scene.width, scene.height}, .spp = 1});
  const LinearImage image{scene.width, scene.height, resolve(result.film)};
  write_png(folder / "a.png", image, 0, ToneMap::srgb, {text, ""});
  write_pfm(folder / "a.pfm", image);
  write_hdr(folder / "a.hdr", image);
  if (has_openexr()) write_exr(folder / "a.exr", result.film, {}, {text, ""});
}

}  // namespace

TEST_CASE(
    "memory: whichever request is refused while loading, rendering and saving, an error comes out and no scraps stay") {
  const std::filesystem::path folder = scratch_folder("refused_memory");
  load_render_save(folder);
  const std::size_t files = count_files(folder);
  long number = 1;
  int errors = 0;
  for (bool refused = true; refused; number += number < 400 ? 1 : 23) {
    {
      const AllocationRefusal refusal = AllocationRefusal::of_number(number);
      try {
        load_render_save(folder);
      } catch (const std::exception&) {
        ++errors;
      }
      refused = refusal.refused() > 0;
    }
    if (count_files(folder) != files) FAIL("request " << number << " leaves scraps");
  }
  CHECK(number > 300);
  CHECK(errors > 300);
}

TEST_CASE("memory: a renderer that cannot publish its picture says so, and goes on when asked again") {
  Scene scene = read_scene(text, "a.json", ".");
  scene.width = 200;
  scene.height = 100;
  WatchedRenderer renderer(1);
  std::uint64_t edit = 0;
  {
    // The frame's 4 floats a pixel. The film takes another size.
    const AllocationRefusal refusal = AllocationRefusal::of_size(200 * 100 * 16);
    edit = renderer.submit(scene);
    renderer.wait_until([&] { return renderer->reply().problem != nullptr; });
    CHECK(refusal.refused() > 0);
  }
  CHECK(renderer->reply().problem->what.starts_with("not enough memory"));
  scene.camera.vfov = 30;
  edit = renderer.submit(scene);
  CHECK(renderer.wait_for([&](const Frame& f) { return f.edit == edit; })->width == 200);
  CHECK(renderer->reply().problem == nullptr);
}

TEST_CASE("memory: whichever request is refused while a renderer follows an edit, it renders the next one") {
  Scene scene = read_scene(text, "a.json", ".");
  WatchedRenderer renderer(1, "scalar");
  const auto shows = [&](std::uint64_t edit, std::uint32_t spp) {
    const auto latest = renderer->latest();
    return latest && latest->edit == edit && latest->spp >= spp;
  };
  int refused = 0;
  for (int number = 1; number <= 400; ++number) {
    scene.camera.vfov += 0.01;
    {
      const AllocationRefusal refusal = AllocationRefusal::of_number(number);
      std::uint64_t edit = 0;
      try {
        edit = renderer.submit(scene);
      } catch (const std::bad_alloc&) {
      }
      while (refusal.refused() == 0 && !shows(edit, 8)) std::this_thread::sleep_for(std::chrono::microseconds(100));
      refused += refusal.refused();
    }
    scene.camera.vfov += 0.01;
    const std::uint64_t edit = renderer.submit(scene);
    renderer.wait_for([&](const Frame& f) { return f.edit == edit; });
  }
  CHECK(refused > 100);
}

TEST_CASE("memory: whichever request is refused while a renderer takes over a film, each frame is of its edit's size") {
  const Scene small = read_scene(text, "a.json", ".");
  Scene large = small;
  large.width = 2 * small.width;
  const Film taken = render(compile(large), {.isa = "scalar", .spp = 4}).film;
  int refused = 0;
  for (int number = 1; number <= 150; ++number) {
    WatchedRenderer renderer(1, "scalar");
    const std::uint64_t before = renderer.submit(small);
    renderer.wait_for([&](const Frame& f) { return f.edit == before; });
    renderer.pause(true);
    renderer.catch_up();
    const auto scene = std::make_shared<const Scene>(large);
    const auto film = std::make_shared<Film>(taken);
    {
      const AllocationRefusal refusal = AllocationRefusal::of_number(number);
      try {
        renderer.submit(scene, film);
        renderer.catch_up();
      } catch (const std::bad_alloc&) {
      }
      refused += refusal.refused();
    }
    renderer.pause(false);
    for (const FramePointer& frame : renderer.frames())
      if (frame->width != (frame->edit == before ? small.width : large.width)) FAIL("request " << number);
  }
  CHECK(refused > 50);
}

}  // namespace tyndall::test::memory_test
