#pragma once
#include "app/check/statistics.h"
#include "core/base/seconds.h"

#include <chrono>
#include <limits>
#include <map>

namespace tyndall {

/// How the means of a picture differ from what is expected.
struct Differences {
  std::vector<CellDifference> small, large, objects;  ///< of small blocks, of large ones, of the objects seen
  std::vector<CellDifference> all;                    ///< these three, one behind the other
  std::vector<CellDifference> whole;                  ///< of the picture

  double amount() const { return amount_of(all, all); }

  /// Whether the small blocks differ by noise alone. The noise of few samples is no normal distribution: so now and
  /// then one of them is beyond noise_limit.
  bool agree_in_blocks() const {
    constexpr double max_different = 1 / 150.0;
    const Misfit misfit = misfit_of(small);
    return misfit.different <= max_different * misfit.blocks;
  }

  /// Whether all of them do.
  bool agree() const {
    return agree_in_blocks() && misfit_of(large).different == 0 && misfit_of(objects).different == 0 &&
           misfit_of(whole).different == 0;
  }

  /// How much of the differences is left with `now` in place of these, as far as the two differ at all.
  double left_by(const Differences& now) const {
    double before = 0, after = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const CellDifference &a = all[k], &b = now.all[k];
      const double error = std::max(a.error, b.error);
      if (a.pixels == 0 || std::abs(a.difference - b.difference) <= a.tolerance + 2 * error) continue;
      const double weight = a.pixels / a.tolerance;
      before += weight * std::max(0.0, std::abs(a.difference) - 2 * error);
      after += weight * std::max(0.0, std::abs(b.difference) - 2 * error);
    }
    return before > 0 ? after / before : 1;
  }

  /// How much of the differences is gone; nothing, if `after` is so noisy that little of them could be seen beside its
  /// noise.
  double gone(const Differences& after) const {
    constexpr double min_seen = 0.25;
    const double seen = amount_of(all, after.all);
    return seen > min_seen * amount() ? 1 - amount_of(after.all, all) / seen : 0;
  }

  /// Fraction of the light by which the whole may be off without that it is seen.
  double unseen_light() const {
    double light = 0, unseen = 0;
    for (const CellDifference& channel : whole)
      light += channel.expected, unseen += channel.tolerance + noise_limit * channel.error;
    return light > 0 ? unseen / light : 0;
  }
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
  Expectation(const PictureNumbers& picture, const Scene& scene, const NoisyImage& reference,
              const CheckOptions& options, const std::function<bool()>& go_on)
      : picture_(picture),
        start_(plain_program(scene)),
        lattice_(lattice_of(picture.width, picture.height)),
        edge_(edge_of_blocks(lattice_)),
        reference_{on_lattice(reference.mean), {}, on_lattice(squares_of(reference.deviation))},
        go_on_(go_on),
        seen_(seen_objects(scene, lattice_)),
        small_(blocks_of(lattice_, edge_)),
        large_(blocks_of(lattice_, large_edge * edge_)) {
    for (std::size_t pixel = 0; pixel < seen_.of_pixel.size(); ++pixel)
      if (seen_.at(pixel).noisy_texture) small_.of_pixel[pixel] = large_.of_pixel[pixel] = -1;
    take_samples(options);
    const auto kept = [this] { return std::ranges::count_if(small_.of_pixel, [](int region) { return region >= 0; }); };
    const auto pixels = static_cast<double>(kept());
    for (Regions* regions : {&small_, &large_, &seen_.regions}) leave_out_rare_light(*regions);
    comparable_ = pixels > 0 ? static_cast<double>(kept()) / pixels : 1;
    whole_ = {small_.of_pixel, 1};
    for (int& region : whole_.of_pixel) region = std::min(region, 0);
  }

  /// The program that renders the scene as it is, and its samples.
  const BookProgram& start() const { return start_; }
  const std::vector<BookSample>& start_samples() const { return samples_; }
  const SeenObjects& seen() const { return seen_; }
  int block_edge() const { return edge_ * lattice_.step; }  ///< of a small block, in pixels
  /// Fraction of the small blocks in which the samples show about as much light as there is. The others are left out.
  double comparable() const { return comparable_; }

  /// Whether so much of the samples is brighter than white that their number decides what the picture looks like.
  bool white_matters() const {
    constexpr double min_cut = 0.02;  // of the light of single samples, that white cuts off
    double cut = 0, all = 0;
    for (const SampleStatistics& number : single_) cut += number.excess, all += number.mean;
    return picture_.coded && cut > min_cut * all;
  }

  /// The numbers that the picture's noise may stand for if a program's samples are those of the picture's program, the
  /// likeliest first; 0: not known. White makes few samples show as little noise as many.
  std::vector<double> likely_samples(const std::vector<BookSample>& of_program, const Reading& reading) const {
    return likely_counts(read_pixels(picture_, lattice_, reading), reference_, of_program, count_, small_, white());
  }

  /// Renders a program; empty: there is no time left; in_time: whether that matters.
  std::vector<BookSample> samples_of(const BookProgram& program, bool in_time) const {
    return book_samples(program, lattice_, count_, in_time ? go_on_ : std::function<bool()>());
  }

