#include "tests/bench/bench.h"
#include "tests/bench/measure.h"
#include "tests/bench/scenes.h"
#include "tests/support/prepared.h"

#include <atomic>

namespace tyndall::bench {

using namespace test;
namespace {

const std::atomic<bool> never = false;

/// Milliseconds of each part of a clean picture of one film, in the middle of many.
Json row_of(const std::string& name, std::uint32_t spp, int repeat) {
  const RenderScene scene = compile(built_in(name, 1280, 720));
  const RenderOptions options{.threads = 2, .spp = spp};
  const RenderResult result = render(scene, options);
  ThreadPool thread_pool(options.threads);
  const SceneViewOf view(scene);
  const RenderEngine engine{thread_pool, result.kernels, view.view()};
  FilmCleaner whole(result.kernels);
  CleanPicture picture;
  CleanInput input;
  std::vector<double> read, seen, kept, anew;
  for (int i = 0; i <= repeat; ++i) {
    FirstSeenParts parts;
    read.push_back(1000 * seconds_of([&] { read_film(result.film, thread_pool, never, input); }));
    seen.push_back(1000 * seconds_of([&] { find_first_seen(result.film.region, engine, never, input, parts); }));
    whole.change_scene();
    PixelLevels levels;
    const auto make = [&] { whole.run(result.film, engine, &levels, never, picture); };
    anew.push_back(1000 * seconds_of(make));
    kept.push_back(1000 * seconds_of(make));
  }
  Json row;
  row["scene"] = name;
  row["spp"] = spp;
  row["isa"] = result.kernels.isa;
  row["render_ms"] = 1000 * result.seconds;
  // The first of all has to get its memory from the system.
  row["first_ms"] = anew.front(), row["anew_ms"] = median({anew.begin() + 1, anew.end()});
  row["read_ms"] = median(read), row["seen_ms"] = median(seen), row["kept_ms"] = median(kept);
  row["error"] = picture.relative_error;
  return row;
}

}  // namespace

Json measure_clean(const Settings& settings) {
  const int repeat = settings.repeat > 0 ? settings.repeat : settings.quick ? 5 : 15;
  Table table("Clean picture, 1280x720, two threads: milliseconds, median of " + std::to_string(repeat),
              {{"scene", "scene", -1, 22},
               {"spp", "spp", 0},
               {"render_ms", "rendered in", 0},
               {"first_ms", "first", 0},
               {"anew_ms", "scene anew", 0},
               {"kept_ms", "scene kept", 0},
               {"read_ms", "film read", 0},
               {"seen_ms", "first seen", 0},
               {"error", "error", 3}});
  for (const char* name :
       {"cornell-box", "cornell-smoke", "showroom", "next-week", "hollow-glass", "stress-medium-in-glass"})
    for (const std::uint32_t spp : {2u, 16u}) table.add(row_of(name, spp, repeat));
  return table.rows();
}

}  // namespace tyndall::bench
