#pragma once
#include <cstdint>

/// The guide of a scene as kernels read it; core/guide explains and makes it.
namespace tyndall {

/// Sizes of cells: each level is four times as coarse as the one before. Most places are looked up at the middle level.
inline constexpr int guide_levels = 5, guide_middle_level = 2;

/// Integers of a slot in the table of cells.
enum GuideCell : std::int32_t {
  cell_tag,         ///< names the cell; 0: the slot is empty
  cell_first,       ///< its first sequence of events
  cell_end,         ///< one behind its last
  cell_is_refined,  ///< 1: there are cells of the next finer level within it
  numbers_of_cell
};

/// Integers of a sequence of events in a cell.
enum GuidedEvents : std::int32_t {
  events_low,  ///< as OrderedEvents
  events_high,
  events_next_low,  ///< the same events with the first one, not the last one, in the lowest bits
  events_next_high,
  events_count,
  events_image,  ///< index of the light's image; -1: the lobe tells where the light is seen
  numbers_of_events = 8
};

/// Floats of a sequence of events in a cell.
enum GuidedWeights : std::int32_t {
  weight_of_events,  ///< probability with which a query in the cell draws the sequence
  cone_center,       ///< three numbers: centre of the sphere that the sequence meets first
  cone_radius = 4,   ///< 0: it meets a flat first
  numbers_of_weights = 8
};

/// Floats of an image of a light: see core/guide/light_image.h.
enum ImageNumber : std::int32_t {
  image_light = 0,   ///< three numbers
  image_sphere = 3,  ///< three numbers
  image_radius = 6,
  numbers_of_image = 8
};

/// Floats of the lobe of a sequence in a cell: how the middle of a light is seen near a point by way of its events.
enum LobeNumber : std::int32_t {
  lobe_point = 0,           ///< three numbers
  lobe_flight = 3,          ///< unit: the light's direction of flight at that point
  lobe_axis = 6,            ///< unit, across the flight: the lobe's first axis; the second one is flight x axis
  lobe_curvature = 9,       ///< of the wave front, in these axes: 11, 12, 22
  lobe_variance = 12,       ///< along the first axis, along the second
  lobe_error = 14,          ///< variance added at a distance of about a cell
  lobe_inverse_size2 = 15,  ///< 1 / the cell's squared size
  numbers_of_lobe = 16
};

struct GuideView {
  int lobes = 0;               ///< one for each sequence of each cell; 0: the scene has no guide
  std::int32_t slot_mask = 0;  ///< number of slots - 1; the number is a power of two
  float inverse_size[guide_levels] = {};
  const std::int32_t* cells = nullptr;       ///< numbers_of_cell for each slot
  const float* query_probability = nullptr;  ///< by slot: that an event in the cell queries guided light
  const std::int32_t* events = nullptr;      ///< numbers_of_events for each sequence
  const float* weights = nullptr;            ///< numbers_of_weights for each sequence
  const float* lobe = nullptr;               ///< numbers_of_lobe for each sequence
  const float* images = nullptr;             ///< numbers_of_image for each
  const std::int32_t* thing_of = nullptr;    ///< by element: its index among near-specular elements, or -1
};

}  // namespace tyndall
