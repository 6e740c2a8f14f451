#include "app/window/document/document.h"

#include "app/files/outputs.h"
#include "app/text/numbers.h"
#include "core/base/fnv1a.h"
#include "core/base/text.h"
#include "core/files/film_files.h"
#include "core/image/image_io.h"
#include "core/image/image_io_file.h"
#include "core/scene/frames.h"
#include "core/scene/json_tree.h"
#include "core/scene/place.h"
#include "core/targets/kernels.h"

#include <algorithm>
#include <exception>
#include <fstream>
#include <iterator>

namespace tyndall {

namespace {

using Objects = std::vector<Object>;

/// The index of the object in `after` that equals before[from]; of several equal ones, that with the same number.
std::optional<std::size_t> equal_object(const Objects& before, const Objects& after, std::size_t from) {
  const Object& object = before[from];
  if (from < after.size() && after[from] == object) return from;
  auto number = std::count(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(from), object);
  for (std::size_t k = 0; k < after.size(); ++k)
    if (after[k] == object && number-- == 0) return k;
  return {};
}

/// The index of an object in another state of its list; nothing: it is gone.
std::optional<std::size_t> index_after(const Objects& before, const Objects& after, std::size_t from) {
  if (const auto equal = equal_object(before, after, from)) return equal;
  const std::string& name = before[from].name;
  const auto has_name = [&](const Object& object) { return object.name == name; };
  const auto named = std::find_if(after.begin(), after.end(), has_name);
  if (!name.empty() && named != after.end()) return named - after.begin();
  if (before.size() == after.size()) return from;
  if (!name.empty() || std::find(after.begin(), after.end(), before[from]) != after.end()) return {};
  // The list grew or shrank, so what stands before and behind that place is still the same.
  const auto [was, is] = std::mismatch(before.begin(), before.end(), after.begin(), after.end());
  if (from < static_cast<std::size_t>(was - before.begin())) return from;
  const auto same_end =
      std::mismatch(before.rbegin(), std::make_reverse_iterator(was), after.rbegin(), std::make_reverse_iterator(is))
          .first -
      before.rbegin();
  if (from + static_cast<std::size_t>(same_end) < before.size()) return {};
  return from + after.size() - before.size();
}

ObjectPath path_after(const Objects& before, const Objects& after, const ObjectPath& path, std::size_t level = 0) {
  const auto from = static_cast<std::size_t>(path[level]);
  const auto to = index_after(before, after, from);
  if (!to) return {};
  ObjectPath found{static_cast<int>(*to)};
  if (level + 1 == path.size()) return found;
  const Group *was = std::get_if<Group>(&before[from].kind), *is = std::get_if<Group>(&after[*to].kind);
  const ObjectPath rest = was && is ? path_after(was->objects, is->objects, path, level + 1) : ObjectPath{};
  if (rest.empty()) return {};
  found.insert(found.end(), rest.begin(), rest.end());
  return found;
}

/// Whether some value that has keys could have moved or gone: objects or kinds of materials are others.
bool has_other_things(const Scene& before, const Scene& after) {
  const auto kinds_of = [](const Scene& scene) {
    std::vector<std::size_t> kinds;
    for (const Material& material : scene.materials) kinds.push_back(material.kind.index());
    return kinds;
  };
  return !(before.objects == after.objects) || kinds_of(before) != kinds_of(after) ||
         before.background.index() != after.background.index();
}

/// The steps of a pointer that lead to an object, as its path: those of "/objects/3/objects/0/radius" are {3, 0}.
ObjectPath object_of(const std::vector<std::string>& steps) {
  ObjectPath path;
  for (std::size_t k = 0; k + 1 < steps.size() && steps[k] == "objects"; k += 2)
    path.push_back(std::atoi(steps[k + 1].c_str()));
  return path;
}

namespace fs = std::filesystem;

/// What opens the same scene again from any folder.
std::string what_opens(const LoadedScene& loaded) {
  if (!loaded.source.empty()) return fs::absolute(loaded.source).lexically_normal().string();
  if (loaded.name == "-") return "";
  const bool built_in = !fs::path(loaded.name).has_extension();
  return built_in ? loaded.name : fs::absolute(loaded.name).lexically_normal().string();
}

/// Whether a film has all pixels of the scene's picture, from the first sample on.
bool is_whole(const Film& film, const Scene& scene) {
  return film.region == Region{0, 0, scene.width, scene.height} && film.width == scene.width &&
         film.height == scene.height && film.first_sample == 0;
}

/// The text, and what is to be told of the scene's textures.
std::string with_contents_remark(const std::string& text, const LoadedScene& loaded) {
  const std::string remark = contents_remark(loaded);
  return remark.empty() ? text : text + "; " + remark;
}

}  // namespace

Object* find_object(Scene& scene, const ObjectPath& path) {
  return const_cast<Object*>(find_object(static_cast<const Scene&>(scene), path));
}

ObjectPaths paths_after(const Scene& before, const Scene& after, const ObjectPaths& paths) {
  ObjectPaths found;
  for (const ObjectPath& path : paths)
    if (find_object(before, path)) found.push_back(path_after(before.objects, after.objects, path));
  std::erase(found, ObjectPath{});  // what is gone
  return found;
}

void move_keys(const Scene& before, Scene& after) {
  if (!after.animation || !before.animation || !has_other_things(before, after)) return;
  std::erase_if(after.animation->keyed, [&](KeyedValue& keyed) {
    auto steps = pointer_steps(keyed.pointer).value_or(std::vector<std::string>{});
    const ObjectPath path = object_of(steps);
    if (path.empty()) return false;
    const ObjectPaths now = paths_after(before, after, {path});
    if (now.empty() || now[0].size() != path.size()) return true;
    for (std::size_t k = 0; k < path.size(); ++k) steps[2 * k + 1] = std::to_string(now[0][k]);
    keyed.pointer.clear();
    for (const std::string& step : steps) keyed.pointer += "/" + pointer_step(step);
    return false;
  });
  drop_lost_keys(after);
  if (after.animation->keyed.empty()) after.animation.reset();
}

bool has_comments(std::string_view text) {
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (in_string && text[i] == '\\')
      ++i;
    else if (text[i] == '"')
      in_string = !in_string;
    else if (!in_string && text[i] == '/')
      return true;  // nothing else in JSON has a slash
  }
  return false;
}

