#include "app/check/explain.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {
namespace {

constexpr double max_different = 1 / 150.0;  // of the small blocks of a picture that agrees
constexpr double min_seen = 0.25;            // of a difference must be seen beside the noise of a mistake's picture
constexpr double promising = 0.2;            // of a difference is explained where it is worth looking closer
constexpr double min_explained = 0.95;     // of a difference that blocks alone do not show, by a mistake that is named
constexpr double min_comparable = 0.5;     // of the blocks must be comparable for an answer
constexpr double clear_improvement = 0.7;  // of a difference is left where a choice is taken for the program's
constexpr double max_unseen = 0.3;         // of the light, by which a picture that agrees may be off unseen
constexpr std::size_t max_looked_at = 3;   // mistakes that are looked at closely

/// A program, what is expected of its picture, and how far the user's picture is from that.
struct Fit {
  BookProgram program;
  Reading reading;
  BookModel model;
  RegionDifferences regions;
};

/// A mistake that was tried, and how its pictures are made and read.
struct Candidate {
  Explanation told;
  std::optional<BookProgram> program;  ///< nothing: that without mistakes
  int max_depth = -1;                  ///< light found after more scattering events is left out; negative: none is
  Reading reading;
};

std::string joined(const std::vector<std::pair<bool, const char*>>& parts, const std::string& between) {
  std::string text;
  for (const auto& [wanted, part] : parts)
    if (wanted) text += (text.empty() ? "" : between) + part;
  return text;
}

std::string name_of_reading(const Reading& r) {
  return joined({{r.upside_down, "upside-down"},
                 {r.mirrored, "mirrored"},
                 {r.swapped, "red-blue"},
                 {r.curve == TransferCurve::none, "no-gamma"},
                 {r.curve == TransferCurve::gamma2_twice, "gamma-twice"}},
                "+");
}

std::string words_of_reading(const Reading& r) {
  return joined({{r.upside_down && r.mirrored, "the picture is turned by 180 degrees"},
                 {r.upside_down && !r.mirrored, "the picture is upside down"},
                 {!r.upside_down && r.mirrored, "the picture is mirrored, left and right"},
                 {r.swapped, "red and blue have changed places"},
                 {r.curve == TransferCurve::none, "light is written without gamma"},
                 {r.curve == TransferCurve::gamma2_twice, "gamma is applied twice"}},
                ", and ");
}

/// How much of the difference is left with `b` in place of `a`, as far as the two differ at all.
double left_by(const RegionDifferences& a, const RegionDifferences& b) {
  double before = 0, after = 0;
  for (std::size_t k = 0; k < a.all.size(); ++k) {
    const BlockDifference &old = a.all[k], &now = b.all[k];
    const double error = std::max(old.error, now.error);
    if (old.pixels == 0 || std::abs(old.difference - now.difference) <= old.tolerance + 2 * error) continue;
    const double weight = old.pixels / old.tolerance;
    before += weight * std::max(0.0, std::abs(old.difference) - 2 * error);
    after += weight * std::max(0.0, std::abs(now.difference) - 2 * error);
  }
  return before > 0 ? after / before : 1;
}

/// Fraction of the light of samples that is found after at most so many scattering events, from 0 on.
std::vector<double> light_by_depth(const std::vector<BookSample>& samples) {
  std::vector<double> light;
  for (const BookSample& sample : samples) {
    if (light.size() <= static_cast<std::size_t>(sample.depth))
      light.resize(static_cast<std::size_t>(sample.depth) + 1);
    light[static_cast<std::size_t>(sample.depth)] +=
        static_cast<double>(sample.light.x + sample.light.y + sample.light.z);
  }
  for (std::size_t k = 1; k < light.size(); ++k) light[k] += light[k - 1];
  for (double& value : light) value /= std::max(light.back(), 1e-30);
  return light;
}

/// Whether clearly less of a difference is left, where both have the same noise.
bool clearly_closer(const RegionDifferences& a, const RegionDifferences& b) {
  return amount_of(a.all, b.all) < clear_improvement * amount_of(b.all, a.all);
}

/// The search for what explains a picture.
class Search {
 public:
  Search(const PictureNumbers& picture, const Scene& scene, const Reference& reference, const CheckOptions& options,
         const std::function<bool()>& go_on)
      : picture_(picture), expectation_(picture, scene, reference, options, go_on) {
    findings_.seconds = options.seconds;
  }

