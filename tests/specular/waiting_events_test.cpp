#include "tests/specular/waiting_events.h"

#include "tests/support/mixed_scene.h"
#include "tests/support/random_glass.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <string>
#include <tyndall_targets.h>
#include <vector>

/// What an event gets from specular light paths is a function of the event and the scene alone, to the last bit: not of
/// the events that happened to wait beside it.
namespace tyndall::test::waiting_events_test {

namespace {

/// Null for the scalar target: its kernels have one lane, so that nothing waits.
LightOfEvents function_for(Target target) {
  return use_target<TYNDALL_BUILT_TARGETS>(target, [](auto built) -> LightOfEvents {
    if constexpr (built() == Target::scalar)
      return nullptr;
    else
      return light_of_events_for<built()>;
  });
}

std::vector<WaitingEvent> random_events(Engine& engine, const RenderScene& scene, int count) {
  std::vector<WaitingEvent> events;
  for (int i = 0; i < count; ++i) {
    const Vec3d place = Vec3d{0, 1.5, 0} + in_cube(engine, 1.5) + in_cube(engine, 2);
    const Vec3f at = rounded(place - scene.origin), heading = unit_vector(direction(engine));
    const bool in_medium = engine() % 4 == 0;
    const auto random_bits = [&] { return static_cast<std::int32_t>(engine()); };
    events.push_back({{at.x, at.y, at.z, heading.x, heading.y, heading.z, 1, 0.5f, 0.25f,
                       static_cast<float>(uniform(engine, 0, 1)), static_cast<float>(uniform(engine, -0.5, 0.5))},
                      {from_nowhere, 1, 0, random_bits(), random_bits(), random_bits(), in_medium}});
  }
  return events;
}

bool same_bits(Vec3f a, Vec3f b) {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  return bits(a.x) == bits(b.x) && bits(a.y) == bits(b.y) && bits(a.z) == bits(b.z);
}

struct Found {
  int events = 0, lit = 0, differ = 0;
};

/// Compares events alone with the same events in groups, twice in random order.
void compare_with_groups(LightOfEvents find, unsigned seed, int count, Found& found) {
  Engine engine(seed);
  const RenderScene scene = compile(RandomGlass(seed).scene(32, 18));
  const SceneViewOf view(scene);
  if (!view.view().has_specular_paths()) return;
  std::vector<WaitingEvent> events = random_events(engine, scene, count);
  std::vector<Vec3f> alone(events.size()), together(events.size());
  find(view.view(), events.data(), count, 1, alone.data());
  for (int round = 0; round < 2; ++round) {
    std::vector<std::size_t> order(events.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), engine);
    std::vector<WaitingEvent> shuffled;
    for (const std::size_t i : order) shuffled.push_back(events[i]);
    std::fill(together.begin(), together.end(), Vec3f{0, 0, 0});
    find(view.view(), shuffled.data(), count, 32 - 5 * round, together.data());
    for (std::size_t i = 0; i < order.size(); ++i) found.differ += same_bits(together[i], alone[order[i]]) ? 0 : 1;
  }
  found.events += count;
  found.lit += static_cast<int>(std::count_if(alone.begin(), alone.end(), [](Vec3f c) { return c.x > 0; }));
}

}  // namespace

TEST_CASE("waiting events: each gets the same light beside any others as alone") {
  for (const Target target : available_targets()) {
    const LightOfEvents find = function_for(target);
    if (!find) continue;
    CAPTURE(std::string(name_of(target)));
    Found found;
    for (unsigned seed = 1; seed <= 60; ++seed) compare_with_groups(find, seed, 600, found);
    CHECK(found.differ == 0);
    CHECK(found.events > 20000);
    CHECK(found.lit > found.events / 20);
  }
}

}  // namespace tyndall::test::waiting_events_test
