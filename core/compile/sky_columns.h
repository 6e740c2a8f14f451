#pragma once
#include "core/base/vec.h"
#include "core/compile/column.h"
#include "core/textures/image.h"

#include <cstdint>
#include <memory>

/// A picture of the sky as kernels read it.
namespace tyndall {

/// The sun in a picture of the sky, before the sky's turn: a square of directions that holds all its light.
struct SkySun {
  Vec3d axis{}, edge_u{}, edge_v{};  ///< unit, at right angles: the square's middle and the directions of its sides
  double tangent = 0;                ///< of half the angle from side to side; 0: the picture has no sun
  double irradiance = 0;             ///< as SkyDistribution::irradiance, of the directions in the square alone
};

/// By what light sampling draws directions to the sky's picture: cells of about equal height and width, of which each
/// is drawn with a probability that is a whole number of `draws`. See core/trace/sky.h.
struct SkyDistribution {
  static constexpr std::int32_t draws = 1 << 24;  ///< as many values as a random number has
  int rows = 0;                                   ///< of cells, from the top
  int rows_per_texel = 2;                         ///< even, so that no cell reaches beyond the middle of a texel
  int row_step = 0, column_step = 0;              ///< the largest powers of two up to rows and the picture's width
  Column<std::int32_t> row_ends;                  ///< rows + 1: where the draws of each row begin
  Column<std::int32_t> column_ends;               ///< width + 1 for each row: where those of each of its cells begin
  float to_one = 1;                               ///< power of two that brings the largest component to about 1
  double irradiance = 0;  ///< integral of the largest component over all directions, without the sky's scale
  /// Fraction of all directions that a sky of one radiance would fill that has the same integrals of the largest
  /// component and of its square: 1 if all directions are as bright, near that of the sun if it gives most of the
  /// light.
  double spread = 1;
  double spread_without_sun = 1;  ///< the same of the sky without `sun`; 1 if nothing else gives light
  SkySun sun;
};
/// Luminance (Rec.709) of a sky's texel, in units in which the brightest is about 1.
template <class F>
TYNDALL_INLINE F sky_luminance(Vec3<F> rgb, F to_one) {
  return to_one * rgb.x * F(0.2126f) + to_one * rgb.y * F(0.7152f) + to_one * rgb.z * F(0.0722f);
}

/// The picture of the sky.
struct SkyColumns {
  std::shared_ptr<const Image::Pixels> pixels;  ///< the scene's own; null: there is none
  const float* texels = nullptr;                ///< its numbers
  int width = 0, height = 0;
  SkyDistribution distribution;                  ///< without ends where no light is sampled
  float cos = 1, sin = 0;                        ///< of the sky's turn about y
  float scale = 1;                               ///< factor on the picture's radiance
  float irradiance = 0;                          ///< that of the distribution, times the scale
  Vec3f sun_axis{}, sun_edge_u{}, sun_edge_v{};  ///< see SkySun, after the sky's turn
  float sun_tangent = 0;
  TYNDALL_INLINE bool is_sampled() const { return irradiance > 0; }  ///< as a light
};

}  // namespace tyndall
