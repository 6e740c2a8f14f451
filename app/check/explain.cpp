#include "app/check/explain.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace tyndall {
namespace {

constexpr double promising = 0.2;         // of a difference is explained where it is worth looking closer
constexpr double min_comparable = 0.5;    // of the blocks must be comparable for an answer
constexpr double max_unseen = 0.3;        // of the light, by which a picture that agrees may be off unseen
constexpr std::size_t max_looked_at = 3;  // mistakes that are looked at closely

/// A program that may have made the picture: the scene's, with choices of editions and then with a mistake.
struct Suspect {
  std::vector<Difference> choices;
  std::optional<Difference> mistake;
};

/// A way in which the picture may have been made, and how far the picture is from that.
struct Fit {
  Suspect suspect;
  Reading reading;
  std::shared_ptr<const BookModel> model;
  RegionDifferences regions;
};

/// A mistake that was tried, with the reading that goes best with it.
struct Candidate {
  Difference mistake;
  Reading reading;
};

/// The search for what explains a picture.
class Search {
 public:
  Search(const PictureNumbers& picture, const Scene& scene, const Reference& reference, const CheckOptions& options,
         const std::function<bool()>& go_on)
      : expectation_(picture, scene, reference, options, go_on) {
    findings_.seconds = options.seconds;
    for (const Reading& reading : readings_of(picture.coded))
      (is_right(reading) ? right_readings_ : wrong_readings_).push_back(reading);
  }

