#include "core/compile/scene_features.h"

namespace tyndall {
namespace {

/// Returns the name of a kind of material as a feature: its name in scene files, unless the kind defines another.
template <class Kind>
constexpr const char* feature_name() {
  if constexpr (requires { Kind::feature; })
    return Kind::feature;
  else
    return Kind::type;
}

}  // namespace

SceneFeatures features_of(const Scene& scene, const Flattened& flat) {
  SceneFeatures n;
  std::vector<bool> used(scene.materials.size());
  std::vector<bool> textures(scene.textures.size());
  const auto use_colour = [&](const ColourOrTexture& c) {
    if (const auto* t = std::get_if<TextureIndex>(&c)) textures[static_cast<std::size_t>(t->index)] = true;
  };
  for (const PlacedShape& s : flat.shapes) {
    const auto* sphere = std::get_if<Sphere<>>(&s.shape);
    n.spheres |= sphere && !sphere->center_end;
    n.moving_spheres |= sphere && sphere->center_end;
    n.quads |= std::holds_alternative<Quad<>>(s.shape);
    n.boxes |= std::holds_alternative<Box<>>(s.shape);
    used[static_cast<std::size_t>(s.material)] = true;
  }
  for (const PlacedVolume& v : flat.volumes) {
    n.media = true;
    n.phase_functions |= v.medium.g != 0;
    use_colour(v.albedo);
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    const Material& m = scene.materials[i];
    n.materials[m.kind.index()] = true;
    if (colour_name(m.kind)) use_colour(m.colour);
  }
  for (std::size_t i = 0; i < textures.size(); ++i) {
    n.textures |= textures[i];
    n.image_textures |= textures[i] && std::holds_alternative<Image>(scene.textures[i].kind);
  }
  n.background = !(scene.background == Background(Vec3d{0, 0, 0}));
  n.lens = scene.camera.defocus_angle > 0;
  n.shutter = n.moving_spheres && scene.camera.shutter_close > scene.camera.shutter_open;
  return n;
}

std::vector<std::string> names_of(const SceneFeatures& n) {
  std::vector<std::string> names;
  const auto add = [&names](const char* name, bool needed) {
    if (needed) names.emplace_back(name);
  };
  add("spheres", n.spheres), add("moving_spheres", n.moving_spheres), add("quads", n.quads), add("boxes", n.boxes);
  add("media", n.media), add("phase_functions", n.phase_functions);
  [&]<class... Kinds>(const std::variant<Kinds...>*) {
    (add(feature_name<Kinds>(), has_material<Kinds>(n)), ...);
  }(static_cast<const MaterialKinds<double>*>(nullptr));
  add("textures", n.textures), add("image_textures", n.image_textures);
  add("background", n.background), add("lens", n.lens), add("shutter", n.shutter);
  return names;
}

}  // namespace tyndall