  Findings run() {
    fit_samples();
    Fit right = best_choices(start_model());
    describe(right);
    if (findings_.agrees || findings_.unknown || findings_.too_few) return std::move(findings_);
    right_samples_ = expectation_.samples_of(right.program, false);
    if (const Reading best = best_reading(right.model, false); !is_right(best)) try_reading(right, best);
    try_depths(right);
    for (const Difference& mistake : usual_mistakes()) try_mistake(right, mistake);
    name_mistake(right);
    return std::move(findings_);
  }

 private:
  Fit fit(const BookProgram& program, const Reading& reading, const BookModel& model) {
    return {program, reading, model, expectation_.differences(model, reading)};
  }

  /// The reading that fits best. A wrong one must be clearly better than the best right one; only_right: none is tried.
  Reading best_reading(const BookModel& model, bool only_right) {
    std::optional<Reading> right, wrong;
    double of_right = 0, of_wrong = 0;
    for (const Reading& reading : readings_of(picture_.coded)) {
      if (!is_right(reading) && (only_right || (wrong_ && !(reading == *wrong_)))) continue;
      const double found = expectation_.differences(model, reading).amount();
      std::optional<Reading>& best = is_right(reading) ? right : wrong;
      double& min_found = is_right(reading) ? of_right : of_wrong;
      if (!best || found < min_found) best = reading, min_found = found;
    }
    if (wrong) wrong_ = wrong;
    return wrong && of_wrong < clear_improvement * of_right ? *wrong : *right;
  }

  BookModel start_model() const { return expectation_.model_of(expectation_.start_samples()); }

  /// Where white cuts off much, the noise tells the number of samples only roughly: takes the one that fits best.
  void fit_samples() {
    const std::vector<double> likely =
        expectation_.likely_samples(expectation_.start_samples(), best_reading(start_model(), false));
    double best = likely.front();
    std::optional<RegionDifferences> closest;
    for (const double samples : likely) {
      expectation_.set_samples(samples);
      const BookModel model = start_model();
      RegionDifferences found = expectation_.differences(model, best_reading(model, true));
      if (agrees(found) || (!closest && !expectation_.white_matters())) return;
      if (!closest || clearly_closer(found, *closest)) best = samples, closest = std::move(found);
    }
    expectation_.set_samples(best);
  }

  /// The program by whose choices the picture fits best, with the right reading that goes with it. Editions can be told
  /// apart in an upside-down picture, too, once it is turned.
  Fit best_choices(const BookModel& start) {
    std::vector<Reading> tried{best_reading(start, false)};
    for (const Reading& reading : readings_of(picture_.coded))
      if (is_right(reading) && is_right(tried.front()) && !(reading == tried.front())) tried.push_back(reading);
    std::optional<Fit> best;
    for (const Reading& reading : tried) {
      std::vector<Explanation> choices;
      Fit found = choose(fit(expectation_.start(), reading, start), choices);
      const auto rank = [](const Fit& fit) { return std::pair(!agrees(fit.regions), fit.regions.amount()); };
      if (best && rank(found) >= rank(*best)) continue;
      best = std::move(found), findings_.choices = std::move(choices);
    }
    const Reading reading = is_right(best->reading) ? best->reading : best_reading(best->model, true);
    return fit(best->program, reading, best->model);
  }

  /// Takes over the choices of editions that bring the picture clearly closer to the program's, where they show at all.
  Fit choose(Fit best, std::vector<Explanation>& choices) {
    for (const Difference& choice : usual_choices()) {
      if (agrees(best.regions)) break;
      BookProgram program = best.program;
      if (!choice.apply(program)) continue;
      const auto known =
          std::find_if(known_.begin(), known_.end(), [&](const auto& model) { return model.first == program.rules; });
      const BookModel model =
          known != known_.end() ? known->second : expectation_.model_of(expectation_.samples_of(program, false));
      if (known == known_.end()) known_.emplace_back(program.rules, model);
      Fit other = fit(program, best.reading, model);
      const double left = left_by(best.regions, other.regions);
      if (left > clear_improvement) continue;
      best = std::move(other);
      choices.push_back({choice.name, choice.words, 1 - left});
    }
    return best;
  }

  static bool agrees_in_blocks(const RegionDifferences& regions) {
    const Misfit small = misfit_of(regions.of_small());
    return small.different <= max_different * small.blocks;
  }

  static bool agrees(const RegionDifferences& regions) {
    return agrees_in_blocks(regions) && misfit_of(regions.of_large()).different == 0 &&
           misfit_of(regions.of_objects()).different == 0 && misfit_of(regions.whole).different == 0;
  }

