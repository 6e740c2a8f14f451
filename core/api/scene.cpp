#include "core/api/data.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace tyndall {
inline namespace v0 {
namespace {

using inner::guarded;

std::shared_ptr<const Scene::Data> data_of(LoadedScene loaded, std::shared_ptr<const PreparedScene> before = {}) {
  auto data = std::make_shared<Scene::Data>();
  data->scene = std::move(loaded.scene);
  data->name = std::move(loaded.name);
  data->folder = std::move(loaded.folder);
  data->before = std::move(before);
  return data;
}

std::vector<std::string> steps_of(const Scene::Data& data, const std::string& pointer) {
  if (auto steps = pointer_steps(pointer)) return *steps;
  throw SceneError(data.name, "pointer " + in_quotes(pointer), "a JSON pointer, which begins with /");
}

/// The object that a text describes, as one of the scene's.
std::vector<Object> read_object(const Scene::Data& data, const std::string& text) {
  const JsonDocument document = parse_json(text);
  NameTables names;
  for (std::size_t i = 0; i < data.scene.textures.size(); ++i)
    names.textures.emplace(data.scene.textures[i].name, static_cast<int>(i));
  for (std::size_t i = 0; i < data.scene.materials.size(); ++i)
    names.materials.emplace(data.scene.materials[i].name, static_cast<int>(i));
  const Place whole, list(whole, "objects");
  std::vector<Object> objects = read_objects(JsonValue{JsonArray{document.root}}, list, names);
  inner::CoreScene alone = data.scene;
  alone.objects = objects;
  if (const auto fault = check(alone)) throw *fault;
  return objects;
}

/// A value as JSON, for a place of the scene of that name.
std::string json_of(const std::string& name, const std::string& place, double value) {
  if (!std::isfinite(value)) throw inner::error_of(name, {place, number_text(value), "a finite number"});
  return number_text(value);
}

std::string json_of(const std::string& name, const std::string& place, const Vec3& v) {
  const auto number = [&](double value) { return json_of(name, place, value); };
  return "[" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + "]";
}

std::string json_of(const std::string& name, const std::string& place, const std::string& text) {
  if (!is_utf8(text)) throw inner::error_of(name, {place, in_quotes(printable(text)), "text in UTF-8"});
  return in_quotes(text);
}

}  // namespace

const std::shared_ptr<const PreparedScene>& Scene::Data::prepared() const {
  const std::lock_guard lock(mutex_);
  if (!prepared_) prepared_ = prepare(std::make_shared<const inner::CoreScene>(scene), before.get());
  return prepared_;
}

std::shared_ptr<const PreparedScene> Scene::Data::prepared_already() const {
  const std::lock_guard lock(mutex_);
  return prepared_ ? prepared_ : before;
}

Error::Error(const std::string& sentence, std::string file_, std::string place_, std::string found_,
             std::string expected_)
    : runtime_error(sentence),
      file(std::move(file_)),
      place(std::move(place_)),
      found(std::move(found_)),
      expected(std::move(expected_)) {}
Error::~Error() = default;

Scene::Scene() : data_(std::make_shared<const Data>()) {}

Scene Scene::load(const std::string& what) {
  return guarded([&] {
    if (what == "-") throw SceneError(what, "standard input", "a file, or a built-in scene's name");
    return Access::scene(data_of(load_scene(what)));
  });
}

Scene Scene::parse(const std::string& json, const std::string& folder) {
  return guarded([&] { return Access::scene(data_of(load_scene_text(json, "scene", folder))); });
}

std::vector<std::string> Scene::built_in() {
  return guarded([] {
    std::vector<std::string> names;
    for (const BuiltIn& scene : built_in_scenes()) names.push_back(scene.name);
    return names;
  });
}

void Scene::set_json(const std::string& pointer, const std::string& json) {
  data_ = guarded([&] {
    JsonValue root = scene_json(data_->scene);
    steps_of(*data_, pointer);
    add_sections(root);
    try {
      apply_override(root, {pointer, json});
    } catch (const ParseError& fault) {
      throw inner::error_of(data_->name, {pointer, fault.found, fault.expected});
    }
    return data_of(load_scene_text(print_json(root), data_->name, data_->folder), data_->prepared_already());
  });
}

void Scene::set(const std::string& pointer, double value) { set_json(pointer, json_of(data_->name, pointer, value)); }

void Scene::set(const std::string& pointer, const Vec3& value) {
  set_json(pointer, json_of(data_->name, pointer, value));
}

void Scene::set(const std::string& pointer, bool value) { set_json(pointer, value ? "true" : "false"); }

void Scene::set(const std::string& pointer, const std::string& text) {
  set_json(pointer, json_of(data_->name, pointer, text));
}

void Scene::remove(const std::string& pointer) {
  data_ = guarded([&] {
    JsonValue root = scene_json(data_->scene);
    const std::vector<std::string> steps = steps_of(*data_, pointer);
    if (steps.empty() || !find_value(root, steps))
      throw SceneError(data_->name, pointer, "nothing", "a value that the scene file writes");
    JsonValue* holder = find_value(root, {steps.begin(), steps.end() - 1});
    if (auto* object = std::get_if<JsonObject>(&holder->value))
      std::erase_if(*object, [&](const JsonMember& member) { return member.key == steps.back(); });
    if (auto* array = std::get_if<JsonArray>(&holder->value))
      array->erase(array->begin() + static_cast<std::ptrdiff_t>(std::stoull(steps.back())));
    return data_of(load_scene_text(print_json(root), data_->name, data_->folder), data_->prepared_already());
  });
}

std::string Scene::get_json(const std::string& pointer) const {
  return guarded([&] {
    steps_of(*data_, pointer);
    const std::optional<JsonValue> value = value_at_pointer(data_->scene, pointer);
    if (!value) throw SceneError(data_->name, pointer, "nothing", "a value of the scene");
    std::string text = print_json(*value);
    while (text.ends_with('\n')) text.pop_back();
    return text;
  });
}

std::string Scene::json() const {
  return guarded([&] { return write_scene(data_->scene); });
}

void Scene::save(const std::string& file) const {
  guarded([&] {
    const std::filesystem::path to = file;
    const std::string text = write_scene(move_textures(data_->scene, data_->folder, to.parent_path()));
    WholeFile out(to);
    out.write(std::as_bytes(std::span(text)));
    out.commit();
  });
}

void Scene::add_json(const std::string& object) {
  data_ = guarded([&] {
    auto changed = std::make_shared<Data>();
    changed->scene = data_->scene, changed->name = data_->name, changed->folder = data_->folder;
    const std::string index = std::to_string(data_->scene.objects.size());
    try {
      for (Object& added : read_object(*data_, object)) changed->scene.objects.push_back(std::move(added));
    } catch (ParseError& fault) {
      constexpr std::string_view first = "/objects/0";
      if (fault.where.starts_with(first)) fault.where = "/objects/" + index + fault.where.substr(first.size());
      throw inner::error_of(data_->name, fault);
    }
    return std::shared_ptr<const Data>(std::move(changed));
  });
}

int Scene::width() const { return data_->scene.width; }
int Scene::height() const { return data_->scene.height; }
std::string Scene::folder() const { return data_->folder.string(); }

std::string version() { return TYNDALL_VERSION; }

namespace detail {

void fail_moved_from() { throw Error("found an object that was moved from, expected one that holds something"); }

Members& Members::put(const char* key, const std::string& json) {
  text_ += (text_.empty() ? "" : ", ") + in_quotes(key) + ": " + json;
  return *this;
}

Members& Members::operator()(const char* key, double value) { return put(key, json_of("scene", key, value)); }

Members& Members::operator()(const char* key, const Vec3& value) { return put(key, json_of("scene", key, value)); }

Members& Members::operator()(const char* key, const Colour& value) {
  return value.texture.empty() ? (*this)(key, value.rgb) : (*this)(key, value.texture);
}

Members& Members::operator()(const char* key, const std::string& value) {
  const std::string json = json_of("scene", key, value);
  return value.empty() ? *this : put(key, json);
}

Members& Members::operator()(const char* key, const Transform& value) {
  std::string text;
  for (const auto& step : value) {
    Members members;
    std::visit(
        [&]<class Step>(const Step& one) {
          if constexpr (std::is_same_v<Step, RotateY>)
            members("rotate_y", one.degrees);
          else
            members("translate", one.offset);
        },
        step);
    text += (text.empty() ? "[" : ", ") + members.text();
  }
  return text.empty() ? *this : put(key, text + "]");
}

std::string pointer_step(const std::string& name) { return tyndall::pointer_step(std::string_view(name)); }

}  // namespace detail
}  // namespace v0
}  // namespace tyndall
