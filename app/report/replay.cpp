#include "app/report/replay.h"

#include "app/report/names.h"
#include "core/base/random.h"

#include <fmt/core.h>

namespace tyndall {
namespace {

Vec3d exact(Vec3f v) { return {v.x, v.y, v.z}; }

std::string text_of(Vec3d v) { return fmt::format("{:.9g} {:.9g} {:.9g}", v.x, v.y, v.z); }

/// The paths of all media with a density, in the order in which they are compiled.
void list_media(const std::vector<Object>& objects, std::vector<int> path, std::vector<std::vector<int>>& out) {
  path.push_back(0);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    path.back() = static_cast<int>(i);
    if (const auto* group = std::get_if<Group>(&objects[i].kind)) list_media(group->objects, path, out);
    const auto* volume = std::get_if<Volume>(&objects[i].kind);
    if (volume && volume->medium.density > 0) out.push_back(path);
  }
}

std::string medium_text(const Scene& scene, int medium) {
  std::vector<std::vector<int>> media;
  list_media(scene.objects, {}, media);
  return object_text(scene, media[static_cast<std::size_t>(medium)]);
}

const char* fate_text(Fate fate) {
  switch (fate) {
    case Fate::goes_on:
      return "goes on";
    case Fate::ends_at_light:
      return "ends there";
    case Fate::escapes:
      return "escapes";
    case Fate::absorbed:
      return "is absorbed";
    case Fate::roulette:
      return "is ended by roulette";
    case Fate::cut:
      return "is cut at max_depth";
    case Fate::lost:
      return "is rejected, as a value is not a finite number";
  }
  return "";
}

std::string what_is_met(const Scene& scene, const RenderScene& compiled, const PathVertex& v) {
  return v.met == Met::medium ? "the medium " + medium_text(scene, v.medium)
                              : object_text(scene, compiled.object_of(v.element));
}

std::string heading(const Scene& scene, const RenderScene& compiled, const PathVertex& v) {
  const std::string fate = fate_text(v.fate);
  if (v.met == Met::nothing) return v.fate == Fate::escapes ? fate : "meets nothing, " + fate;
  const char* side = v.inside ? " on its inner side" : "";
  return fmt::format("after {:.9g} meets {}, {}{}", static_cast<double>(v.distance), what_is_met(scene, compiled, v),
                     fate, side);
}

}  // namespace

std::string vertex_text(const Scene& scene, const RenderScene& compiled, const PathVertex& vertex) {
  std::string fate = fate_text(vertex.fate);
  if (vertex.met == Met::nothing) return fate;
  return what_is_met(scene, compiled, vertex) + ", " + fate + (vertex.inside ? " on its inner side" : "");
}

std::string replay_text(const Scene& scene, const RenderScene& compiled, const PathReplay& path) {
  std::string text;
  const auto row = [&text](const char* name, Vec3d v) { text += std::string("    ") + name + text_of(v) + "\n"; };
  text += "0 camera\n";
  row("point       ", exact(path.origin) + compiled.origin);
  int number = 0;
  for (const PathVertex& v : path.vertices) {
    text += std::to_string(++number) + " " + heading(scene, compiled, v) + "\n";
    if (v.met != Met::nothing) row("point       ", exact(v.point) + compiled.origin);
    row("came by     ", exact(v.direction));
    row("throughput  ", exact(v.throughput));
    if (v.kept != 1)
      text += fmt::format("    by smoke    {:.3g} of what it carried before\n", static_cast<double>(v.kept));
    row("radiance    ", exact(v.radiance));
    if (!(v.by_specular_paths == Vec3f{})) row("by chains   ", exact(v.by_specular_paths));
    if (v.chance < 1)
      text += fmt::format("    by chance   this lamp counts {:.3g}, as chains find it, too\n",
                          static_cast<double>(v.chance));
    text += "    dimensions  " + std::to_string(v.first_dimension) + " to " +
            std::to_string(v.first_dimension + dimension::per_event - 1) + "\n";
  }
  if (path.reused)
    text +=
        "shared: instead of what comes by way of its own second vertex, the sample takes a part of what leaves "
        "those of eight pixels\n";
  return text + "sample " + text_of(exact(path.radiance)) + "\n";
}

}  // namespace tyndall
