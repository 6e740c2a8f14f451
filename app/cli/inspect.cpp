#include "app/cli/pictures.h"
#include "app/report/contents.h"
#include "app/report/gain.h"
#include "app/report/replay.h"
#include "app/text/standard_streams.h"
#include "core/base/target.h"
#include "core/base/text.h"
#include "core/compile/compile.h"
#include "core/film/film.h"
#include "core/guide/find_guide.h"
#include "core/render/prepare.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace tyndall {
namespace {

using Json = nlohmann::ordered_json;

/// A scene, and what is told of it. Its JSON moves without exceptions, though it does not say so.
struct Report {  // NOLINT(bugprone-exception-escape)
  LoadedScene loaded;
  Contents contents = contents_of(loaded.scene);
  std::shared_ptr<const PreparedScene> prepared = prepare(loaded.scene);
  const Scene& scene = loaded.scene;
  const RenderScene& columns = prepared->columns();
  std::string table{};
  Json json{};

  /// A row of the table, and members of the JSON object. name: "" for a further line of the row above.
  void add(const char* name, const std::string& row, const Json& members = Json::object()) {
    table += fmt::format("{:<12}{}\n", name, row);
    json.update(members);
  }
  /// What a method gains, where that is measured. key: of the JSON.
  void add_gain(const char* key, MisMethod method, const Kernels& kernels) {
    const MethodGain gain = measure_method_gain(method, scene, kernels.isa);
    constexpr const char* row =
        "a sample takes {:.2f} times as long, and at equal time the squared error is {:.2g} times that without";
    if (gain.measured)
      add("", fmt::format(row, gain.time, gain.error), {{key, {{"time", gain.time}, {"squared_error", gain.error}}}});
  }
};

/// "1 box", "2 boxes".
std::string counted(int count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : noun.back() == 'x' ? "es" : "s");
}

std::string listed(const std::map<std::string, int>& counts, bool nouns) {
  std::vector<std::string> texts;
  for (const auto& [type, count] : counts)
    texts.push_back(nouns ? counted(count, type) : std::to_string(count) + " " + type);
  return texts.empty() ? "none" : joined(texts);
}

/// The objects that elements belong to, the first few by name.
std::string named(const Report& report, const auto& elements) {
  constexpr std::size_t maximum = 3;
  std::vector<std::string> names;
  for (const auto element : elements)
    if (names.size() < maximum) names.push_back(object_text(report.scene, report.columns.object_of(element)));
  return joined(names) + (elements.size() > maximum ? ", ..." : "");
}

/// Why a scene has no chains, and so neither splitting nor a guide; null: its settings allow them.
const char* no_caustics_text(const RenderSettings& render) {
  if (render.caustics == Caustics::scatter) return "none: caustics are left to scattering";
  if (render.integrator != Integrator::mis) return "none: they are a part of integrator mis";
  return render.fresnel == FresnelKind::exact ? nullptr : "none: they need exact Fresnel";
}

/// What exact chains are looked for.
std::string specular_paths_text(const Report& report) {
  if (const char* off = no_caustics_text(report.scene.render)) return off;
  const SpecularPairs& specular = report.columns.specular;
  const bool outlined = report.columns.features.triangles || report.columns.features.disks;
  if (specular.sphere.empty())
    return std::string("none: no lamp that is small as seen from a ball of glass, a mirror or a pane") +
           (outlined ? "; triangles and disks of metal are no such mirrors, but left to BSDF sampling" : "");
  const int flat = specular.first_slab - specular.first_mirror;
  const int slabs = static_cast<int>(specular.index.size()) - specular.first_slab;
  const int mirrors = static_cast<int>(std::count(specular.index.begin(), specular.index.end(), 0)) - flat;
  const int shells = static_cast<int>(std::ranges::count_if(specular.inner_radius, [](auto r) { return r > 0; }));
  const std::pair<int, const char*> kinds[] = {{mirrors, "mirror ball"},
                                               {specular.first_mirror - mirrors - shells, "glass ball"},
                                               {shells, "glass shell"},
                                               {flat, "flat mirror"},
                                               {slabs, "pane"}};
  std::string text;
  for (const auto& [count, noun] : kinds)
    if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, noun);
  const std::set<std::int32_t> found(specular.light.begin(), specular.light.end());
  const bool sun = *found.begin() < 0;
  std::vector<std::int32_t> lights;
  for (const std::int32_t light : found)
    if (light >= 0) lights.push_back(report.columns.lights.element[static_cast<std::size_t>(light)]);
  const std::string to_lights =
      lights.empty() ? "" : counted(static_cast<int>(lights.size()), "lamp") + " (" + named(report, lights) + ")";
  return text + " (" + named(report, specular.outer) + "), each alone, to " + to_lights +
         (sun ? std::string(to_lights.empty() ? "" : " and, but for flat mirrors and panes, to ") + "the sun of the sky"
              : "") +
         "; with both ends within one ball or shell, too; by chance: ways over two of them, quads of glass, other "
         "boxes of glass, " +
         (outlined ? "triangles and disks of glass or metal (as lamps they take part), " : "") + "and fuzzy metal";
}