  Findings run() {
    const Fit right = best_right();
    describe(right);
    if (findings_.agrees || findings_.unknown || findings_.too_few) return std::move(findings_);
    try_readings(right);
    for (const int depth : likely_depths(right)) try_mistake(right, shorter_paths(depth), false);
    for (const Difference& mistake : usual_mistakes()) try_mistake(right, mistake, true);
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const Candidate& a, const Candidate& b) { return a.mistake.explained > b.mistake.explained; });
    for (const Candidate& c : candidates_) findings_.tried.push_back(c.mistake);
    if (!agrees_in_blocks(right.regions)) name_mistake(right);
    return std::move(findings_);
  }

 private:
  std::optional<BookProgram> program_of(const Suspect& suspect) const {
    BookProgram program = expectation_.start();
    for (const Difference& choice : suspect.choices)
      if (!choice.apply(program)) return {};
    if (suspect.mistake && !suspect.mistake->apply(program)) return {};
    return program;
  }

  /// Samples of what a suspect renders; empty: it is none, or there is no time left.
  std::vector<BookSample> samples_of(const Suspect& suspect, bool in_time) {
    if (suspect.choices.empty() && !suspect.mistake) return expectation_.start_samples();
    const std::optional<BookProgram> program = program_of(suspect);
    return program ? expectation_.samples_of(*program, in_time) : std::vector<BookSample>{};
  }

  using Model = std::shared_ptr<const BookModel>;
  Fit fit(const Suspect& suspect, const Reading& reading, const Model& model) {
    return {suspect, reading, model, expectation_.differences(*model, reading)};
  }

  Fit closest_reading(const Suspect& suspect, const std::vector<Reading>& readings, const Model& model) {
    Fit best = fit(suspect, readings.front(), model);
    for (const Reading& reading : readings) {
      Fit other = fit(suspect, reading, model);
      if (other.regions.amount() < best.regions.amount()) best = std::move(other);
    }
    return best;
  }

  /// The fit that is closest over the numbers of samples that the picture's noise may stand for.
  Fit closest(const Suspect& suspect, const std::vector<Reading>& readings, const std::vector<BookSample>& taken) {
    const Fit rough = closest_reading(suspect, readings, expectation_.model_of(taken, 0));
    std::optional<Fit> best;
    for (const double samples : expectation_.likely_samples(taken, rough.reading)) {
      Fit found = closest_reading(suspect, readings, expectation_.model_of(taken, samples));
      if (!best || agrees(found.regions) || clearly_closer(found.regions, best->regions)) best = std::move(found);
      if (agrees(best->regions) || !expectation_.white_matters()) break;
    }
    return *best;
  }

  /// Takes over the choices of editions that bring the picture clearly closer to the program's, where they show at all,
  /// or with which nothing but noise is left.
  Fit with_choices(Fit best) {
    std::vector<Difference> choices = usual_choices();
    for (const Difference& again : usual_choices()) choices.push_back(again);  // a small one may show after a large one
    for (const Difference& choice : choices) {
      if (agrees(best.regions)) break;
      Suspect suspect = best.suspect;
      suspect.choices.push_back(choice);
      const Model model = known_model_of(suspect, best.model->samples);
      if (!model) continue;
      Fit other = fit(suspect, best.reading, model);
      if (agrees(other.regions) || left_by(best.regions, other.regions) <= clear_improvement) best = std::move(other);
    }
    return best;
  }

  /// Of choices with or without a mistake; null: see samples_of(). Kept for other readings.
  Model known_model_of(const Suspect& suspect, double samples) {
    std::string name;
    for (const Difference& choice : suspect.choices) name += " " + choice.name;
    const auto [known, is_new] = known_.try_emplace(name);
    if (is_new)
      if (const auto taken = samples_of(suspect, suspect.mistake.has_value()); !taken.empty())
        known->second = expectation_.model_of(taken, samples);
    return known->second;
  }

  /// The program without mistakes that is closest to the picture.
  Fit best_right() {
    const Fit start = closest({}, right_readings_, expectation_.start_samples());
    std::optional<Fit> best;
    const auto rank = [](const Fit& fit) { return std::pair(!agrees(fit.regions), fit.regions.amount()); };
    for (const Reading& reading : right_readings_) {
      Fit found = with_choices(fit({}, reading, start.model));
      if (!best || rank(found) < rank(*best)) best = std::move(found);
    }
    return *best;
  }

  /// What the findings say of the picture without mistakes.
  void describe(const Fit& right) {
    const Misfit small = misfit_of(right.regions.of_small());
    findings_.blocks = small.blocks, findings_.different = small.different;
    findings_.block_edge = expectation_.block_edge();
    findings_.curve = right.reading.curve, findings_.samples = right.model->samples;
    findings_.seen = expectation_.seen();
    findings_.objects = different_objects(right.regions);
    findings_.choices = right.suspect.choices;
    findings_.unknown = expectation_.comparable() < min_comparable;
    const bool agree = !findings_.unknown && agrees(right.regions);
    findings_.unseen = unseen_light(right.regions);
    findings_.too_few = agree && findings_.unseen > max_unseen;
    findings_.agrees = agree && !findings_.too_few;
    const double times = findings_.unseen / max_unseen;
    findings_.enough = std::ceil(findings_.samples * times * times);
  }

  /// A wrong reading must be clearly better than the best right one.
  void try_readings(const Fit& right) {
    const Fit best = closest_reading(right.suspect, wrong_readings_, right.model);
    if (best.regions.amount() >= clear_improvement * right.regions.amount()) return;
    candidates_.push_back({mistake_of(best.reading), best.reading});
    candidates_.back().mistake.explained = gone(right.regions, best.regions);
  }

  /// The two lengths of paths by which the scene would be about as dark as the picture.
  std::vector<int> likely_depths(const Fit& right) const {
    double light = 0, expected = 0;
    for (const BlockDifference& block : right.regions.of_small())
      light += block.pixels * (block.expected + block.difference), expected += block.pixels * block.expected;
    const std::vector<double> by_depth = light_by_depth(expectation_.start_samples());
    const int max_depth = std::min(static_cast<int>(by_depth.size()), expectation_.start().scene.render.max_depth);
    int above = 0;
    while (above < max_depth && by_depth[static_cast<std::size_t>(above)] * expected < light) ++above;
    std::vector<int> depths;
    for (const int depth : {above, above - 1})
      if (depth >= 0 && depth < max_depth) depths.push_back(depth);
    return depths;
  }

  /// Which right curve the picture has may only be seen together with the mistake: the best one counts.
  void try_mistake(const Fit& right, const Difference& mistake, bool in_time) {
    const Suspect suspect{right.suspect.choices, mistake};
    if (!program_of(suspect)) return;
    const std::vector<BookSample> taken = samples_of(suspect, in_time);
    if (taken.empty()) {
      ++findings_.untried;
      return;
    }
    const Model model = expectation_.model_of(taken, right.model->samples);
    Candidate best{mistake, right.reading};
    double& explained = best.mistake.explained;
    explained = gone(right.regions, fit(suspect, right.reading, model).regions);
    for (const Reading& reading : right_readings_) {
      if (explained < promising) break;
      const double part = gone(right.regions, fit(suspect, reading, model).regions);
      if (part > explained) explained = part, best.reading = reading;
    }
    candidates_.push_back(std::move(best));
  }

  /// Names a mistake if the picture agrees with those that are made with it, with choices of editions that may not have
  /// been seen beside it: never the best of those for which there was time.
  void name_mistake(const Fit& right) {
    for (const Candidate& candidate : std::span(candidates_).first(std::min(max_looked_at, candidates_.size()))) {
      if (findings_.untried > 0 || candidate.mistake.explained < promising) return;
      Difference mistake = candidate.mistake;
      const Suspect suspect{{}, mistake};
      const std::vector<BookSample> taken = samples_of(suspect, true);
      if (taken.empty()) ++findings_.untried;
      if (taken.empty()) return;
      known_.clear();
      const Fit found = with_choices(closest(suspect, {candidate.reading}, taken));
      mistake.explained = gone(right.regions, found.regions);
      if (!agrees(found.regions) || mistake.explained < promising) continue;
      const Suspect innocent{found.suspect.choices, {}};
      const Model model = expectation_.model_of(samples_of(innocent, false), found.model->samples);
      describe(fit(innocent, is_right(found.reading) ? found.reading : right.reading, model));
      if (!findings_.agrees && !findings_.too_few) findings_.mistake = mistake;
      return;
    }
  }

  Expectation expectation_;
  Findings findings_;
  std::vector<Reading> right_readings_, wrong_readings_;
  std::map<std::string, Model> known_;  ///< by the names of choices
  std::vector<Candidate> candidates_;
};

}  // namespace

Findings explain(const PictureNumbers& picture, const Scene& scene, const Reference& reference,
                 const CheckOptions& options, const std::function<bool()>& go_on) {
  return Search(picture, scene, reference, options, go_on).run();
}

}  // namespace tyndall
