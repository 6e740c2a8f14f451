#pragma once
#include "core/compile/render_scene.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <functional>
#include <vector>

/// This room tells readers of "Ray Tracing in One Weekend" whether their picture of a scene is right, and if not, which
/// mistake explains the difference.
///
/// This file follows paths as the books' programs do: light is found by scattering alone, with independent random
/// numbers. Each rule that editions or usual mistakes change is a switch. The program's own kernels know none of the
/// switches, and sample light in other ways, so their samples are distributed otherwise: only pictures made in the
/// books' way show how often a sum of few samples is clipped at white.
namespace tyndall {

enum class DiffuseRule { cosine, filled_sphere, hemisphere };
enum class FuzzRule { filled_sphere, sphere };
enum class GlassRule { right, reflects_all, reflects_none, black, enters_only };
enum class TimeRule { kept, lost_by_matt, lost };

/// The rules by which a program of the books scatters light. The default is what Tyndall renders.
struct BookRules {
  DiffuseRule diffuse = DiffuseRule::cosine;  ///< filled_sphere: as edition 1; hemisphere: uniform, with weight 1
  FuzzRule fuzz = FuzzRule::filled_sphere;    ///< sphere: as edition 4
  GlassRule glass = GlassRule::right;  ///< enters_only: the refractive index is used as if every ray came from outside
  TimeRule time = TimeRule::kept;      ///< lost: scattered rays are at time 0
  bool schlick = false;                ///< instead of Fresnel's equations
  bool long_mirror = false;  ///< fuzz is added to a mirror direction that is as long as the ray's direction was
  bool short_frame = false;  ///< pixels are divided by width - 1 and height - 1, as in editions 2 and 3
  bool meets_itself =
      false;  ///< rays meet the surface that they leave where rounding has put them beyond it (no lower bound for t)
};

/// A scene and the rules by which a program renders it.
struct BookProgram {
  Scene scene;
  BookRules rules;
  /// Changes the compiled scene, where no scene file can say it; empty: nothing.
  std::function<void(RenderScene&)> columns{};
};

/// The program that renders a scene as it is.
inline BookProgram plain_program(const Scene& scene) {
  return {scene, {.schlick = scene.render.fresnel == FresnelKind::schlick}};
}

/// Every step-th pixel of a picture in both directions, from the upper left one on.
struct Lattice {
  int width = 0, height = 0;  ///< of the picture
  int step = 1;
  int columns() const { return (width + step - 1) / step; }
  int rows() const { return (height + step - 1) / step; }
  std::size_t pixels() const { return static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows()); }
};

/// Of at most 100,000 pixels.
Lattice lattice_of(int width, int height);

/// What one path brings.
struct BookSample {
  Vec3f light;             ///< linear radiance; black if the path found no light
  std::int32_t depth = 0;  ///< scattering events before the light was found
};

/// The samples 0 … count - 1 of each pixel of the lattice: those of a pixel follow each other. The same random numbers
/// are used whatever the rules are, so that pictures by two rules have much the same noise, and differ only where the
/// rules do. go_on: asked now and then; after it has said false the result is empty. Empty: nobody is asked.
std::vector<BookSample> book_samples(const BookProgram& program, const Lattice& lattice, int count,
                                     const std::function<bool()>& go_on = {});

}  // namespace tyndall
