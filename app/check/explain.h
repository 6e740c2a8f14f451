#pragma once
#include "app/check/statistics.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>

namespace tyndall {

/// One thing that programs of the books do otherwise: by their edition, or by a usual mistake.
struct Difference {
  std::string name;   ///< for scripts: "schlick-always-1"
  std::string words;  ///< a clause without subject: "glass reflects everything (…)"
  /// Changes the program; false: it has nothing that this would change.
  std::function<bool(BookProgram&)> apply{};
  /// How much of the difference of a picture the scene rendered with it explains. 1: all that is more than noise; below
  /// 0: it makes things worse.
  double explained = 0;
  Reading reading{};  ///< that goes best with it
};

/// What editions and compilers do otherwise: said, never counted as a mistake. The first of two that exclude each other
/// is the more usual one.
std::vector<Difference> usual_choices();

/// A wrong way to write the picture; it changes nothing in the program.
Difference mistake_of(const Reading& reading);
/// Paths that end after so many scattering events.
Difference shorter_paths(int max_depth);
/// Mistakes that are found by rendering the scene with each of them.
std::vector<Difference> usual_mistakes();

/// Means of linear light over the pixels of an object that differs.
struct ObjectDifference {
  SeenObjects::Object object;
  int pixels = 0;
  Vec3d image, expected;
};

/// What is found about a picture.
struct Findings {
  bool agrees = false;  ///< the picture differs from the scene by noise and by `choices` alone
  /// It cannot be told whether they agree: programs of the books find the scene's light too seldom.
  bool unknown = false;
  bool too_few = false;             ///< they differ by noise alone, which is so much that nothing else would show
  double unseen = 0;                ///< fraction of the light by which the whole may be off without that it is seen
  double enough = 0;                ///< samples a pixel that would do where there are too few; 0: not known
  std::vector<Difference> choices;  ///< by which the program does things otherwise, none of which is a mistake
  /// The mistake with which the scene's picture agrees with this one; nothing: there is none, not all were tried, or
  /// no difference has to be explained.
  std::optional<Difference> mistake;
  std::vector<Difference> tried;  ///< all mistakes that were tried, the best first
  int untried = 0;                ///< mistakes for which there was no time
  double seconds = 0;             ///< that there were: CheckOptions::seconds
  TransferCurve curve = TransferCurve::light;
  double samples = 0;  ///< a pixel, as the noise tells; 0: it does not tell
  int blocks = 0, different = 0, block_edge = 0;
  SeenObjects seen;
  std::vector<ObjectDifference> objects;  ///< before the mistake is taken into account, the largest difference first
};

/// Finds out how a picture differs from a scene of its size. reference: the scene, rendered; go_on: asked now and then;
/// after it has said false no more is tried.
Findings explain(const PictureNumbers& picture, const Scene& scene, const Reference& reference,
                 const CheckOptions& options, const std::function<bool()>& go_on);

/// What is found about a picture, in lines for a table.
std::string verdict_text(const Findings& verdict);
/// The same for scripts.
nlohmann::ordered_json verdict_json(const Findings& verdict);

}  // namespace tyndall
