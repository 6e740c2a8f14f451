#pragma once
#include "core/scene/scene.h"

#include <string>
#include <vector>

/// The scenes that are measured.
namespace tyndall::bench {

struct NamedScene {
  std::string name;
  Scene scene;
};

/// Built-in scenes of the books at small sizes, paths of at most 50 events: cornell-box, cornell-media, cover,
/// simple-light, the same with grey in place of its texture (simple-light-grey), hollow-glass. Throws SceneError.
std::vector<NamedScene> book_scenes();

/// A built-in scene in another size. Throws SceneError.
Scene built_in(const std::string& name, int width, int height);

/// A ground and 45 spheres in rows, two of them lights, the others matt, fuzzy metal and glass, under a dim sky: what
/// ray tracers of this kind are often timed with. 640x360.
Scene forty_six_spheres();

/// A field of `count` >= 500 or so lambertian spheres like that of the books' cover: a ground, three large ones, small
/// ones strewn around them, all apart, under the sky. A pure function of the count.
Scene field_of_spheres(int count);

/// A floor and twelve spheres beneath `count` lights as small as fireflies, which the camera does not see; they give
/// about as much light for any count. 160x90.
Scene floor_beneath_lights(int count);

}  // namespace tyndall::bench
