#include "app/check/check.h"

#include "app/check/expectation.h"

#include <memory>
#include <utility>

namespace tyndall {
namespace {

constexpr double promising = 0.2;          // of a difference is explained where it is worth looking closer
constexpr double clear_improvement = 0.7;  // of a difference is left where it has become clearly less
constexpr double min_comparable = 0.5;     // of the blocks must be comparable for an answer
constexpr double max_unseen = 0.3;         // of the light, by which a picture that agrees may be off unseen
constexpr std::size_t max_looked_at = 3;   // mistakes that are looked at closely

/// A program that may have made the picture: the scene's, with choices of editions and then with a mistake.
struct Suspect {
  std::vector<Difference> choices;
  std::optional<Difference> mistake;
};

/// What is expected of its pictures.
struct Model {
  Suspect suspect;
  double samples = 0;  ///< a pixel, that the user's picture has if it is one of them; 0: not known
  LatticeLight expected;
};

/// A way in which the picture may have been made, and how far the picture is from that.
struct Fit {
  std::shared_ptr<const Model> model;
  Reading reading;
  Differences differences;
};

/// Whether clearly less is left of a difference, where both have the same noise.
bool clearly_closer(const Differences& a, const Differences& b) {
  return amount_of(a.all, b.all) < clear_improvement * amount_of(b.all, a.all);
}

/// The search for what explains a picture.
class Search {
 public:
  Search(const PictureNumbers& picture, const Scene& scene, const NoisyImage& reference, const CheckOptions& options,
         const std::function<bool()>& go_on)
      : expectation_(picture, scene, reference, options, go_on),
        right_readings_(readings_of(picture.coded, true)),
        wrong_readings_(readings_of(picture.coded, false)) {
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
    if (!right.differences.agree_in_blocks()) name_mistake(right);
    return std::move(findings_);
  }

 private:
  /// Samples of what a suspect renders; empty: there is nothing that its choices or its mistake would change, or there
  /// is no time left.
  std::vector<BookSample> samples_of(const Suspect& suspect, bool in_time) {
    if (suspect.choices.empty() && !suspect.mistake) return expectation_.start_samples();
    BookProgram program = expectation_.start();
    for (const Difference& choice : suspect.choices)
      if (!choice.apply(program)) return {};
    if (suspect.mistake && !suspect.mistake->apply(program)) return {};
    return expectation_.samples_of(program, in_time);
  }

  std::shared_ptr<const Model> model_of(Suspect suspect, const std::vector<BookSample>& taken, double samples) {
    return std::make_shared<Model>(Model{std::move(suspect), samples, expectation_.expected_of(taken, samples)});
  }

  Fit fit(const std::shared_ptr<const Model>& model, const Reading& reading) {
    return {model, reading, expectation_.differences(model->expected, reading)};
  }

  Fit closest_reading(const std::shared_ptr<const Model>& model, const std::vector<Reading>& readings) {
    Fit best = fit(model, readings.front());
    for (const Reading& reading : readings) {
      Fit other = fit(model, reading);
      if (other.differences.amount() < best.differences.amount()) best = std::move(other);
    }
    return best;
  }

  /// The fit that is closest over the numbers of samples that the picture's noise may stand for.
  Fit closest(const Suspect& suspect, const std::vector<Reading>& readings, const std::vector<BookSample>& taken) {
    const Reading rough = closest_reading(model_of(suspect, taken, 0), readings).reading;
    std::optional<Fit> best;
    for (const double samples : expectation_.likely_samples(taken, rough)) {
      Fit found = closest_reading(model_of(suspect, taken, samples), readings);
      if (!best || found.differences.agree() || clearly_closer(found.differences, best->differences))
        best = std::move(found);
      if (best->differences.agree() || !expectation_.white_matters()) break;
    }
    return *best;
  }

  /// Takes over the choices of editions that bring the picture clearly closer to the program's, where they show at all,
  /// or with which nothing but noise is left.
  Fit with_choices(Fit best) {
    for (int round = 0; round < 2; ++round)  // a small one may show after a large one
      for (const Difference& choice : usual_choices()) {
        if (best.differences.agree()) return best;
        Suspect suspect = best.model->suspect;
        suspect.choices.push_back(choice);
        const std::shared_ptr<const Model> model = known_model_of(suspect, best.model->samples);
        if (!model) continue;
        Fit other = fit(model, best.reading);
        if (other.differences.agree() || best.differences.left_by(other.differences) <= clear_improvement)
          best = std::move(other);
      }
    return best;
  }

  /// Of choices with or without a mistake; null: see samples_of(). Kept for other readings.
  std::shared_ptr<const Model> known_model_of(const Suspect& suspect, double samples) {
    std::string names;
    for (const Difference& choice : suspect.choices) names += " " + choice.name;
    const auto [known, is_new] = known_.try_emplace(names);
    if (is_new)
      if (const auto taken = samples_of(suspect, suspect.mistake.has_value()); !taken.empty())
        known->second = model_of(suspect, taken, samples);
    return known->second;
  }

