#include "app/window/menus/row_list.h"

#include "app/window/panels/rows.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace tyndall {
namespace {

/// A row that is no single value of the scene.
struct SpecialRow {
  const char *part, *label, *synonyms;
};
constexpr SpecialRow special_rows[] = {
    {"Camera", "Cameras", "stored cameras, camera slots"},
    {"Image", "Clean", "clean view, filtered"},
    {"Image", "View", "aov, render pass, passes, channel"},
    {"Histogram", "", "levels, clipping"},
    {"Render", "Split", "split settings"},
    {"Render", "Image size", "resolution, width, height, dimensions, film size"},
    {"Render", "Render at", "window size, preview size"},
    {"Render", "Threads", "cpu, cores, processors"},
    {"Background", "Kind", "background, sky, environment, environment light, world, hdri"},
    {"Window", "Theme", "colour scheme, color scheme"},
    {"Window", "Text size, %", "text size, ui scale"}};
constexpr SpecialRow picture_row{"Object", "Picture", "image texture, texture file, bitmap"};
constexpr SpecialRow sky_row{"Background", "Picture", "sky picture, hdr, environment map, environment texture"};
constexpr SpecialRow surface_rows[] = {
    {"Object", "Type", "material type, shader, bsdf, surface, metallic, metalness, transmission, glass"},
    {"Object", "Material", "assign material, materials"}};
constexpr SpecialRow name_row_entry{"Object", "Name", "object title"};
constexpr SpecialRow light_rows[] = {
    {"Object", "Colour", "light color, light colour, lamp color, lamp colour"},
    {"Object", "Power", "emission, emissive, intensity, strength, luminance, lamp power, light power"},
    {"Object", "Stops", "light stops"}};

/// Collects rows, one of each label in a part.
class RowList {
 public:
  /// who: what must be selected for it, "fog"; of other parts than Object what to do first; "": the column has it now.
  void add(const std::string& part, const std::string& label, const std::string& synonyms, const std::string& owner,
           const std::string& who = "") {
    const auto found = std::find_if(rows_.begin(), rows_.end(),
                                    [&](const RowEntry& row) { return row.part == part && row.label == label; });
    if (found == rows_.end())
      rows_.push_back({part, label, synonyms, owner, who});
    else if (!found->missing.empty() && found->missing.find(who) == std::string::npos)
      found->missing += " or " + who;
  }
  void add(const SpecialRow& row, const std::string& owner, const std::string& who = "") {
    add(row.part, row.label, row.synonyms, owner, who);
  }
  void add(const char* part, const std::vector<Slot>& slots, const std::string& owner) {
    for (const Slot& slot : slots)
      if (slot.given || slot.name == std::string_view("focus_distance")) add(part, slot.label, slot.synonyms, owner);
  }
  /// The fields of a kind.
  template <class Kind>
  void add_kind(const char* part, const std::string& who) {
    if constexpr (requires { fields(static_cast<const Kind*>(nullptr)); }) {
      const Kind kind{};
      each_in("", kind, [&](const Slot& slot, const Kind&) {
        add(part, slot.label, slot.synonyms, "", slot.given ? who : who + " that moves");
        return false;
      });
    }
  }
  std::vector<RowEntry> take() {
    for (RowEntry& row : rows_)
      if (row.part == "Object" && !row.missing.empty()) row.missing = "select " + row.missing + " first";
    return std::move(rows_);
  }

