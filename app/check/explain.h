#pragma once
#include "app/check/statistics.h"
#include "core/base/thread_pool.h"

#include <nlohmann/json_fwd.hpp>

#include <limits>
#include <map>
#include <optional>

namespace tyndall {

struct CheckOptions {
  double seconds = 20;  ///< for all of it, but for what is needed for any answer
  int samples = 0;      ///< that are taken of each pixel for a program; 0: as many as the time allows
};

/// A picture rendered to measure another one against.
struct Reference {
  LinearImage image;
  std::vector<float> variance;  ///< of each number of the image, from two halves of the samples
};

/// Renders the scene until the noise is small against the difference from `picture`, which has the scene's size, or
/// a limit is reached, which the first samples may exceed. go_on: asked now and then; false ends it. Pixels share no
/// paths, so that their errors are independent.
Reference render_reference(Scene scene, const LinearImage& picture, double seconds, std::uint32_t spp,
                           const std::function<bool()>& go_on);

/// How the means of a picture differ from what is expected.
struct Differences {
  std::vector<CellDifference> small, large, objects;  ///< of small blocks, of large ones, of the objects seen
  std::vector<CellDifference> all;                    ///< these three, one behind the other
  std::vector<CellDifference> whole;                  ///< of the picture

  double amount() const { return amount_of(all, all); }
  /// Whether the small blocks differ by noise alone. The noise of few samples is no normal distribution: so now and
  /// then one of them is beyond noise_limit.
  bool agree_in_blocks() const;
  /// Whether all of them do.
  bool agree() const;
  /// How much of the differences is left with `now` in place of these, as far as the two differ at all.
  double left_by(const Differences& now) const;
  /// How much of the differences is gone; nothing, if `after` is so noisy that little of them could be seen beside its
  /// noise.
  double gone(const Differences& after) const;
  /// Fraction of the light by which the whole may be off without that it is seen.
  double unseen_light() const;
};

/// The pictures that are expected of programs, and how the user's picture differs from them.
///
/// The mean of a picture is not that of its light: white cuts off what is brighter, which lowers the mean of noisy
/// pixels. So what is expected of a program is what its samples show of means of as many as the picture has, cut at
/// white; and what those of the scene itself, of the same random numbers, happened to miss of the scene, rendered well,
/// as far as it gets through the cut. How far that is, their covariance tells (J. M. Hammersley, D. C. Handscomb, Monte
/// Carlo Methods, 5.5: control variates).
class Expectation {
 public:
  Expectation(const PictureNumbers& picture, const Scene& scene, const Reference& reference,
              const CheckOptions& options, const std::function<bool()>& go_on);

  /// The program that renders the scene as it is.
  const BookProgram& start() const { return start_; }
  const SeenObjects& seen() const { return seen_; }
  int block_edge() const { return edge_ * lattice_.step; }  ///< of a small block, in pixels
  /// The numbers that the picture's noise may stand for if a program's samples are those of the picture's program, the
  /// likeliest first; 0: not known. White makes few samples show as little noise as many.
  std::vector<double> likely_samples(const std::vector<BookSample>& of_program, const Reading& reading) const;
  /// Fraction of the small blocks in which the samples show about as much light as there is. The others are left out.
  double comparable() const { return comparable_; }
  /// Whether so much of the samples is brighter than white that their number decides what the picture looks like.
  bool white_matters() const;

  /// Of the scene as it is.
  const std::vector<BookSample>& start_samples() const { return samples_; }
  /// Renders a program; empty: there is no time left; in_time: whether that matters.
  std::vector<BookSample> samples_of(const BookProgram& program, bool in_time);
  /// What is expected of a program with these samples if the picture has `count` samples a pixel; 0: not known.
  ExpectedPixels expected_of(const std::vector<BookSample>& samples, double count) const;
  Differences differences(const ExpectedPixels& expected, const Reading& reading);

 private:
  void take_samples(const CheckOptions& options);
  Regions without_rare_light(Regions regions) const;
  double white() const { return picture_.coded ? 1 : std::numeric_limits<double>::infinity(); }

  const PictureNumbers& picture_;
  BookProgram start_;
  Lattice lattice_;
  int edge_;  ///< of a small block, in pixels of the lattice
  ExpectedPixels reference_;
  ThreadPool threads_;
  const std::function<bool()>& go_on_;
  SeenObjects seen_;
  Regions small_, large_, objects_, whole_;
  int count_ = 0;  ///< samples that were taken of each pixel
  double comparable_ = 1;
  std::vector<BookSample> samples_;
  std::vector<SampleStatistics> single_;  ///< of these, as if the picture had one
  std::map<Reading, ReadPixels> read_;    ///< the picture, as the right readings take it
};

/// How a picture differs from the scene as a few samples of each pixel show it: enough to tell whether it is a picture
/// of this scene at all.
std::vector<CellDifference> rough_differences(const PictureNumbers& picture, const Scene& scene);

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
