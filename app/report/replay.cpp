#include "app/report/replay.h"

#include "app/report/contents.h"
#include "core/base/random.h"
#include "core/base/text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tyndall {
namespace {

std::string text_of(Vec3d v) { return fmt::format("{:.9g} {:.9g} {:.9g}", v.x, v.y, v.z); }

/// In the order of Fate.
constexpr const char* fates[] = {"goes on",
                                 "ends there",
                                 "escapes",
                                 "is absorbed",
                                 "is ended by roulette",
                                 "is cut at max_depth",
                                 "is rejected, as a value is not a finite number"};
static_assert(std::size(fates) == static_cast<std::size_t>(Fate::lost) + 1);

double luminance(Vec3f light) {
  const double sum = dot(to_double(light), Vec3d{0.2126, 0.7152, 0.0722});
  return std::isfinite(sum) ? sum : 0;
}

/// What a path met at one place and what became of it there, in a few words: "ball (gold), goes on".
std::string vertex_text(const Scene& scene, const RenderScene& compiled, const PathVertex& vertex) {
  std::string fate = fates[static_cast<std::size_t>(vertex.fate)];
  if (vertex.met == Met::nothing) return fate;
  const std::string met =
      vertex.met == Met::medium
          ? "the medium " + object_text(scene, media_of(scene)[static_cast<std::size_t>(vertex.medium)])
          : object_text(scene, compiled.object_of(vertex.element));
  return met + ", " + fate + (vertex.inside ? " on its inner side" : "");
}

std::string heading(const Scene& scene, const RenderScene& compiled, const PathVertex& v) {
  const std::string text = vertex_text(scene, compiled, v);
  if (v.met == Met::nothing) return (v.fate == Fate::escapes ? "" : "meets nothing, ") + text;
  return fmt::format("after {:.9g} meets {}", static_cast<double>(v.distance), text);
}

/// "branch from 2: " where a branch begins, which leaves glass where vertex 2 is; else nothing.
std::string branch_text(const PathVertex& v) { return v.branch ? fmt::format("branch from {}: ", v.before + 1) : ""; }

}  // namespace

std::vector<std::vector<int>> media_of(const Scene& scene) {
  std::vector<std::vector<int>> media;
  for (const ObjectPath& path : leaves(scene)) {
    const auto* volume = std::get_if<Volume>(&find_object(scene, path)->kind);
    if (volume && volume->medium.density > 0) media.push_back(path);
  }
  return media;
}

std::string object_text(const Scene& scene, const std::vector<int>& path) {
  const Object& object = *find_object(scene, path);
  std::string name = object.name.empty() ? "" : in_quotes(object.name);
  for (std::size_t k = 0; k < path.size() && object.name.empty(); ++k) name += "/objects/" + std::to_string(path[k]);
  const auto* solid = std::get_if<Solid3d>(&object.kind);
  if (!solid) return printable(name);
  return printable(name + " (" + scene.materials[static_cast<std::size_t>(solid->material)].name + ")");
}

std::string replay_text(const Scene& scene, const RenderScene& compiled, const PathReplay& path) {
  std::string text = "0 camera\n";
  const auto row = [&text](const char* name, const std::string& is) {
    text += fmt::format("    {:<12}{}\n", name, is);
  };
  row("point", text_of(to_double(path.origin) + compiled.origin));
  int number = 0;
  for (const PathVertex& v : path.vertices) {
    text += std::to_string(++number) + " " + branch_text(v) + heading(scene, compiled, v) + "\n";
    if (v.met != Met::nothing) row("point", text_of(to_double(v.point) + compiled.origin));
    row("came by", text_of(to_double(v.direction)));
    row("throughput", text_of(to_double(v.throughput)));
    if (v.kept != 1) row("by smoke", fmt::format("{:.3g} of what it carried before", static_cast<double>(v.kept)));
    row("radiance", text_of(to_double(v.radiance)));
    if (!(v.by_specular_paths == Vec3f{})) row("by chains", text_of(to_double(v.by_specular_paths)));
    if (v.chance < 1)
      row("by chance", fmt::format("this lamp counts {:.3g}, as chains find it, too", static_cast<double>(v.chance)));
    row("dimensions", fmt::format("{} to {}", v.first_dimension, v.first_dimension + dimension::per_event - 1));
  }
  if (path.reused)
    text +=
        "shared: instead of what comes by way of its own second vertex, the sample takes a part of what leaves "
        "those of eight pixels\n";
  return text + "sample " + text_of(to_double(path.radiance)) + "\n";
}

NoisyPath find_noisy_path(const SceneView& scene, int x, int y, std::uint32_t samples,
                          const std::function<bool()>& stop) {
  NoisyPath found{.x = x, .y = y};
  double sum = 0, maximum = -1;
  while (found.samples < std::max(samples, 1u) && (found.samples == 0 || !stop())) {
    PathReplay path = replay(scene, x, y, found.samples);
    const double light = luminance(path.radiance);
    sum += light;
    if (light > maximum) maximum = light, found.sample = found.samples, found.path = std::move(path);
    ++found.samples;
  }
  found.fraction = sum > 0 ? maximum / sum : 0;
  found.times_mean = found.fraction * found.samples;
  return found;
}

std::vector<PathStop> stops_of(const Scene& scene, const RenderScene& compiled, const PathReplay& path) {
  std::vector<PathStop> stops;
  for (const PathVertex& v : path.vertices) {
    const bool away = v.met == Met::nothing, continues = v.before >= 0 && !v.branch;
    const Vec3f gained =
        v.radiance - (continues ? path.vertices[static_cast<std::size_t>(v.before)].radiance : Vec3f{});
    PathStop stop{away ? to_double(v.direction) : to_double(v.point) + compiled.origin, v.before, away,
                  branch_text(v) + vertex_text(scene, compiled, v), luminance(gained) > 0};
    if (stop.light)
      stop.text += fmt::format(", light {:.3g} {:.3g} {:.3g}", static_cast<double>(gained.x),
                               static_cast<double>(gained.y), static_cast<double>(gained.z));
    stops.push_back(std::move(stop));
  }
  return stops;
}

std::string sentence_of(const NoisyPath& found) {
  if (found.fraction <= 0) return fmt::format("all of {} samples are black", found.samples);
  return fmt::format("the brightest of {} samples: {:.2g} % of their light, {:.2g} times the mean", found.samples,
                     100 * found.fraction, found.times_mean);
}

}  // namespace tyndall