  /// What the findings say of the picture before mistakes are looked for.
  void describe(const Fit& right) {
    const Misfit small = misfit_of(right.regions.of_small());
    findings_.blocks = small.blocks, findings_.different = small.different;
    findings_.block_edge = expectation_.block_edge();
    findings_.curve = right.reading.curve, findings_.samples = expectation_.samples();
    findings_.seen = expectation_.seen();
    findings_.objects.clear();
    const auto objects = right.regions.of_objects();
    for (std::size_t k = 0; k < objects.size(); k += 3) {
      const auto channels = objects.subspan(k, 3);
      if (misfit_of(channels).different == 0) continue;
      const Vec3d expected{channels[0].expected, channels[1].expected, channels[2].expected};
      const Vec3d off{channels[0].difference, channels[1].difference, channels[2].difference};
      findings_.objects.push_back({static_cast<int>(k / 3), channels[0].pixels, expected + off, expected});
    }
    const auto amount = [](const ObjectDifference& d) {
      const Vec3d off = d.image - d.expected;
      return d.pixels * (std::abs(off.x) + std::abs(off.y) + std::abs(off.z));
    };
    std::sort(findings_.objects.begin(), findings_.objects.end(),
              [&](const ObjectDifference& a, const ObjectDifference& b) { return amount(a) > amount(b); });
    findings_.unknown = expectation_.comparable() < min_comparable;
    const bool agree = !findings_.unknown && agrees(right.regions);
    double light = 0, unseen = 0;
    for (const BlockDifference& channel : right.regions.whole)
      light += channel.expected, unseen += channel.tolerance + noise_limit * channel.error;
    findings_.unseen = light > 0 ? unseen / light : 0;
    findings_.too_few = agree && findings_.unseen > max_unseen;
    findings_.agrees = agree && !findings_.too_few;
    const double times = findings_.unseen / max_unseen;
    findings_.enough = std::ceil(findings_.samples * times * times);
  }

  /// How much of the difference is gone with another model and reading; nothing, if that is so noisy that little of the
  /// difference can be seen beside it.
  double gone_with(const Fit& right, const BookModel& model, const Reading& reading) {
    const RegionDifferences other = expectation_.differences(model, reading);
    const double before = amount_of(right.regions.all, other.all), after = amount_of(other.all, right.regions.all);
    return before > min_seen * right.regions.amount() ? 1 - after / before : 0;
  }

  /// Which right curve the picture has may only be seen together with the mistake: the best one counts.
  void judge(const Fit& right, const BookModel& model, Candidate candidate) {
    candidate.told.explained = gone_with(right, model, candidate.reading);
    for (const Reading& reading : readings_of(picture_.coded)) {
      if (candidate.told.explained < promising || !is_right(reading) || reading == right.reading) continue;
      const double gone = gone_with(right, model, reading);
      if (gone > candidate.told.explained) candidate.told.explained = gone, candidate.reading = reading;
    }
    candidates_.push_back(std::move(candidate));
  }

  void try_reading(const Fit& right, const Reading& best) {
    const double gone = gone_with(right, right.model, best);
    candidates_.push_back({{name_of_reading(best), words_of_reading(best), gone}, {}, -1, best});
  }

  /// Tries the two lengths of paths by which the scene would be about as dark as the picture.
  void try_depths(const Fit& right) {
    double light = 0, expected = 0;
    for (const BlockDifference& block : right.regions.of_small())
      light += block.pixels * (block.expected + block.difference), expected += block.pixels * block.expected;
    const std::vector<double> by_depth = light_by_depth(right_samples_);
    const int max_depth = expectation_.start().scene.render.max_depth;
    std::size_t above = 0;
    while (above < by_depth.size() && by_depth[above] * expected < light) ++above;
    for (const std::size_t depth : {above, above - 1})
      if (depth < by_depth.size() && static_cast<int>(depth) < max_depth) try_depth(right, static_cast<int>(depth));
  }

  void try_depth(const Fit& right, int depth) {
    Candidate candidate{{"depth-" + std::to_string(depth), "", 0}, {}, depth, right.reading};
    candidate.told.words =
        "paths end too early, after " + std::to_string(depth) + (depth == 1 ? " scattering" : " scatterings");
    if (depth == 0)
      candidate.told = {"attenuation-lost",
                        "what is hit sends on no light: attenuation is passed by value, or paths end at the first hit"};
    judge(right, expectation_.model_of(samples_of(candidate)), std::move(candidate));
  }

