#pragma once
#include <string>

namespace tyndall::test {

/// Every part of the format once, with values that are no defaults.
inline const std::string everything = R"(// A first line
// and a second.
{
  "tyndall": 1, /* comments may stand anywhere */
  "name": "Everything",
  "image": { "width": 600, "height": 300.0 },
  "camera": { "look_from": [278, 278, -800], "look_at": [278, 278, 0], "vup": [0, 2, 0], "vfov": 40,
              "defocus_angle": 0.5, "focus_distance": 10, "shutter": [0.25, 0.75] },
  "background": { "type": "hemispheres", "up": [1, 2, 3], "down": [0, 0, 0.5] },
  "render": { "max_depth": 50, "spp": 200, "integrator": "path", "sampler": "random", "fresnel": "schlick", "caustics": "scatter", "sharing": false, "seed": 4294967295, "adaptive": true },
  "display": { "exposure": -1.5, "tone_map": "aces" },
  "objects": [
    { "name": "ball", "type": "sphere", "center": [0, 1, 0], "radius": -0.9, "material": "glass" },
    { "type": "sphere", "center": [4, 1, 0], "center_end": [4, 1.5, 0], "radius": 0.2, "material": "gold" },
    { "type": "quad", "corner": [0, 1, 2], "u": [555, 0, 0], "v": [0, 0, 555], "material": "lamp" },
    { "type": "box", "min": [0, 0, 0], "max": [165, 330, 165], "material": "floor",
      "transform": [{ "rotate_y": 15 }, { "translate": [265, 0, 295] }] },
    { "type": "medium", "density": 0.01, "albedo": "marble", "g": -0.5, "transform": [{ "rotate_y": 1 }],
      "boundary": { "type": "box", "min": [0, 0, 0], "max": [1, 1, 1], "transform": [{ "translate": [1, 2, 3] }] } },
    { "type": "group", "name": "pair", "transform": [{ "rotate_y": 2 }], "objects": [
      { "type": "group", "objects": [] },
      { "type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "a/b~c \"d\"" }] },
    { "type": "triangle", "corner": [0, 1, 2], "u": [1, 0, 0], "v": [0, 0, 1], "material": "floor" },
    { "type": "disk", "center": [0, 1, 2], "u": [1, 0, 0], "v": [0, 0, 1], "inner": 0.5, "material": "screen" },
    { "type": "medium", "density": 1, "albedo": [0.1, 0.2, 0.3],
      "boundary": { "type": "sphere", "center": [0, 0, 0], "radius": 2 } }
  ],
  "materials": {
    "floor": { "type": "lambertian", "albedo": "tiles" },
    "gold": { "albedo": [0.8, 0.6, 0.2], "fuzz": 0.3, "type": "metal" },
    "glass": { "type": "dielectric", "refractive_index": 0.5 },
    "lamp": { "type": "light", "radiance": [7, 8, 9] },
    "a/b~c \"d\"": { "type": "lambertian", "albedo": "paint" },
    "screen": { "type": "light", "radiance": "planet" }
  },
  "textures": {
    "tiles": { "type": "checker", "scale": 0.32, "even": [0.2, 0.3, 0.1], "odd": [0.9, 0.9, 0.9] },
    "marble": { "type": "noise", "scale": 4, "style": "turbulence" },
    "veins": { "type": "noise", "scale": 4 },
    "paint": { "type": "solid", "color": [0.1, 0.2, 0.3] },
    "planet": { "type": "image", "file": "../textures/planet.png" }
  }
})";

}  // namespace tyndall::test
