#include "core/files/film_files.h"

#include "core/base/error.h"
#include "core/base/seconds.h"
#include "core/base/target.h"
#include "core/base/text.h"
#include "core/compile/compile.h"
#include "core/render/clean_film.h"
#include "core/render/plan.h"
#include "core/scene/json_tree.h"
#include "core/scene/load.h"
#include "core/scene/place.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <variant>

namespace tyndall {
namespace {

/// The scene with everything at its default that changes no sample: names, display, number of samples; and without the
/// pixels of its pictures, of which labels have the hash.
Scene stripped(Scene scene) {
  scene.name.clear();
  scene.display = {};
  scene.animation.reset();
  scene.render.spp.reset();
  each_picture(scene, [](auto& picture) { picture.file.clear(), picture.pixels.reset(); });
  return scene;
}

/// Whether there is light that RenderSettings::caustics says how to find.
bool caustics_matter(Scene scene) {
  scene.render.caustics = Caustics::chains;
  const auto prepared = prepare(scene);
  const RenderScene& columns = prepared->columns();
  return !columns.specular.sphere.empty() || columns.splits_paths || prepared->guide().lobes() > 0;
}

bool could_reuse_paths(Scene scene) {
  scene.render.sharing = true;
  return prepare(scene)->reuses_paths();
}

/// Whether the samples of both scenes are the same if the pixels of their pictures are.
bool same_scene(const Scene& film, const Scene& requested) {
  const Scene a = stripped(film);
  Scene b = stripped(requested);
  const bool other_caustics = a.render.caustics != b.render.caustics;
  const bool other_sharing = a.render.sharing != b.render.sharing;
  b.render.caustics = a.render.caustics, b.render.sharing = a.render.sharing;
  if (!(a == b)) return false;
  return !(other_caustics && caustics_matter(film)) && !(other_sharing && could_reuse_paths(film));
}

/// The first setting that differs, such as "other settings (seed 0)", expected "seed 9".
std::optional<Mismatch> differing_setting(const RenderSettings& film, const RenderSettings& requested) {
  std::optional<Mismatch> first;
  for_each_field(fields_of<RenderSettings>(), [&](const auto& field) {
    const std::string a = setting_text(film.*field.value), b = setting_text(requested.*field.value);
    if (first || a == b || std::string_view(field.name) == "spp") return;
    const std::string name = std::string(field.name) + " ";
    first = Mismatch{"a film of other settings (" + name + a + ")", name + b};
  });
  return first;
}

Film found_film(const std::filesystem::path& file, std::optional<Film> film) {
  if (!film) throw UsageError(file.string() + ": found no film, expected an EXR that 'tyndall render' wrote");
  return std::move(*film);
}

FilmLabel label_of(const std::filesystem::path& file) {
  FilmLabel label = read_film_label(file).value_or(FilmLabel{});
  if (!label.version.empty() || !label.isa.empty()) return label;
  const std::string stats = read_embedded_stats(file).value_or("");
  if (stats.empty()) return label;
  try {
    const JsonDocument json = parse_json(stats);
    label.version = text_of(find(&json.root, "version")), label.isa = text_of(find(&json.root, "isa"));
  } catch (const ParseError&) {
    return label;  // another program has changed the text
  }
  return label;
}

StoredFilm with_scene(const std::filesystem::path& file, Film film) {
  LoadedScene loaded = load_scene(file.string());
  Scene scene = move_textures(loaded.scene, loaded.folder, ".");
  // Films from before there was a choice do not say these settings: they left caustics to chance, and shared nothing.
  const JsonDocument json = parse_json(loaded.text);
  const JsonValue* render = find(&json.root, "render");
  if (!find(render, "caustics")) scene.render.caustics = Caustics::scatter;
  if (!find(render, "sharing")) scene.render.sharing = false;
  return {{file.string(), std::move(film)}, scene, label_of(file), contents_remark(loaded)};
}

constexpr std::string_view several = "several: ";

/// The names in one text of a label, which is a name or what both_of() made of several.
std::set<std::string> names_in(std::string_view text) {
  std::set<std::string> names;
  if (text.starts_with(several)) text.remove_prefix(several.size());
  for (;;) {
    const std::size_t comma = text.find(", ");
    names.emplace(text.empty() ? "unknown" : text.substr(0, comma));
    if (comma == text.npos) return names;
    text.remove_prefix(comma + 2);
  }
}

std::string both_of(const std::string& a, const std::string& b) {
  if (a == b) return a;
  std::set<std::string> names = names_in(a);
  names.merge(names_in(b));
  if (names.size() == 1) return *names.begin();
  return std::string(several) + joined({names.begin(), names.end()});
}

/// Layers of an EXR: those of the scene and, if there is one, the clean view with its error.
std::vector<Layer> all_layers(const Picture& picture) {
  std::vector<Layer> layers;
  if (picture.layers) layers = picture.layers();
  if (!picture.clean) return layers;
  Layer clean{"denoised", {"R", "G", "B", "error"}, {}};
  clean.values.reserve(4 * picture.clean->pixel_error.size());
  for (std::size_t i = 0; i < picture.clean->pixel_error.size(); ++i) {
    const float* rgb = picture.clean->rgb.data() + 3 * i;
    clean.values.insert(clean.values.end(), {rgb[0], rgb[1], rgb[2], picture.clean->pixel_error[i]});
  }
  layers.push_back(std::move(clean));
  return layers;
}

/// What files of one picture show.
LinearImage shown(const Picture& picture) {
  if (!picture.clean) return picture.image;
  return {picture.clean->width, picture.clean->height, picture.clean->rgb};
}

}  // namespace

Film read_film_alone(const std::filesystem::path& file) { return found_film(file, read_film(file)); }
StoredFilm read_stored_film(const std::filesystem::path& file) { return with_scene(file, read_film_alone(file)); }
StoredFilm read_stored_frame(const std::filesystem::path& file) {
  return with_scene(file, found_film(file, read_film_frame(file)));
}

FilmLabel label_for(const Scene& scene, const std::string& isa, bool unfinished) {
  return {TYNDALL_VERSION, isa, unfinished, contents_hash(scene)};
}

std::optional<Mismatch> differing_samples(const Scene& film, const FilmLabel& label, const Scene& requested,
                                          const FilmLabel& requested_label) {
  const auto size = [](const Scene& s) { return std::to_string(s.width) + "x" + std::to_string(s.height); };
  if (size(film) != size(requested)) return Mismatch{"a film of another image size, " + size(film), size(requested)};
  if (!same_scene(film, requested))
    return differing_setting(film.render, requested.render)
        .value_or(Mismatch{"a film of another scene", "the same scene"});
  const auto contents = [](const Scene& s, const FilmLabel& l) {
    return l.contents.empty() ? contents_hash(s) : l.contents;
  };
  if (contents(film, label) != contents(requested, requested_label))
    return Mismatch{"a film of other pixels in its textures or sky", "the same pixels"};
  const auto differs = [](const std::string& a, const std::string& b) { return !a.empty() && !b.empty() && a != b; };
  if (differs(label.version, requested_label.version))
    return Mismatch{"a film of version " + label.version, requested_label.version};
  if (differs(label.isa, requested_label.isa))
    return Mismatch{"a film of instruction set " + label.isa, requested_label.isa + how_to_build(label.isa)};
  return {};
}

std::string embedded_scene(Scene scene, const std::filesystem::path& textures, const Film& film,
                           const std::filesystem::path& image) {
  scene.render.spp = static_cast<int>(std::clamp(labelled_spp(film), 1u, max_samples));
  const std::string caustics = name_of(scene.render.caustics), sharing = scene.render.sharing ? "true" : "false";
  JsonValue json = scene_json(move_textures(std::move(scene), textures, image.parent_path()));
  apply_override(json, {"/render/caustics", caustics});
  apply_override(json, {"/render/sharing", sharing});
  return print_json(json);
}

std::string uneven_text(const Scene& scene, const FilmTotals& totals) {
  if (scene.render.adaptive || totals.min_taken == totals.max_taken) return "";
  return "the pixels have " + std::to_string(totals.min_taken) + " to " + std::to_string(totals.max_taken) +
         " samples, as the render was interrupted within a pass" +
         (totals.min_taken > 0 ? "" : "; those with none are black");
}

FilmLabel merged_label(const FilmLabel& a, const FilmLabel& b) {
  return {both_of(a.version, b.version), both_of(a.isa, b.isa), a.unfinished || b.unfinished,
          a.contents == b.contents ? a.contents : ""};
}

CleanOfFilm clean_view(const Film& film, const Scene& scene, const std::string& file, int threads,
                       const std::string& isa) {
  if (totals(film).min_taken < min_clean_spp)
    throw UsageError(file + ": found pixels with fewer than " + std::to_string(min_clean_spp) +
                     " samples, expected at least that many in each: the filter compares two halves of them");
  const std::shared_ptr<const PreparedScene> prepared = prepare(scene);
  const auto start = std::chrono::steady_clock::now();
  CleanOfFilm clean{clean_film(film, *prepared, threads, isa)};
  clean.seconds = seconds_since(start);
  return clean;
}

bool is_exr(const std::filesystem::path& file) { return image_ending(file, {}) == ".exr"; }

std::string image_ending(const std::filesystem::path& file, const ImageForm& form) {
  return lower_case(file == "-" ? "." + form.format : file.extension().string());
}

void write_picture(const Picture& picture, const std::string& kind, const std::filesystem::path& file) {
  const Display& display = picture.display;
  const Region& region = picture.film.region;
  const auto dither = display.dither ? std::optional(DitherOrigin{region.x0, region.y0}) : std::nullopt;
  if (kind == ".exr") {
    Embedded embedded = picture.embedded(file);
    embedded.film = picture.form.exr_film;
    write_exr(file, picture.film, all_layers(picture), embedded, &picture.image);
  } else if (kind == ".png")
    write_png(file, shown(picture), display.exposure, display.tone_map, picture.embedded(file), dither);
  else if (kind == ".ppm")
    write_ppm(file, shown(picture), display.exposure, display.tone_map, picture.form.ppm, dither);
  else if (kind == ".pfm")
    write_pfm(file, shown(picture));
  else
    write_hdr(file, shown(picture));
}

void write_picture(const Picture& picture, const std::filesystem::path& file) {
  const std::string kind = image_ending(file, picture.form);
  if (!is_image_output(file) || (kind == ".exr" && !has_openexr()))
    throw UsageError(file.string() + ": found this name, expected one that ends in .png, .exr, .pfm, .hdr or .ppm" +
                     (has_openexr() ? "" : "; .exr not, as this build has no OpenEXR"));
  write_picture(picture, kind, file);
}

}  // namespace tyndall