std::string title_of(const fs::path& file) { return all_printable(file.filename().string()); }

Document document_of(const LoadedScene& loaded) {
  auto origin = std::make_shared<Origin>();
  origin->title = title_of(loaded.name);
  origin->what = what_opens(loaded);
  origin->file = loaded.source;
  origin->folder = loaded.folder;
  if (!loaded.source.empty()) origin->text_hash = fnv1a(loaded.text);
  origin->comments = !loaded.source.empty() && has_comments(loaded.text);
  origin->is_picture = loaded.is_picture;
  origin->saved = loaded.scene;
  origin->sources = loaded.sources;
  return {loaded.scene, std::move(origin)};
}

std::shared_ptr<const Origin> save_document(const Document& document, const fs::path& file) {
  const fs::path folder = fs::absolute(file).parent_path();
  const Scene scene = move_textures(document.scene, document.origin->folder, folder);
  const std::string text = write_scene(scene);
  write_text_file(file, text);
  auto origin = std::make_shared<Origin>(*document.origin);
  origin->title = title_of(file);
  origin->what = fs::absolute(file).lexically_normal().string();
  origin->file = file;
  origin->folder = folder;
  origin->text_hash = fnv1a(text);
  origin->comments = false;
  origin->saved = scene;
  origin->sources.clear();
  return origin;
}

bool file_differs(const Origin& origin) {
  std::error_code ignored;
  if (!fs::is_regular_file(origin.file, ignored)) return false;  // a pipe would have to be waited for
  std::ifstream file(origin.file, std::ios::binary);
  return file && fnv1a(std::string(std::istreambuf_iterator<char>(file), {})) != origin.text_hash;
}

std::vector<fs::path> watched_files(const Document& document) {
  std::vector<fs::path> files;
  const Origin& origin = *document.origin;
  if (origin.what.empty()) return files;
  if (!origin.file.empty()) files.push_back(origin.file);
  files.insert(files.end(), origin.sources.begin(), origin.sources.end());
  each_picture(document.scene,
               [&](const auto& picture) { files.push_back(picture_name(origin.folder / picture.file).file); });
  return files;
}

constexpr std::size_t longest_stem = 200;  // bytes of the 255 that most file systems have for a name

std::string stem_of(const std::string& title) {
  std::string stem = fs::path(title).stem().string();
  const std::size_t dash = stem.rfind('-');
  const bool numbered = dash != std::string::npos && dash > 0 && stem.size() - dash >= 4 &&
                        stem.find_first_not_of("0123456789", dash + 1) == std::string::npos;
  if (numbered) stem.resize(dash);
  return stem.empty() || stem == "-" ? "scene" : shortened(stem, longest_stem);
}

OpenedFilm read_opened_film(const LoadedScene& loaded, const std::string& isa) {
  if (!loaded.source.empty() || loaded.files.empty()) return {};
  const std::filesystem::path& file = loaded.files.front();
  try {
    const ImageKind kind = image_kind(read_bytes(file, kind_size));
    if (kind == ImageKind::unknown) return {};
    if (kind == ImageKind::png)
      return {nullptr, with_contents_remark("it starts over, as a PNG holds no film; the EXR beside it does", loaded)};
    StoredFilm stored = read_stored_film(file);
    if (!is_whole(stored.part.film, loaded.scene))
      return {nullptr, "it starts over, as its film is a part of a picture"};
    const auto chosen = choose_kernels(isa);
    const FilmLabel label = label_for(loaded.scene, chosen ? chosen->isa : isa);
    if (const auto other = differing_samples(stored.scene, stored.label, loaded.scene, label))
      return {nullptr, "it starts over, as it is " + other->found + ", not " + other->expected};
    auto film = std::make_shared<Film>(std::move(stored.part.film));
    const std::uint32_t spp = totals(*film).min_taken;
    if (spp == 0) return {nullptr, "it starts over, as its film is empty"};
    return {std::move(film), with_contents_remark("it goes on from " + format_count(spp) + " spp", loaded)};
  } catch (const std::exception& error) {
    return {nullptr, std::string("it starts over: ") + error.what()};
  }
}

}  // namespace tyndall