 private:
  std::vector<RowEntry> rows_;
};

/// Colour or texture of a material or medium. name: "albedo" or "radiance".
void add_colour(RowList& rows, const Scene& scene, const ColourOrTexture& colour, const char* name,
                const std::string& owner) {
  const Slot slot = colour_slot("", name, {});
  const TextureIndex* index = std::get_if<TextureIndex>(&colour);
  const bool light = name == std::string_view("radiance") && !index;
  for (const SpecialRow& row : light_rows)
    if (light) rows.add(row, owner);
  if (!light) rows.add("Object", slot.label, slot.synonyms, owner);
  if (!index) return;
  const Texture& texture = scene.textures[static_cast<std::size_t>(index->index)];
  if (std::holds_alternative<Image>(texture.kind)) rows.add(picture_row, owner);
  rows.add("Object", slots_of(scene, texture_part(texture)), owner);
}

/// Whether it is a material's or medium's own colour.
bool is_colour(const Slot& slot) {
  return slot.name == std::string_view("albedo") || slot.name == std::string_view("radiance");
}

/// brief: nothing is selected, and of this object only the most interesting rows are shown.
void add_object(RowList& rows, const Scene& scene, const ObjectPath& path, bool brief) {
  const Object& object = *find_object(scene, path);
  const std::string owner = title_of(scene, path), part = object_part(path);
  const Material* material = material_of(scene, object);
  const Volume* volume = std::get_if<Volume>(&object.kind);
  std::vector<Slot> slots = slots_of(scene, part);
  if (material) {
    std::vector<Slot> own = slots_of(scene, material_part(*material));
    std::erase_if(own, is_colour);
    rows.add("Object", own, owner);
    if (const char* name = colour_name(material->kind)) add_colour(rows, scene, material->colour, name, owner);
  }
  const bool metal_sphere = shape_of<Sphere<>>(object) && material && std::holds_alternative<Metal<>>(material->kind);
  std::erase_if(slots, is_colour);
  if (brief && !volume)
    std::erase_if(slots, [&](const Slot& slot) { return !metal_sphere || slot.name != std::string_view("radius"); });
  if (!brief && material)
    for (const SpecialRow& row : surface_rows) rows.add(row, owner);
  rows.add("Object", slots, owner);
  if (brief) return;
  if (volume) {
    add_colour(rows, scene, volume->albedo, "albedo", owner);
    rows.add("Object", slots_of(scene, part + "/boundary"), owner);
    for (const std::string& step : transform_parts(part + "/boundary", volume->boundary_transform))
      rows.add("Object", slots_of(scene, step), owner);
  }
  for (const std::string& step : transform_parts(part, object.transform))
    rows.add("Object", slots_of(scene, step), owner);
  rows.add(name_row_entry, owner);
}

/// Rows of sections that are always there.
void add_section(RowList& rows, const Scene& scene, const char* name, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) rows.add(name, slots_of(scene, part), name);
  for (const SpecialRow& row : special_rows)
    if (row.part == std::string_view(name)) rows.add(row, name);
}

/// What objects of other kinds have.
void add_missing(RowList& rows) {
  rows.add_kind<Metal<>>("Object", "an object of metal");
  rows.add_kind<Dielectric<>>("Object", "an object of glass");
  for (const char* colour : {"albedo", "radiance"}) {
    const Slot slot = colour_slot("", colour, {});
    rows.add("Object", slot.label, slot.synonyms, "",
             *colour == 'a' ? "an object with a colour" : "a lamp with a texture");
  }
  for (const SpecialRow& row : light_rows) rows.add(row, "", "a lamp");
  rows.add_kind<Checker<>>("Object", "an object with a checker texture");
  rows.add_kind<Noise<>>("Object", "an object with a noise texture");
  rows.add_kind<Solid<>>("Object", "an object with a texture of one colour");
  rows.add(picture_row, "", "an object with a picture as its texture");
  for (const SpecialRow& row : surface_rows) rows.add(row, "", "an object with a surface");
  rows.add_kind<Medium<>>("Object", "fog");
  [&]<class... Shapes>(const std::variant<Shapes...>*) {
    (rows.add_kind<Shapes>("Object", std::string("a ") + Shapes::type), ...);
  }(static_cast<const decltype(Solid3d::shape)*>(nullptr));
  rows.add_kind<RotateY>("Object", "an object with a turn");
  rows.add_kind<Translate>("Object", "an object with a shift");
  rows.add(name_row_entry, "", "an object");
  rows.add_kind<Animation>("Film", "give a value a key first: right click on its row");
  const Slot colour = colour_slot("", "colour", {});
  rows.add("Background", colour.label, colour.synonyms, "", "choose colour as the background's kind first");
  rows.add_kind<Gradient>("Background", "choose gradient as the background's kind first");
  rows.add_kind<Hemispheres>("Background", "choose hemispheres as the background's kind first");
  const char* no_sky = "drop a picture of the sky on the window first";
  rows.add(sky_row, "", no_sky);
  rows.add_kind<SkyPicture>("Background", no_sky);
}

}  // namespace

std::vector<RowEntry> row_entries(const Scene& scene, const ObjectPath& selected) {
  RowList rows;
  const bool brief = !find_object(scene, selected);
  for (const ObjectPath& path : brief ? interesting(scene) : std::vector<ObjectPath>{selected})
    add_object(rows, scene, path, brief);
  add_section(rows, scene, "Camera", {"/camera"});
  add_section(rows, scene, "Image", {"/display"});
  add_section(rows, scene, "Histogram", {});
  add_section(rows, scene, "Film", {"/animation"});
  add_section(rows, scene, "Render", {"/render"});
  add_section(rows, scene, "Background", {"", "/background"});
  if (std::holds_alternative<SkyPicture>(scene.background)) rows.add(sky_row, "Background");
  add_section(rows, scene, "Window", {});
  add_missing(rows);
  return rows.take();
}

}  // namespace tyndall