/// Where paths follow both ways.
std::string splitting_text(const Report& report) {
  if (const char* off = no_caustics_text(report.scene.render)) return off;
  if (!report.columns.splits_paths) return "none: no glass";
  return fmt::format(
      "on: the first {} events at glass that the camera sees, directly or by glass and mirrors, follow reflection and "
      "transmission both; other events at glass one of them at random",
      max_splits);
}

/// Whether light is guided over several near-specular surfaces.
std::string guide_text(const Report& report) {
  const Guide& guide = report.prepared->guide();
  if (no_caustics_text(report.scene.render)) return "none: a part of chains, which are off";
  if (report.columns.sky.pixels) return "none: under a picture of the sky light is not guided";
  if (guide.light_paths == 0) return "none: no lamp, or nothing that is almost a mirror or glass beside something matt";
  const std::string variance =
      fmt::format("by {} light paths, the light that chance alone would have to find has a variance of {:.2g} a sample",
                  guide.light_paths, guide.expected_variance);
  if (guide.lobes() == 0) return "none: " + variance + fmt::format("; it pays from {} on", worthwhile_variance);
  return fmt::format("{} lobes, made in {:.0f} ms; ", guide.lobes(), guide.milliseconds) + variance;
}

/// Whether second vertices are shared between pixels.
std::string sharing_text(const Report& report) {
  if (!report.scene.render.sharing) return "off";
  if (report.scene.render.integrator != Integrator::mis) return "none: it is a part of integrator mis";
  if (report.columns.features.moving_spheres) return "none: spheres move";
  if (report.prepared->guide().lobes() > 0) return "none: light is guided";
  const ReuseGain& gain = report.prepared->reuse_gain();
  if (!gain.probed) return "none: too few paths scatter evenly at their first two vertices";
  const std::string probe = fmt::format("a probe finds {:.2g} times the variance of a sample in {:.2g} times the time",
                                        gain.variance, gain.time);
  if (is_worthwhile(gain)) return "on: " + probe;
  return "none: " + probe + fmt::format("; it pays where the product is at most {}", worthwhile_product);
}

/// The background, and how integrators find the light of a picture.
std::string background_text(const Report& report) {
  const auto* sky = std::get_if<SkyPicture>(&report.scene.background);
  if (!sky) return report.contents.background;
  const std::string text = fmt::format("{} {} ({}x{})", report.contents.background, printable(sky->file),
                                       sky->pixels->width, sky->pixels->height);
  if (!report.columns.sky.is_sampled()) return text + ", found by chance";
  return fmt::format(
      "{}, sampled as a light; as bright as if its light filled {:.2g} of all directions; by chance: through and off "
      "glass and mirrors{}",
      text, report.columns.sky.distribution.spread,
      report.columns.specular.sun_pair_of.empty() ? "" : ", but for what chains find");
}

std::string bytes_text(std::size_t bytes) {
  const auto number = static_cast<double>(bytes);
  return bytes < 100'000 ? fmt::format("{:.1f} kB", number / 1e3) : fmt::format("{:.1f} MB", number / 1e6);
}

std::string gain_text(const KernelGain& gain) {
  if (gain.pairs == 0) return gain.isa + ": renders this scene by the full kernel itself, so there is nothing to gain";
  return fmt::format("{}: {:.2f} times as fast as the full kernel ({:.2f} to {:.2f} in {} pairs), {}", gain.isa,
                     gain.gain, gain.minimum, gain.maximum, gain.pairs,
                     gain.same_picture ? "bit for bit the same picture" : "ANOTHER PICTURE: a bug");
}

