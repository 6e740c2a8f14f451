#include "app/check/check.h"

#include "core/base/seconds.h"

#include <chrono>
#include <limits>
#include <map>
#include <memory>
#include <utility>

namespace tyndall {
namespace {

constexpr double promising = 0.2;          // of a difference is explained where it is worth looking closer
constexpr double clear_improvement = 0.7;  // of a difference is left where it has become clearly less
constexpr double min_comparable = 0.5;     // of the blocks must be comparable for an answer
constexpr double max_unseen = 0.3;         // of the light, by which a picture that agrees may be off unseen
constexpr std::size_t max_looked_at = 3;   // mistakes that are looked at closely

/// A program that may have made the picture, which is the scene's with choices of editions and then with a mistake, and
/// what is expected of its pictures.
struct Model {
  std::vector<Difference> choices{};
  std::optional<Difference> mistake{};
  double samples = 0;  ///< a pixel, that the user's picture has if it is one of them; 0: not known
  LatticeLight expected{};
};

/// A way in which the picture may have been made, and how the means of the picture differ from what is expected then.
struct Fit {
  std::shared_ptr<const Model> model;
  Reading reading;
  std::vector<CellDifference> small, large, objects;  ///< of small blocks, of large ones, of the objects seen
  std::vector<CellDifference> whole;                  ///< of the picture
  std::vector<CellDifference> all{};                  ///< the first three, one behind the other

  double amount() const { return amount_of(all, all); }

  /// Whether the small blocks differ by noise alone. The noise of few samples is no normal distribution: so now and
  /// then one of them is beyond noise_limit.
  bool agrees_in_blocks() const {
    constexpr double max_different = 1 / 150.0;
    const Misfit misfit = misfit_of(small);
    return misfit.different <= max_different * misfit.blocks;
  }

  /// Whether all of them do.
  bool agrees() const {
    return agrees_in_blocks() && misfit_of(large).different == 0 && misfit_of(objects).different == 0 &&
           misfit_of(whole).different == 0;
  }