  /// What is expected of a program with these samples if the picture has `count` samples a pixel; 0: not known.
  LatticeLight expected_of(const std::vector<BookSample>& samples, double count) const {
    const int group = count > 0 ? std::clamp(static_cast<int>(std::lround(count)), 1, count_) : count_;
    const auto now = statistics_of(samples, count_, {group, white()}, &samples_);
    const Numbers common = means_of(large_, now, &SampleStatistics::common),
                  variance = means_of(large_, single_, &SampleStatistics::variance);
    Numbers ratios;
    if (picture_.coded && count > count_ * 1.2) ratios = excess_ratios(samples, count_, count, large_);
    LatticeLight expected;
    for (std::size_t at = 0; at < now.size(); ++at) {
      const std::size_t cell = large_.cell_of(at);
      const bool known = cell != Regions::no_cell;
      // What it has of the luck of the scene's own samples.
      const double passes =
          known && variance[cell] > 0 ? std::clamp(common[cell] * group / variance[cell], 0.0, 1.0) : 1;
      const double missed = passes * (reference_.light[at] - single_[at].mean);
      double excess = now[at].excess;
      if (known && !ratios.empty())  // means of few samples are too noisy; no pixel is brighter than white
        excess = std::max(excess * std::min(1.0, ratios[cell]), now[at].mean + missed - 1);
      expected.light.push_back(now[at].mean - excess + missed);
      // A picture of unknown samples shows by itself alone how noisy it is.
      expected.variance.push_back(count > 0 ? now[at].noise * group / count : 0);
    }
    return expected;
  }

  Differences differences(const LatticeLight& expected, const Reading& reading) {
    LatticeLight& pixels = read_[reading];
    if (pixels.light.empty()) pixels = read_pixels(picture_, lattice_, reading);
    Differences result{differences_of(pixels, expected, small_),
                       differences_of(pixels, expected, large_),
                       differences_of(pixels, expected, seen_.regions),
                       {},
                       differences_of(pixels, expected, whole_)};
    for (const auto* part : {&result.small, &result.large, &result.objects})
      result.all.insert(result.all.end(), part->begin(), part->end());
    if (!reading.is_right()) read_.erase(reading);  // those are tried once
    return result;
  }

 private:
  static constexpr int large_edge = 4;  // of a large block, in small ones

  static std::vector<float> squares_of(std::vector<float> numbers) {
    for (float& number : numbers) number *= number;
    return numbers;
  }

  /// Three numbers of each pixel of the lattice.
  Numbers on_lattice(const std::vector<float>& whole) const {
    return read_pixels({lattice_.width, lattice_.height, whole}, lattice_, {TransferCurve::light}).light;
  }

  /// Leaves out the regions in which the samples show quite another amount of light than there is: it comes on few
  /// paths, so that nobody knows how often white cuts it off.
  void leave_out_rare_light(Regions& regions) const {
    constexpr double rare_light = 0.5, dark = 0.003;  // of the light of a region, and light, that samples may be off
    const Numbers sampled = means_of(regions, single_, &SampleStatistics::mean),
                  right = means_of(regions, reference_.light);
    for (int& region : regions.of_pixel) {
      if (region < 0) continue;
      const auto first = 3 * static_cast<std::size_t>(region);
      const double light = right[first] + right[first + 1] + right[first + 2];
      const double off = sampled[first] + sampled[first + 1] + sampled[first + 2] - light;
      if (std::abs(off) > rare_light * light + dark) region = -1;
    }
  }

  /// Takes the samples of the scene as it is: as many as the time allows.
  void take_samples(const CheckOptions& options) {
    constexpr int fewest = 4, limit = 24;
    constexpr double part_for_samples = 1 / 60.0;  // of the time, for the samples of one program
    const auto begin = std::chrono::steady_clock::now();
    count_ = options.samples;
    if (count_ == 0) {
      count_ = fewest;
      samples_of(start_, false);
      const double fit = options.seconds * part_for_samples * fewest / std::max(seconds_since(begin), 1e-6);
      count_ = static_cast<int>(std::clamp(fit, 1.0 * fewest, 1.0 * limit));
    }
    samples_ = samples_of(start_, false);
    single_ = statistics_of(samples_, count_, {});
  }

  double white() const { return picture_.coded ? 1 : std::numeric_limits<double>::infinity(); }

  const PictureNumbers& picture_;
  BookProgram start_;
  Lattice lattice_;
  int edge_;  ///< of a small block, in pixels of the lattice
  LatticeLight reference_;
  const std::function<bool()>& go_on_;
  SeenObjects seen_;
  Regions small_, large_, whole_;
  int count_ = 0;  ///< samples that were taken of each pixel
  double comparable_ = 1;
  std::vector<BookSample> samples_;
  std::vector<SampleStatistics> single_;  ///< of these, as if the picture had one
  std::map<Reading, LatticeLight> read_;  ///< the picture, as the right readings take it
};

}  // namespace tyndall
