#pragma once
#include "app/check/objects.h"
#include "app/check/reading.h"
#include "app/check/reference.h"
#include "app/check/rules.h"
#include "app/check/statistics.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tyndall {

/// A mistake, and how much of the difference the scene rendered with it explains.
struct Explanation {
  std::string name, words;  ///< see Difference
  double explained = 0;     ///< 1: all that is more than noise; below 0: it makes things worse
};

/// What is found about a picture.
struct Findings {
  bool agrees = false;               ///< the picture differs from the scene by noise and by `choices` alone
  std::vector<Explanation> choices;  ///< by which the program does things otherwise, none of which is a mistake
  /// The mistake that explains the difference; nothing: none does, or the picture agrees.
  std::optional<Explanation> mistake;
  std::vector<Explanation> tried;  ///< all mistakes that were tried, the best first
  Curve curve = Curve::light;
  double samples = 0;  ///< a pixel, as the noise tells; 0: it does not tell
  int blocks = 0, different = 0, block_edge = 0;
  SeenObjects seen;
  std::vector<ObjectDifference> objects;  ///< those that differ, before the mistake is taken into account
  bool out_of_time = false;               ///< something was not tried
};

struct CheckOptions {
  double seconds = 20;  ///< for all of it, but for what is needed for any answer
  int threads = 0;      ///< 0: see thread_count()
};

/// How a picture differs from the scene as a few samples of each pixel show it: enough to tell whether it is a picture
/// of this scene at all.
Misfit rough_misfit(const PictureNumbers& picture, const Scene& scene, int threads);

/// Finds out how a picture differs from a scene of its size. reference: the scene, rendered; started: for the time.
Findings explain(const PictureNumbers& picture, const Scene& scene, const Reference& reference,
                const CheckOptions& options, const std::function<bool()>& go_on);

/// Whether a mistake that explains so much of a difference may be named.
inline constexpr double min_explained = 0.8;

}  // namespace tyndall