  /// The program without mistakes that is closest to the picture.
  Fit best_right() {
    const Fit start = closest({}, right_readings_, expectation_.start_samples());
    std::optional<Fit> best;
    const auto rank = [](const Fit& fit) { return std::pair(!fit.differences.agree(), fit.differences.amount()); };
    for (const Reading& reading : right_readings_) {
      Fit found = with_choices(fit(start.model, reading));
      if (!best || rank(found) < rank(*best)) best = std::move(found);
    }
    return *best;
  }

  /// What the findings say of the picture without mistakes.
  void describe(const Fit& right) {
    const Misfit small = misfit_of(right.differences.small);
    findings_.blocks = small.blocks, findings_.different = small.different;
    findings_.block_edge = expectation_.block_edge();
    findings_.curve = right.reading.curve, findings_.samples = right.model->samples;
    findings_.seen = expectation_.seen();
    findings_.choices = right.model->suspect.choices;
    findings_.unknown = expectation_.comparable() < min_comparable;
    const bool agree = !findings_.unknown && right.differences.agree();
    findings_.unseen = right.differences.unseen_light();
    findings_.too_few = agree && findings_.unseen > max_unseen;
    findings_.agrees = agree && !findings_.too_few;
    const double times = findings_.unseen / max_unseen;
    findings_.enough = std::ceil(findings_.samples * times * times);
    describe_objects(right.differences.objects);
  }

  void describe_objects(std::span<const CellDifference> cells) {
    findings_.objects.clear();
    for (std::size_t k = 0; k < cells.size(); k += 3) {
      const auto c = cells.subspan(k, 3);
      if (misfit_of(c).different == 0) continue;
      const Vec3d expected{c[0].expected, c[1].expected, c[2].expected};
      const Vec3d off{c[0].difference, c[1].difference, c[2].difference};
      findings_.objects.push_back({findings_.seen.objects[k / 3], c[0].pixels, expected + off, expected});
    }
    const auto amount = [](const ObjectDifference& d) {
      const Vec3d off = d.image - d.expected;
      return d.pixels * (std::abs(off.x) + std::abs(off.y) + std::abs(off.z));
    };
    std::ranges::sort(findings_.objects, std::greater{}, amount);
  }

  /// A wrong reading must be clearly better than the best right one.
  void try_readings(const Fit& right) {
    const Fit best = closest_reading(right.model, wrong_readings_);
    if (best.differences.amount() >= clear_improvement * right.differences.amount()) return;
    findings_.tried.push_back(mistake_of(best.reading));
    findings_.tried.back().explained = right.differences.gone(best.differences);
  }

  /// The two lengths of paths by which the scene would be about as dark as the picture.
  std::vector<int> likely_depths(const Fit& right) const {
    double light = 0, expected = 0;
    for (const CellDifference& cell : right.differences.whole)
      light += cell.expected + cell.difference, expected += cell.expected;
    const Numbers by_depth = light_by_depth(expectation_.start_samples());
    const int max_depth = std::min(static_cast<int>(by_depth.size()), expectation_.start().scene.render.max_depth);
    int above = 0;
    while (above < max_depth && by_depth[static_cast<std::size_t>(above)] * expected < light) ++above;
    std::vector<int> depths;
    for (const int depth : {above, above - 1})
      if (depth >= 0 && depth < max_depth) depths.push_back(depth);
    return depths;
  }

  /// Which right curve the picture has may only be seen together with the mistake: the best one counts.
  void try_mistake(const Fit& right, Difference mistake, bool in_time) {
    const Suspect suspect{right.model->suspect.choices, mistake};
    if (BookProgram program = expectation_.start(); !mistake.apply(program)) return;
    const std::vector<BookSample> taken = samples_of(suspect, in_time);
    if (taken.empty()) {
      ++findings_.untried;
      return;
    }
    const auto model = model_of(suspect, taken, right.model->samples);
    mistake.reading = right.reading;
    mistake.explained = right.differences.gone(fit(model, right.reading).differences);
    for (const Reading& reading : right_readings_) {
      if (mistake.explained < promising) break;
      const double part = right.differences.gone(fit(model, reading).differences);
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
      const Suspect suspect{{}, mistake};
      const std::vector<BookSample> taken = samples_of(suspect, true);
      if (taken.empty()) {
        ++findings_.untried;
        return;
      }
      known_.clear();
      const Fit found = with_choices(closest(suspect, {mistake.reading}, taken));
      mistake.explained = right.differences.gone(found.differences);
      if (!found.differences.agree() || mistake.explained < promising) continue;
      const Suspect innocent{found.model->suspect.choices, {}};
      const auto model = model_of(innocent, samples_of(innocent, false), found.model->samples);
      describe(fit(model, found.reading.is_right() ? found.reading : right.reading));
      if (!findings_.agrees && !findings_.too_few) findings_.mistake = mistake;
      return;
    }
  }

  Expectation expectation_;
  Findings findings_;
  std::vector<Reading> right_readings_, wrong_readings_;
  std::map<std::string, std::shared_ptr<const Model>> known_;  ///< by the names of choices
};

}  // namespace

Findings explain(const PictureNumbers& picture, const Scene& scene, const NoisyImage& reference,
                 const CheckOptions& options, const std::function<bool()>& go_on) {
  return Search(picture, scene, reference, options, go_on).run();
}

}  // namespace tyndall