  void try_mistake(const Fit& right, const Difference& mistake) {
    Candidate candidate{{mistake.name, mistake.words, 0}, right.program, -1, right.reading};
    if (!mistake.apply(*candidate.program)) return;
    const std::vector<BookSample> samples = samples_of(candidate);
    if (samples.empty())
      ++findings_.untried;
    else
      judge(right, expectation_.model_of(samples), std::move(candidate));
  }

  /// Empty: there is no time left.
  std::vector<BookSample> samples_of(const Candidate& candidate) {
    std::vector<BookSample> samples =
        candidate.program ? expectation_.samples_of(*candidate.program, true) : right_samples_;
    for (BookSample& sample : samples)
      if (candidate.max_depth >= 0 && sample.depth > candidate.max_depth) sample.light = {};
    return samples;
  }

  /// How the picture differs from those that are made with the mistake, whose noise tells anew how many samples there
  /// are: by the number that fits best, which is left set.
  RegionDifferences closest(const Candidate& candidate, const std::vector<BookSample>& samples) {
    std::optional<RegionDifferences> best;
    double best_samples = 0;
    for (const double count : expectation_.likely_samples(samples, candidate.reading)) {
      expectation_.set_samples(count);
      RegionDifferences found = expectation_.differences(expectation_.model_of(samples), candidate.reading);
      if (best && !agrees(found) && !clearly_closer(found, *best)) continue;
      best = std::move(found), best_samples = count;
      if (agrees(*best)) break;
    }
    expectation_.set_samples(best_samples);
    return *best;
  }

  /// How much of the difference a mistake explains if the picture agrees with those that are made with it, and with
  /// choices of editions, which may not have been seen beside it; nothing: it does not agree. Where only larger parts
  /// than blocks had differed, other mistakes that make the picture darker would agree as well: so nearly all of the
  /// difference in blocks must be gone.
  std::optional<double> explained_by(Candidate candidate, const Fit& right) {
    std::vector<BookSample> samples = samples_of(candidate);
    if (samples.empty()) return ++findings_.untried, std::nullopt;
    RegionDifferences best = closest(candidate, samples);
    for (const Difference& choice : usual_choices()) {
      if (agrees(best)) break;
      Candidate other = candidate;
      if (!other.program) other.program = right.program;
      if (!choice.apply(*other.program)) continue;
      samples = samples_of(other);
      if (samples.empty()) return ++findings_.untried, std::nullopt;
      RegionDifferences found = expectation_.differences(expectation_.model_of(samples), other.reading);
      if (found.amount() < best.amount()) candidate = std::move(other), best = std::move(found);
    }
    const double explained = 1 - best.amount() / right.regions.amount();
    return agrees(best) && (explained >= min_explained || !agrees_in_blocks(right.regions)) ? std::optional(explained)
                                                                                            : std::nullopt;
  }

  /// Names the best of all, never the best of those for which there was time, if it leaves nothing but noise.
  void name_mistake(const Fit& right) {
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const Candidate& a, const Candidate& b) { return a.told.explained > b.told.explained; });
    for (const Candidate& candidate : candidates_) findings_.tried.push_back(candidate.told);
    const double told = expectation_.samples();
    const Candidate* named = nullptr;
    for (const Candidate& candidate : std::span(candidates_).first(std::min(max_looked_at, candidates_.size()))) {
      if (named || findings_.untried > 0 || candidate.told.explained < promising) break;
      const std::optional<double> explained = explained_by(candidate, right);
      if (!explained) continue;
      named = &candidate, findings_.mistake = {candidate.told.name, candidate.told.words, *explained};
    }
    expectation_.set_samples(told);
    if (named) describe(fit(right.program, is_right(named->reading) ? named->reading : right.reading, right.model));
  }

  const PictureNumbers& picture_;
  Expectation expectation_;
  Findings findings_;
  std::optional<Reading> wrong_;                        ///< the best wrong reading, once all were tried
  std::vector<std::pair<BookRules, BookModel>> known_;  ///< of editions' choices
  std::vector<BookSample> right_samples_;               ///< of the program without mistakes
  std::vector<Candidate> candidates_;
};

}  // namespace

Findings explain(const PictureNumbers& picture, const Scene& scene, const Reference& reference,
                 const CheckOptions& options, const std::function<bool()>& go_on) {
  return Search(picture, scene, reference, options, go_on).run();
}

}  // namespace tyndall
