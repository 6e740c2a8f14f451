#include "app/window/panels/field_rows.h"
#include "app/window/panels/panels.h"
#include "core/base/kinds.h"

#include <algorithm>

namespace tyndall {
namespace {

/// Puts a prefix before the names of controls in the log, as long as it lives.
class Scope {
 public:
  Scope(Ui& ui, const std::string& name) : ui_(ui), before_(ui.scope) {
    ui.scope += name + ".";
    ImGui::PushID(ui.scope.c_str());
  }
  ~Scope() {
    ImGui::PopID();
    ui_.scope = before_;
  }
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;

 private:
  Ui& ui_;
  std::string before_;
};

void material_rows(Ui& ui, Scene& scene, int index, bool brief) {
  Material& material = scene.materials[static_cast<std::size_t>(index)];
  const Scope scope(ui, material.name);
  std::visit([&](auto& kind) { field_rows(ui, kind); }, material.kind);
  const char* name = colour_name(material.kind);
  if (!name) return;
  Row row = row_of(name, colour_meaning(name), "");
  const Vec3d* colour = std::get_if<Vec3d>(&material.colour);
  if (colour && !brief) row.meaning = colour_meaning(material, *colour);
  colour_rows(ui, scene, material.colour, row);
}

void material_choice(Ui& ui, const Scene& scene, Solid3d& solid) {
  std::vector<std::string> names;
  for (const Material& material : scene.materials) names.push_back(material.name);
  const int users = users_of(scene, solid.material);
  Row row{"material", "Material", {}, {}, "", "which of the scene's materials it has", ""};
  if (users > 1) row.meaning = "shared by " + std::to_string(users) + " objects: all of them change";
  combo_row(ui, row, names, solid.material);
}

void transform_rows(Ui& ui, const char* prefix, Transform& transform) {
  int number = 0;
  for (auto& step : transform)
    std::visit(
        [&]<class Step>(Step& move) {
          const auto field = std::get<0>(fields_of<Step>());
          Row row = row_of(field, "");
          row.name = prefix + std::to_string(number++);
          value_row(ui, std::move(row), move.*field.value);
        },
        step);
}

void medium_rows(Ui& ui, Scene& scene, Volume& volume) {
  field_rows(ui, volume.medium);
  Row row = row_of("albedo", colour_meaning("albedo"), "");
  if (const Vec3d* colour = std::get_if<Vec3d>(&volume.albedo)) row.meaning = albedo_meaning(volume.medium, *colour);
  colour_rows(ui, scene, volume.albedo, row);
}

std::string kinds_of(const Scene& scene, const Object& object) {
  if (const Volume* volume = std::get_if<Volume>(&object.kind))
    return std::string(std::holds_alternative<Box<>>(volume->boundary) ? "box" : "sphere") + " · medium";
  const Material* material = material_of(scene, object);
  return kind_name(object) + (material ? std::string(" · ") + material_name(*material) : "");
}

/// The rows that are shown of an object while nothing is selected: its material, and a metal ball's radius.
void brief_section(Ui& ui, Scene& scene, const ObjectPath& path) {
  Object& object = *find_object(scene, path);
  if (!section(ui, title_of(scene, path), kinds_of(scene, object))) return;
  if (Volume* volume = std::get_if<Volume>(&object.kind)) {
    const Scope scope(ui, title_of(scene, path));
    field_rows(ui, volume->medium);
    return;
  }
  Solid3d& solid = std::get<Solid3d>(object.kind);
  material_rows(ui, scene, solid.material, true);
  Sphere<>* sphere = std::get_if<Sphere<>>(&solid.shape);
  if (!sphere || !std::holds_alternative<Metal<>>(material_of(scene, object)->kind)) return;
  const Scope scope(ui, title_of(scene, path));
  field_rows(ui, *sphere, [](const auto&, std::string_view name) { return name == "radius"; });
}

void full_section(Ui& ui, Scene& scene, const ObjectPath& path) {
  Object& object = *find_object(scene, path);
  if (!section(ui, title_of(scene, path), kinds_of(scene, object))) return;
  if (Solid3d* solid = std::get_if<Solid3d>(&object.kind)) {
    material_rows(ui, scene, solid->material, false);
    const Scope scope(ui, title_of(scene, path));
    std::visit([&](auto& shape) { field_rows(ui, shape); }, solid->shape);
    material_choice(ui, scene, *solid);
    transform_rows(ui, "transform", object.transform);
    return;
  }
  const Scope scope(ui, title_of(scene, path));
  if (Volume* volume = std::get_if<Volume>(&object.kind)) {
    medium_rows(ui, scene, *volume);
    std::visit([&](auto& shape) { field_rows(ui, shape); }, volume->boundary);
    transform_rows(ui, "boundary", volume->boundary_transform);
  } else {
    note(ui, std::to_string(std::get<Group>(object.kind).objects.size()) + " objects", false);
  }
  transform_rows(ui, "transform", object.transform);
}

void texture_rows(Ui& ui, Texture& texture) {
  const Scope scope(ui, texture.name);
  std::visit(Overloaded{[&](Image& image) {
                          text_row(ui, {"file", "Picture", {}, {}, "", image.file, ""}, image.file);
                        },
                        [&](auto& kind) { field_rows(ui, kind); }},
             texture.kind);
}

}  // namespace

void colour_rows(Ui& ui, Scene& scene, ColourOrTexture& colour, const Row& row) {
  if (Vec3d* rgb = std::get_if<Vec3d>(&colour)) {
    colour_row(ui, row, *rgb);
    return;
  }
  int& index = std::get<TextureIndex>(colour).index;
  std::vector<std::string> names;
  for (const Texture& texture : scene.textures) names.push_back(texture.name);
  combo_row(ui, row, names, index);
  texture_rows(ui, scene.textures[static_cast<std::size_t>(index)]);
}

void object_panel(Ui& ui, PanelState& state) {
  if (find_object(state.scene, state.selected)) {
    ImGui::PushID("selected");
    full_section(ui, state.scene, state.selected);
    ImGui::PopID();
    return;
  }
  for (const ObjectPath& path : interesting(state.scene)) {
    ImGui::PushID(path.back());
    brief_section(ui, state.scene, path);
    ImGui::PopID();
  }
}

}  // namespace tyndall
