#pragma once
#include "core/compile/column.h"

/// The guide of a scene; core/guide explains and makes it.
namespace tyndall {

/// Sizes of cells: each level is four times as coarse as the one before. Most places are looked up at the middle level.
inline constexpr int guide_levels = 5, guide_middle_level = 2;

/// A slot in the table of cells.
struct GuideCell {
  std::int32_t tag = 0;             ///< names the cell; 0: the slot is empty
  std::int32_t first = 0, end = 0;  ///< its sequences of events
  std::int32_t is_refined = 0;      ///< 1: there are cells of the next finer level within it
  float query_probability = 0;      ///< that an event in the cell queries guided light
  bool operator==(const GuideCell&) const = default;
};

/// A sequence of events in a cell.
struct GuideSequence {
  std::int32_t low, high;            ///< as OrderedEvents
  std::int32_t next_low, next_high;  ///< the same events with the first one, not the last one, in the lowest bits
  std::int32_t count;                ///< of events
  std::int32_t image;                ///< index of the light's image; -1: the lobe tells where the light is seen
  float weight;                      ///< probability with which a query in the cell draws the sequence
  float cone_radius;                 ///< of the sphere that the sequence meets first; 0: it meets a flat first
  Vec3f cone_center;
  bool operator==(const GuideSequence&) const = default;
};

/// The lobe of a sequence in a cell: how the middle of a light is seen near a point by way of its events.
struct GuideLobe {
  Vec3f point, flight;           ///< flight: the light's direction at that point, unit
  Vec3f axis;                    ///< unit, across the flight: the lobe's first axis; the second one is flight x axis
  Vec3f curvature;               ///< of the wave front, in these axes: 11, 12, 22
  float variance_u, variance_v;  ///< along the two axes
  float error;                   ///< variance added at a distance of about a cell
  float inverse_size2;           ///< 1 / the cell's squared size
  bool operator==(const GuideLobe&) const = default;
};

/// A light's middle, and the sphere that reflects it, both mirrored in the flats through which a point sees them.
template <class F>
struct LightImage {
  Vec3<F> light, sphere;
  F radius;  ///< of the sphere; 0: there are flat mirrors only
  bool operator==(const LightImage&) const = default;
};

/// Directions from which diffuse surfaces are lit by way of glass, mirrors and metal of little fuzz. Empty where a
/// scene needs none.
struct Guide {
  std::int32_t slot_mask = 0;  ///< number of slots - 1; the number is a power of two
  float inverse_size[guide_levels] = {};
  Column<GuideCell> cells;  ///< by slot
  Column<GuideSequence> sequences;
  Column<GuideLobe> lobe;  ///< of each sequence
  Column<LightImage<float>> images;
  Column<std::int32_t> thing_of;  ///< by element: its index among near-specular elements, or -1
  /// Variance times samples, relative to the squared radiance, that BSDF sampling is expected to have without a guide.
  double expected_variance = 0;
  int light_paths = 0;      ///< how many were traced
  double milliseconds = 0;  ///< taken to make it

  /// One for each sequence of each cell; 0: the scene has no guide.
  TYNDALL_INLINE int lobes() const { return lobe.count(); }
};

}  // namespace tyndall
