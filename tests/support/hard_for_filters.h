#pragma once
#include "core/scene/load.h"

#include <string>
#include <utility>
#include <vector>

/// Scenes made to break filters: their pictures have sharp edges where albedo, normal and depth do not change.
namespace tyndall::test {

inline Scene hard_scene(const std::string& name, const std::string& look, const std::string& textures,
                        const std::string& materials, const std::string& objects) {
  const std::string text = R"({"tyndall": 1, "image": {"width": 128, "height": 72}, "camera": {)" + look +
                           R"(}, "textures": {)" + textures +
                           R"(}, "materials": {"grey": {"type": "lambertian", "albedo": [0.5, 0.5, 0.5]},
    "lamp": {"type": "light", "radiance": [20, 18, 15]}, "glass": {"type": "dielectric", "refractive_index": 1.5},
    "mirror": {"type": "metal", "albedo": [0.9, 0.9, 0.9], "fuzz": 0})" +
                           materials + R"(}, "objects": [)" + objects + "]}";
  return read_scene(text, name, ".");
}

inline std::vector<std::pair<std::string, Scene>> scenes_hard_for_filters() {
  const std::string look = R"("look_from": [0, 2, 8], "look_at": [0, 1, 0], "vfov": 40)";
  const std::string floor =
      R"({"type": "quad", "corner": [-9, 0, -9], "u": [18, 0, 0], "v": [0, 0, 18], "material": "grey"})";
  const std::string lamp =
      R"(,{"type": "quad", "corner": [-1, 5, -1], "u": [2, 0, 0], "v": [0, 0, 2], "material": "lamp"})";
  const std::string checker =
      R"("fine": {"type": "checker", "scale": 0.05, "even": [0.1, 0.1, 0.1], "odd": [0.9, 0.9, 0.9]})";
  const std::string painted = R"(, "painted": {"type": "lambertian", "albedo": "fine"})";
  const std::string noise = R"("fine": {"type": "noise", "scale": 12, "style": "turbulence"})";
  const std::string wall = R"(,{"type": "quad", "corner": [-4, 0, -3], "u": [8, 0, 0], "v": [0, 5, 0], "material": ")";
  const std::string ball = R"(,{"type": "sphere", "center": [0, 1, 1], "radius": 1, "material": ")";
  std::string specks;
  for (int i = 0; i < 40; ++i)
    specks += R"(,{"type": "sphere", "center": [)" + std::to_string(-3 + 0.15 * i) + ", " +
              std::to_string(0.5 + 0.07 * ((i * 17) % 40)) + R"(, 0], "radius": 0.01, "material": "lamp"})";
  return {{"fine texture seen through glass",
           hard_scene("glass", look, checker, painted, floor + lamp + wall + "painted\"}" + ball + "glass\"}")},
          {"checkered floor to the horizon",
           hard_scene("floor", R"("look_from": [0, 0.5, 8], "look_at": [0, 0.4, 0], "vfov": 60)",
                      R"("fine": {"type": "checker", "scale": 0.3, "even": [0.1, 0.1, 0.1], "odd": [0.9, 0.9, 0.9]})",
                      painted,
                      R"({"type": "quad", "corner": [-500, 0, -1000], "u": [1000, 0, 0], "v": [0, 0, 1010],
                      "material": "painted"})" +
                          lamp)},
          {"lamps of one pixel", hard_scene("specks", look, "", "", floor + specks)},
          {"a caustic's edge", hard_scene("caustic", R"("look_from": [0, 4, 6], "look_at": [0.5, 0, 0.5], "vfov": 40)",
                                          "", "", floor + lamp + ball + "glass\"}")},
          {"shadows in fog", hard_scene("fog", look, "", "", floor + lamp + ball + R"(grey"},
        {"type": "medium", "boundary": {"type": "box", "min": [-4, 0.01, -4], "max": [4, 4.9, 4]}, "density": 0.15,
         "albedo": [0.9, 0.9, 0.9], "g": 0.3})")},
          {"a moving ball with a texture",
           hard_scene("moving", look + R"(, "shutter": [0, 1])", checker, painted, floor + lamp + R"(,
        {"type": "sphere", "center": [-1, 1, 1], "center_end": [1, 1.3, 1], "radius": 1, "material": "painted"})")},
          {"a noise texture in a mirror",
           hard_scene("mirror", look, noise, painted, floor + lamp + ball + "mirror\"}" + R"(,
        {"type": "quad", "corner": [-4, 0, 9], "u": [8, 0, 0], "v": [0, 5, 0], "material": "painted"})")}};
}

}  // namespace tyndall::test
