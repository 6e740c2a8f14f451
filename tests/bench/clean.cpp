#include "tests/bench/bench.h"
#include "tests/support/prepared.h"

#include <atomic>

namespace tyndall::bench {

using namespace test;
namespace {

const std::atomic<bool> never = false;

/// Milliseconds that clean pictures of one film take, in the middle of many.
void add_row(const Table& table, const std::string& name, std::uint32_t spp, int repeat) {
  const RenderScene scene = compile(built_in(name, 1280, 720));
  const RenderOptions options{.threads = 2, .spp = spp};
  const RenderResult result = render(scene, options);
  ThreadPool thread_pool(options.threads);
  const SceneViewOf view(scene);
  const RenderEngine engine{thread_pool, result.kernels, view.view()};
  FilmCleaner cleaner(result.kernels);
  CleanPicture picture;
  std::vector<double> kept, anew;
  for (int i = 0; i <= repeat; ++i) {
    cleaner.change_scene();
    PixelLevels levels;
    const auto make = [&] { cleaner.run(result.film, engine, &levels, never, picture); };
    anew.push_back(1000 * seconds_of(make));
    kept.push_back(1000 * seconds_of(make));
  }
  // The first of all has to get its memory from the system.
  table.add({name, cell(spp, 0), cell(1000 * result.seconds, 0), cell(anew.front(), 0),
             cell(median({anew.begin() + 1, anew.end()}), 0), cell(median(kept), 0), cell(picture.relative_error, 3)});
}

}  // namespace

void measure_clean(const Settings& settings) {
  const int repeat = settings.quick ? 5 : 15;
  const Table table("Clean picture, 1280x720, two threads: milliseconds, median of " + std::to_string(repeat),
                    {"scene", "spp", "rendered in", "first", "scene anew", "scene kept", "error"});
  for (const char* name :
       {"cornell-box", "cornell-smoke", "showroom", "next-week", "hollow-glass", "stress-medium-in-glass"})
    for (const std::uint32_t spp : {2u, 16u}) add_row(table, name, spp, repeat);
}

}  // namespace tyndall::bench