  /// How much of the differences is left with `now` in place of these, as far as the two differ at all.
  double left_by(const Fit& now) const {
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
  double gone(const Fit& after) const {
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

/// The search for what explains a picture.
///
/// The mean of a picture is not that of its light: white cuts off what is brighter, which lowers the mean of noisy
/// pixels. So what is expected of a program is what its samples show of means of as many as the picture has, cut at
/// white; and what those of the scene itself, of the same random numbers, happened to miss of the scene, rendered well,
/// as far as it gets through the cut. How far that is, their covariance tells (J. M. Hammersley, D. C. Handscomb, Monte
/// Carlo Methods, 5.5: control variates).
class Search {
 public:
  Search(const PictureNumbers& picture, const Scene& scene, const NoisyImage& reference, const CheckOptions& options,
         const std::function<bool()>& go_on)
      : picture_(picture),
        start_(plain_program(scene)),
        lattice_(lattice_of(picture.width, picture.height)),
        reference_(on_lattice(reference)),
        go_on_(go_on),
        right_readings_(readings_of(picture.coded, true)) {
    const int edge = edge_of_blocks(lattice_);
    small_ = blocks_of(lattice_, edge), large_ = blocks_of(lattice_, 4 * edge);
    SeenObjects& seen = findings_.seen = seen_objects(scene, lattice_);
    for (std::size_t pixel = 0; pixel < seen.of_pixel.size(); ++pixel)
      if (seen.at(pixel).noisy_texture) small_.of_pixel[pixel] = large_.of_pixel[pixel] = -1;
    take_samples(options);
    const auto kept = [this] { return std::ranges::count_if(small_.of_pixel, [](int region) { return region >= 0; }); };
    const auto pixels = static_cast<double>(kept());
    for (Regions* regions : {&small_, &large_, &seen.regions}) leave_out_rare_light(*regions, single_, reference_);
    findings_.unknown = pixels > 0 && static_cast<double>(kept()) / pixels < min_comparable;
    whole_ = {small_.of_pixel, 1};
    for (int& region : whole_.of_pixel) region = std::min(region, 0);
    findings_.block_edge = edge * lattice_.step;
    findings_.seconds = options.seconds;
  }

  Findings run() {
    const Fit right = best_right();
    describe(right);
    if (findings_.agrees || findings_.unknown || findings_.too_few) return std::move(findings_);
    try_readings(right);
    for (const int depth : likely_depths(right)) try_mistake(right, shorter_paths(depth), false);
    for (const Difference& mistake : usual_mistakes()) try_mistake(right, mistake, true);
    std::ranges::stable_sort(findings_.tried, std::greater{}, &Difference::explained);
    if (!right.agrees_in_blocks()) name_mistake(right);
    return std::move(findings_);
  }

 private:
  /// The light of a picture, and the variance of its noise.
  LatticeLight on_lattice(NoisyImage image) const {
    const auto read = [this](const std::vector<float>& numbers) {
      return read_pixels({lattice_.width, lattice_.height, numbers}, lattice_, {TransferCurve::light}).light;
    };
    for (float& number : image.deviation) number *= number;
    return {read(image.mean), {}, read(image.deviation)};
  }

  /// Takes the samples of the scene as it is: as many as the time allows.
  void take_samples(const CheckOptions& options) {
    constexpr int fewest = 4, limit = 24;
    constexpr double part_for_samples = 1 / 60.0;  // of the time, for the samples of one program
    const auto begin = std::chrono::steady_clock::now();
    count_ = options.samples;
    if (count_ == 0) {
      count_ = fewest;
      book_samples(start_, lattice_, count_);
      const double fit = options.seconds * part_for_samples * fewest / std::max(seconds_since(begin), 1e-6);
      count_ = static_cast<int>(std::clamp(fit, 1.0 * fewest, 1.0 * limit));
    }
    samples_ = book_samples(start_, lattice_, count_);
    single_ = statistics_of(samples_, count_, {});
  }

  double white() const { return picture_.coded ? 1 : std::numeric_limits<double>::infinity(); }

  /// Whether so much of the samples is brighter than white that their number decides what the picture looks like.
  bool white_matters() const {
    constexpr double min_cut = 0.02;  // of the light of single samples, that white cuts off
    double cut = 0, all = 0;
    for (const SampleStatistics& number : single_) cut += number.excess, all += number.mean;
    return picture_.coded && cut > min_cut * all;
  }

  /// Samples of what a suspect renders; empty: there is nothing that its choices or its mistake would change, or there
  /// is no time left. in_time: whether that matters.
  std::vector<BookSample> samples_of(const Model& suspect, bool in_time) const {
    if (suspect.choices.empty() && !suspect.mistake) return samples_;
    BookProgram program = start_;
    for (const Difference& choice : suspect.choices)
      if (!choice.apply(program)) return {};
    if (suspect.mistake && !suspect.mistake->apply(program)) return {};
    return book_samples(program, lattice_, count_, in_time ? go_on_ : std::function<bool()>());
  }

  /// Adds what is expected of a suspect of whose program these samples were taken. count: samples a pixel that the
  /// picture has; 0: not known.
  std::shared_ptr<const Model> model_of(Model suspect, const std::vector<BookSample>& samples, double count) const {
    const int group = count > 0 ? std::clamp(static_cast<int>(std::lround(count)), 1, count_) : count_;
    const auto now = statistics_of(samples, count_, {group, white()}, &samples_);
    const Numbers common = means_of(large_, now, &SampleStatistics::common),
                  variance = means_of(large_, single_, &SampleStatistics::variance);
    Numbers ratios;
    if (picture_.coded && count > count_ * 1.2) ratios = excess_ratios(samples, count_, count, large_);
    suspect.samples = count;
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
      suspect.expected.light.push_back(now[at].mean - excess + missed);
      // A picture of unknown samples shows by itself alone how noisy it is.
      suspect.expected.variance.push_back(count > 0 ? now[at].noise * group / count : 0);
    }
    return std::make_shared<const Model>(std::move(suspect));
  }

  Fit fit(const std::shared_ptr<const Model>& model, const Reading& reading) {
    LatticeLight wrong;  // such a reading is tried once
    LatticeLight& pixels = reading.is_right() ? read_[reading.curve] : wrong;
    if (pixels.light.empty()) pixels = read_pixels(picture_, lattice_, reading);
    const auto differ = [&](const Regions& regions) { return differences_of(pixels, model->expected, regions); };
    Fit found{model, reading, differ(small_), differ(large_), differ(findings_.seen.regions), differ(whole_)};
    for (const auto* part : {&found.small, &found.large, &found.objects})
      found.all.insert(found.all.end(), part->begin(), part->end());
    return found;
  }

  Fit closest_reading(const std::shared_ptr<const Model>& model, const std::vector<Reading>& readings) {
    std::vector<Fit> fits;
    for (const Reading& reading : readings) fits.push_back(fit(model, reading));
    return *std::ranges::min_element(fits, {}, &Fit::amount);
  }

  /// The fit that is closest over the numbers of samples that the picture's noise may stand for.
  Fit closest(const Model& suspect, const std::vector<Reading>& readings, const std::vector<BookSample>& taken) {
    const Reading rough = closest_reading(model_of(suspect, taken, 0), readings).reading;
    std::optional<Fit> best;
    const LatticeLight read = read_pixels(picture_, lattice_, rough);
    for (const auto& [off, samples] : likely_counts(read, reference_, taken, count_, small_, white())) {
      Fit found = closest_reading(model_of(suspect, taken, samples), readings);
      const auto amount = [](const Fit& a, const Fit& b) { return amount_of(a.all, b.all); };  // with the same noise
      if (!best || found.agrees() || amount(found, *best) < clear_improvement * amount(*best, found))
        best = std::move(found);
      if (best->agrees() || !white_matters()) break;
    }
    return *best;
  }

  /// Takes over the choices of editions that bring the picture clearly closer to the program's, where they show at all,
  /// or with which nothing but noise is left.
  Fit with_choices(Fit best) {
    for (int round = 0; round < 2; ++round)  // a small one may show after a large one
      for (const Difference& choice : usual_choices()) {
        if (best.agrees()) return best;
        Model suspect{best.model->choices, best.model->mistake, best.model->samples};
        suspect.choices.push_back(choice);
        const std::shared_ptr<const Model> model = known_model_of(suspect);
        if (!model) continue;
        Fit other = fit(model, best.reading);
        if (other.agrees() || best.left_by(other) <= clear_improvement) best = std::move(other);
      }
    return best;
  }

  /// Of choices with or without a mistake; null: see samples_of(). Kept for other readings.
  std::shared_ptr<const Model> known_model_of(const Model& suspect) {
    std::string names;
    for (const Difference& choice : suspect.choices) names += " " + choice.name;
    const auto [known, is_new] = known_.try_emplace(names);
    if (is_new)
      if (const auto taken = samples_of(suspect, suspect.mistake.has_value()); !taken.empty())
        known->second = model_of(suspect, taken, suspect.samples);
    return known->second;
  }

  /// The program without mistakes that is closest to the picture.
  Fit best_right() {
    const Fit start = closest({}, right_readings_, samples_);
    std::vector<Fit> fits;
    for (const Reading& reading : right_readings_) fits.push_back(with_choices(fit(start.model, reading)));
    return *std::ranges::min_element(fits, {}, [](const Fit& fit) { return std::pair(!fit.agrees(), fit.amount()); });
  }

  /// What the findings say of the picture without mistakes.
  void describe(const Fit& right) {
    const Misfit small = misfit_of(right.small);
    findings_.blocks = small.blocks, findings_.different = small.different;
    findings_.curve = right.reading.curve, findings_.samples = right.model->samples;
    findings_.choices = right.model->choices;
    const bool agree = !findings_.unknown && right.agrees();
    findings_.unseen = right.unseen_light();
    findings_.too_few = agree && findings_.unseen > max_unseen;
    findings_.agrees = agree && !findings_.too_few;
    const double times = findings_.unseen / max_unseen;
    findings_.enough = std::ceil(findings_.samples * times * times);
    findings_.objects = differing_objects(findings_.seen, right.objects);
  }

  /// A wrong reading must be clearly better than the best right one.
  void try_readings(const Fit& right) {
    const Fit best = closest_reading(right.model, readings_of(picture_.coded, false));
    if (best.amount() >= clear_improvement * right.amount()) return;
    findings_.tried.push_back(mistake_of(best.reading));
    findings_.tried.back().explained = right.gone(best);
  }

  /// The two lengths of paths by which the scene would be about as dark as the picture.
  std::vector<int> likely_depths(const Fit& right) const {
    double light = 0, expected = 0;
    for (const CellDifference& cell : right.whole) light += cell.expected + cell.difference, expected += cell.expected;
    const Numbers by_depth = light_by_depth(samples_);
    const int max_depth = std::min(static_cast<int>(by_depth.size()), start_.scene.render.max_depth);
    int above = 0;
    while (above < max_depth && by_depth[static_cast<std::size_t>(above)] * expected < light) ++above;
    std::vector<int> depths;
    for (const int depth : {above, above - 1})
      if (depth >= 0 && depth < max_depth) depths.push_back(depth);
    return depths;
  }

  /// Which right curve the picture has may only be seen together with the mistake: the best one counts.
  void try_mistake(const Fit& right, Difference mistake, bool in_time) {
    const Model suspect{right.model->choices, mistake};
    if (BookProgram program = start_; !mistake.apply(program)) return;
    const std::vector<BookSample> taken = samples_of(suspect, in_time);
    if (taken.empty()) {
      ++findings_.untried;
      return;
    }
    const auto model = model_of(suspect, taken, right.model->samples);
    mistake.reading = right.reading;
    mistake.explained = right.gone(fit(model, right.reading));
    for (const Reading& reading : right_readings_) {
      if (mistake.explained < promising) break;
      const double part = right.gone(fit(model, reading));
      if (part > mistake.explained) mistake.explained = part, mistake.reading = reading;
    }
    findings_.tried.push_back(std::move(mistake));
  }

  /// Names a mistake if the picture agrees with those that are made with it, with choices of editions that may not have
  /// been seen beside it: never the best of those for which there was time.
  void name_mistake(const Fit& right) {
    for (std::size_t k = 0; k < std::min(max_looked_at, findings_.tried.size()); ++k) {
      Difference mistake = findings_.tried[k];
      if (findings_.untried > 0 || mistake.explained < promising) return;
      const Model suspect{{}, mistake};
      const std::vector<BookSample> taken = samples_of(suspect, true);
      if (taken.empty()) {
        ++findings_.untried;
        return;
      }
      known_.clear();
      const Fit found = with_choices(closest(suspect, {mistake.reading}, taken));
      mistake.explained = right.gone(found);
      if (!found.agrees() || mistake.explained < promising) continue;
      const Model innocent{found.model->choices};
      const auto model = model_of(innocent, samples_of(innocent, false), found.model->samples);
      describe(fit(model, found.reading.is_right() ? found.reading : right.reading));
      if (!findings_.agrees && !findings_.too_few) findings_.mistake = mistake;
      return;
    }
  }

  const PictureNumbers& picture_;
  BookProgram start_;  ///< renders the scene as it is
  Lattice lattice_;
  LatticeLight reference_;
  const std::function<bool()>& go_on_;
  std::vector<Reading> right_readings_;
  Regions small_, large_, whole_;
  int count_ = 0;                               ///< samples that were taken of each pixel
  std::vector<BookSample> samples_;             ///< of the program that renders the scene as it is
  std::vector<SampleStatistics> single_;        ///< of these, as if the picture had one
  std::map<TransferCurve, LatticeLight> read_;  ///< the picture, as the right readings take it
  Findings findings_;
  std::map<std::string, std::shared_ptr<const Model>> known_;  ///< by the names of choices
};

}  // namespace

Findings explain(const PictureNumbers& picture, const Scene& scene, const NoisyImage& reference,
                 const CheckOptions& options, const std::function<bool()>& go_on) {
  return Search(picture, scene, reference, options, go_on).run();
}

}  // namespace tyndall
