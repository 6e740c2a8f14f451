#include "app/window/panels/field_rows.h"
#include "app/window/panels/material_rows.h"
#include "app/window/panels/panels.h"

namespace tyndall {
namespace {

/// The object's counterpart in the scene's file; null: it has none at that path.
const Object* saved_object(const PanelState& state, const ObjectPath& path) {
  const Object *now = find_object(state.scene, path), *saved = find_object(*state.model.saved, path);
  return saved && saved->name == now->name && saved->kind.index() == now->kind.index() ? saved : nullptr;
}

void transform_rows(Ui& ui, const char* prefix, Transform& transform, const Transform* saved) {
  int number = 0;
  for (auto& step : transform)
    std::visit(
        [&]<class Step>(Step& move) {
          const auto field = std::get<0>(fields_of<Step>());
          Row row = row_of(field, "");
          const auto k = static_cast<std::size_t>(number);
          const Step* original = saved && k < saved->size() ? std::get_if<Step>(&(*saved)[k]) : nullptr;
          if (original) row.original = original_of(original->*field.value);
          row.name = prefix + std::to_string(number++);
          value_row(ui, std::move(row), move.*field.value);
        },
        step);
}

void medium_rows(Ui& ui, PanelState& state, Volume& volume, const Volume* saved) {
  field_rows(ui, volume.medium, saved ? &saved->medium : nullptr);
  Row row = row_of("albedo", colour_meaning("albedo"), "");
  if (const Vec3d* colour = std::get_if<Vec3d>(&volume.albedo)) row.meaning = albedo_meaning(volume.medium, *colour);
  colour_rows(ui, state, volume.albedo, saved ? &saved->albedo : nullptr, std::move(row));
}

std::string kinds_of(const Scene& scene, const Object& object) {
  if (const Volume* volume = std::get_if<Volume>(&object.kind))
    return std::string(std::holds_alternative<Box<>>(volume->boundary) ? "box" : "sphere") + " · medium";
  const Material* material = material_of(scene, object);
  return kind_name(object) + (material ? std::string(" · ") + material_name(*material) : "");
}

/// The rows that are shown of an object while nothing is selected: its material, and a metal sphere's radius.
void brief_section(Ui& ui, PanelState& state, const ObjectPath& path) {
  Object& object = *find_object(state.scene, path);
  const Object* saved = saved_object(state, path);
  if (!section(ui, title_of(state.scene, path), kinds_of(state.scene, object))) return;
  if (Volume* volume = std::get_if<Volume>(&object.kind)) {
    const Scope scope(ui, title_of(state.scene, path));
    field_rows(ui, volume->medium, saved ? &std::get<Volume>(saved->kind).medium : nullptr);
    return;
  }
  Solid3d& solid = std::get<Solid3d>(object.kind);
  material_rows(ui, state, solid.material, true);
  Sphere<>* sphere = std::get_if<Sphere<>>(&solid.shape);
  if (!sphere || !std::holds_alternative<Metal<>>(material_of(state.scene, object)->kind)) return;
  const Scope scope(ui, title_of(state.scene, path));
  const Sphere<>* original = same_kind(*sphere, saved ? &std::get<Solid3d>(saved->kind).shape : nullptr);
  field_rows(ui, *sphere, original, [](const auto&, std::string_view name) { return name == "radius"; });
}

void shape_rows(Ui& ui, auto& shape, const auto* saved) {
  std::visit([&](auto& kind) { field_rows(ui, kind, same_kind(kind, saved)); }, shape);
}

/// The rows of a solid, a medium or a group, but for its name and its own transform.
void kind_rows(Ui& ui, PanelState& state, Object& object, const Object* saved) {
  if (Solid3d* solid = std::get_if<Solid3d>(&object.kind))
    return shape_rows(ui, solid->shape, saved ? &std::get<Solid3d>(saved->kind).shape : nullptr);
  if (Volume* volume = std::get_if<Volume>(&object.kind)) {
    const Volume* before = saved ? &std::get<Volume>(saved->kind) : nullptr;
    medium_rows(ui, state, *volume, before);
    shape_rows(ui, volume->boundary, before ? &before->boundary : nullptr);
    return transform_rows(ui, "boundary", volume->boundary_transform, before ? &before->boundary_transform : nullptr);
  }
  note(ui, std::to_string(std::get<Group>(object.kind).objects.size()) + " objects", false);
}

void full_section(Ui& ui, PanelState& state) {
  ObjectPath& path = state.selected;
  const Object* object = find_object(state.scene, path);
  const std::string title = title_of(state.scene, path), also = std::to_string(state.also.size());
  if (!section(ui, title, state.also.empty() ? kinds_of(state.scene, *object) : "and " + also + " more")) return;
  const Solid3d* solid = std::get_if<Solid3d>(&object->kind);
  if (solid) material_rows(ui, state, solid->material, false);
  const Scope scope(ui, title);
  if (solid) surface_rows(ui, state, path);
  Object& now = *find_object(state.scene, path);  // another type may have moved it in its list
  const Object* saved = saved_object(state, path);
  kind_rows(ui, state, now, saved);
  transform_rows(ui, "transform", now.transform, saved ? &saved->transform : nullptr);
  const Row name{"name", "Name", {}, {}, "", "of this object: key F2", ""};
  name_row(ui, name, title, state.rename, now.name);
  state.rename = false;
}

}  // namespace

ObjectPaths all_selected(const PanelState& state) {
  ObjectPaths all;
  if (!state.selected.empty()) all.push_back(state.selected);
  all.insert(all.end(), state.also.begin(), state.also.end());
  return all;
}

void set_selected(PanelState& state, const ObjectPaths& paths) {
  state.selected = paths.empty() ? ObjectPath{} : paths.front();
  state.also.assign(paths.begin() + (paths.empty() ? 0 : 1), paths.end());
}

void forget_scene(PanelState& state) {
  state.objects = {};
  state.backgrounds = {};
  state.materials = {};
}

void object_panel(Ui& ui, PanelState& state) {
  if (find_object(state.scene, state.selected)) {
    if (state.rename) ui.folded.erase(title_of(state.scene, state.selected));
    ImGui::PushID("selected");
    full_section(ui, state);
    ImGui::PopID();
    return;
  }
  for (const ObjectPath& path : interesting(state.scene)) {
    ImGui::PushID(path.back());
    brief_section(ui, state, path);
    ImGui::PopID();
  }
}

}  // namespace tyndall