/// What the scene's file says.
void add_contents(Report& report) {
  const Scene& scene = report.scene;
  const Contents& c = report.contents;
  const std::vector<std::string> comments = leading_comments(report.loaded.text);
  report.table = printable(report.loaded.name) + (scene.name.empty() ? "" : ": " + printable(scene.name)) + "\n";
  for (const std::string& line : comments) report.table += "  " + printable(line) + "\n";
  report.json = {{"scene", report.loaded.name}, {"name", scene.name}, {"comments", comments}};
  const auto& spp = scene.render.spp;
  report.add("image",
             fmt::format("{}x{}, {}max depth {}", scene.width, scene.height, spp ? fmt::format("{} spp, ", *spp) : "",
                         scene.render.max_depth),
             {{"width", scene.width},
              {"height", scene.height},
              {"spp", spp ? Json(*spp) : Json()},
              {"max_depth", scene.render.max_depth}});
  report.add("shapes", listed(c.shapes, true), {{"shapes", c.shapes}});
  report.add("materials", listed(c.materials, false), {{"materials", c.materials}});
  report.add("textures", listed(c.textures, false), {{"textures", c.textures}});
  if (!c.with_alpha.empty()) report.add("", alpha_note(c.with_alpha));
  const std::string lobes = c.phase_functions == 0 ? "" : fmt::format(", {} with g not 0", c.phase_functions);
  report.add("media", c.media == 0 ? "none" : std::to_string(c.media) + lobes,
             {{"media", c.media}, {"phase_functions", c.phase_functions}});
  report.add("lights", c.lights == 0 ? "none" : counted(c.lights, "emitting primitive"), {{"lights", c.lights}});
}

/// How it is rendered. kernels: of the instruction set that was asked for, else the best. Whether the scene's own
/// kernel makes the picture of the full one, if that is measured.
bool add_methods(Report& report, const Kernels& kernels, bool measure) {
  const Contents& c = report.contents;
  const RenderScene& columns = report.columns;
  const Guide& guide = report.prepared->guide();
  report.add(
      "chains", specular_paths_text(report),
      {{"chains", columns.specular.sphere.size()}, {"guide_lobes", guide.lobes()}, {"guide_ms", guide.milliseconds}});
  if (measure) report.add_gain("chain_gain", MisMethod::specular, kernels);
  report.add("guide", guide_text(report));
  report.add("splitting", splitting_text(report), {{"splitting", columns.splits_paths}});
  if (measure) report.add_gain("splitting_gain", MisMethod::splitting, kernels);
  report.add("sharing", sharing_text(report));
  if (measure) report.add_gain("sharing_gain", MisMethod::sharing, kernels);
  report.add("background", background_text(report), {{"background", c.background}});
  report.add("motion", c.motion ? "yes" : "no", {{"motion", c.motion}});
  report.add("defocus", c.defocus ? "yes" : "no", {{"defocus", c.defocus}});
  const bool in_tree = !columns.bvh.nodes.empty();
  report.add("primitives",
             std::to_string(columns.primitives()) + (in_tree ? ", in a tree" : ", each tested for every ray"),
             {{"primitives", columns.primitives()}, {"tree", in_tree}});
  const auto models = names_of(columns.features);
  report.add("models", joined(models), {{"kernel_features", models}});
  const char* kernel = name_of(kernels.set_for(report.prepared->view()));
  report.add("kernel", kernel, {{"kernel", kernel}});
  Json built;
  for (const Target target : built_targets()) built.push_back(name_of(target));
  report.add("runs", fmt::format("{} (built: {})", kernels.isa, names_of(built_targets())),
             {{"isa", kernels.isa}, {"built_sets", built}});
  const KernelGain gain = measure ? measure_kernel_gain(*report.prepared, kernels) : KernelGain{};
  if (measure)
    report.add("", gain_text(gain),
               {{"kernel_gain",
                 {{"isa", gain.isa},
                  {"gain", gain.gain},
                  {"least", gain.minimum},
                  {"most", gain.maximum},
                  {"pairs", gain.pairs},
                  {"same_picture", gain.same_picture}}}});
  const std::size_t bytes = bytes_of(columns);
  const std::size_t film_bytes = bytes_per_pixel(needs_trait<&BsdfTraits::emits>(columns.features)) *
                                 static_cast<std::size_t>(columns.width) * static_cast<std::size_t>(columns.height);
  report.add("memory", "scene " + bytes_text(bytes) + ", film " + bytes_text(film_bytes),
             {{"scene_bytes", bytes}, {"film_bytes", film_bytes}, {"textures_with_alpha", c.with_alpha}});
  return gain.same_picture;
}

}  // namespace

int run_inspect(const CommandRequest& command) {
  Report report{open_scene(command.scene)};
  add_contents(report);
  const bool same_picture = add_methods(report, find_kernels(command.isa), command.measure);
  write_standard_output(command.json ? report.json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"
                                     : report.table);
  return same_picture ? 0 : 1;
}

}  // namespace tyndall
