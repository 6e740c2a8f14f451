#pragma once
#include "core/guide/light_image.h"
#include "core/guide/nearby_rays.h"
#include "core/guide/things.h"

#include <cstdint>
#include <optional>
#include <vector>

/// Light paths from the middles of lights over near-specular surfaces to diffuse ones. They are traced in double, with
/// IEEE operations and square roots only, so that every processor finds the same.
namespace tyndall {

/// Where a light path ends at a diffuse surface.
struct Landing {
  Vec3d point, flight;                 ///< flight: unit, the light's direction there
  Vec3d axis;                          ///< unit, across the flight; matrices are in the frame (axis, flight x axis)
  Symmetric curvature;                 ///< of the wave front from the light's middle
  Symmetric variance;                  ///< of directions: by the light's size and by fuzz
  double weight = 0;                   ///< power that the path carries
  double chance = 1;                   ///< probability that glass sends a path this way
  double length = 0;                   ///< of the path
  OrderedEvents<double> events, next;  ///< as seen from the surface; next: with the first event in the lowest bits
  int count = 0;                       ///< of events
  std::optional<LightImage<double>> image;  ///< where points see the light by way of the same events
};

class LightPaths {
 public:
  LightPaths(const SceneView& scene, std::vector<Thing> things);

  /// Traces about `count` paths, spread evenly over pairs of a light and a thing.
  void trace_pairs(int count);
  /// Keeps about `count` landings, evenly chosen, with their power, and spreads them over sequences of events as
  /// trace_copies() does, with at least ten of each sequence that has so many.
  void thin_out(std::size_t count);
  /// Traces about `count` copies of the paths that have landed, rotated a little, and spreads them over sequences of
  /// events by the roots of their powers.
  void trace_copies(int count);

  const std::vector<Landing>& landings() const { return landings_; }
  const std::vector<Thing>& things() const { return things_; }
  std::vector<std::int32_t> thing_of() const;              ///< by element
  double paths_of_pair() const { return paths_of_pair_; }  ///< what the sum of weights is to be divided by
  int traced() const { return traced_; }

 private:
  struct Start {
    Vec3d direction;
    double solid_angle = 0;  ///< of the thing
    double power = 0;        ///< sent into it, by the radiance in this direction
    int light = 0, thing = 0;
    double time = 0;
  };
  /// The landings after one sequence of events.
  struct SequenceLandings {
    std::vector<std::size_t> landed;  ///< their indices
    double power = 0;                 ///< sum of their weights
    double fraction = 0;              ///< root of the power, over the sum of these roots of all sequences
  };
  struct NearbyRay {
    Vec3d origin, direction;
    bool lost = false;
  };
  /// A light path on its way. The first ray is the path itself; then two rotated at the light, two moved on the light,
  /// and two rotated at each fuzzy reflection.
  struct Flight {
    Start start;
    std::vector<NearbyRay> rays;
    std::vector<double> fuzz;
    double light_radius = 0, weight = 0, chance = 1, length = 0;
    std::int32_t from = 0;  ///< Ray::from of the path
    std::optional<LightImage<double>> image;
    std::vector<std::int32_t> met;  ///< 2 · thing + (1: reflected)
  };

  double next();  ///< a random number in [0, 1)
  Vec3d direction_in_cone(Vec3d axis, double one_minus_cos);
  bool aim(int light, int thing, Start& start);
  void begin(const Start& start);
  void trace(const Start& start, const OrderedEvents<double>* wanted);
  Vec3d middle_of(int light, double time) const;
  bool choose_side(double reflected, std::int32_t thing, const OrderedEvents<double>* wanted, bool& reflects);
  void extend_image(const Thing& thing, const MetSurface& m);
  bool meet(std::int32_t element, double t, const OrderedEvents<double>* wanted);
  bool name_events(const OrderedEvents<double>* wanted, Landing& landing) const;
  void land(Vec3d point, const OrderedEvents<double>* wanted);
  void copy(const std::vector<std::size_t>& landed, int count);
  std::vector<SequenceLandings> by_events() const;

  const SceneView& scene_;
  std::vector<Thing> things_;
  std::vector<std::int32_t> thing_of_;
  std::vector<Landing> landings_;
  std::vector<Start> starts_;  ///< of the landings
  Flight flight_;
  std::uint64_t random_ = 0x2545f4914f6cdd1dull;
  double paths_of_pair_ = 0;
  int traced_ = 0;
};

}  // namespace tyndall
