#pragma once
#include "app/check/statistics.h"
#include "app/comparison/comparison.h"
#include "app/files/open_scene.h"
#include "core/accuracy/noise_test.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

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

/// Of the cells of SeenObjects::regions; the largest difference first.
std::vector<ObjectDifference> differing_objects(const SeenObjects& seen, std::span<const CellDifference> cells);

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

struct CheckOptions {
  double seconds = 20;  ///< for all of it, but for what is needed for any answer
  int samples = 0;      ///< that are taken of each pixel for a program; 0: as many as the time allows
};

/// Renders the scene until the noise is small against the difference from `picture`, which has the scene's size, or
/// a limit is reached, which the first samples may exceed. go_on: asked now and then; false ends it. Pixels share no
/// paths, so that their errors are independent.
NoisyImage render_reference(Scene scene, const LinearImage& picture, double seconds, std::uint32_t spp,
                            const std::function<bool()>& go_on);

/// Finds out how a picture differs from a scene of its size. reference: the scene, rendered; go_on: asked now and then;
/// after it has said false no more is tried.
Findings explain(const PictureNumbers& picture, const Scene& scene, const NoisyImage& reference,
                 const CheckOptions& options, const std::function<bool()>& go_on);

/// What is found about a picture, in lines for a table.
std::string verdict_text(const Findings& verdict);
/// The same for scripts.
nlohmann::ordered_json verdict_json(const Findings& verdict);

/// Whether a name stands for a scene to compare with, and not for a picture: a built-in scene, a C++ source file, or a
/// file that is no picture. PNG and EXR are pictures, also those that carry a scene. Throws UsageError for a name that
/// cannot be a picture's either: of nothing, or of a folder. A file that is called like a picture and is not there is
/// left to those who read it.
bool names_scene(const std::string& name);

struct CheckRequest {
  std::filesystem::path image;
  PpmCurve ppm = PpmCurve::srgb;  ///< how the numbers of a PPM are read for `comparison`
  SceneRequest scene;
  CheckOptions options;
  /// Told what is being done, and asked whether to go on; empty: nobody is.
  std::function<bool(const std::string& stage, double seconds)> progress;
};

/// Compares a small picture of the scene that was taken from a program, made by the rules of its edition, with one of
/// samples that the program computes itself. Returns why they are not the same, in one sentence; "": they are, or it
/// cannot be judged (of noise and images, each program has its own). Takes half a second of the program's time.
/// Textures of images are compared with their files.
std::string differs_from_own(const Scene& scene, const ProgramScene& program);

/// A picture against a scene.
struct Check {
  Comparison comparison;  ///< with the scene, rendered in the picture's size
  Findings verdict;
};

/// Renders the scene in the picture's size, and compares. Throws as open_scene(), read_whole_picture() and
/// compare_pair() do.
Check check_picture(const CheckRequest& request);

}  // namespace tyndall
