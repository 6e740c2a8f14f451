#pragma once
#include "app/check/book_paths.h"
#include "app/check/statistics.h"
#include "core/scene/scene.h"

#include <string>
#include <vector>

/// Which object each pixel shows.
namespace tyndall {

/// The object that is seen first through the centre of each pixel of a lattice.
struct SeenObjects {
  struct Object {
    std::string name;            ///< "the sky", `"ball" (glass)`
    std::string kind;            ///< "sky", "glass", "metal", "matt surfaces", "lights", "smoke", "moving objects"
    bool noisy_texture = false;  ///< it has a noise texture, whose veins lie elsewhere in Tyndall
  };
  std::vector<Object> objects;
  std::vector<int> of_pixel;  ///< index into objects
};
SeenObjects seen_objects(const Scene& scene, const Lattice& lattice);

/// The objects as regions: the pixels around which the same object is seen. Objects of a noise texture have none.
Regions regions_of(const SeenObjects& seen, const Lattice& lattice);

}  // namespace tyndall
