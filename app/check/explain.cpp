#include "app/check/explain.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {
namespace {

constexpr double max_different = 1 / 150.0;  // of the small blocks of a picture that agrees
constexpr double min_seen = 0.25;            // of a difference must be seen beside the noise of a mistake's picture
constexpr double promising = 0.2;            // of a difference is explained where it is worth looking closer
constexpr double min_comparable = 0.5;       // of the blocks must be comparable for an answer
constexpr double clear_improvement = 0.7;    // of a difference is left where a choice is taken for the program's

/// A program, what is expected of its picture, and how far the user's picture is from that.
struct Fit {
  BookProgram program;
  Reading reading;
  BookModel model;
  RegionDifferences regions;
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

/// The search for what explains a picture.
class Search {
 public:
  Search(const PictureNumbers& picture, const Scene& scene, const Reference& reference, const CheckOptions& options,
         const std::function<bool()>& go_on)
      : picture_(picture), expectation_(picture, scene, reference, options, go_on) {
    findings_.seconds = options.seconds;
  }

  Findings run() {
    expectation_.find_samples(best_reading(expectation_.start_model(), false));
    fit_samples();
    const BookModel start = expectation_.start_model();
    Fit right = best_choices(start);
    describe(right);
    if (findings_.agrees || findings_.unknown) return std::move(findings_);
    try_reading(right, best_reading(right.model, false));
    try_depths(right, start);
    for (const Difference& mistake : usual_mistakes()) try_mistake(right, mistake);
    name_mistake();
    if (findings_.mistake && is_right(*best_curve_)) describe(fit(right.program, *best_curve_, right.model));
    return std::move(findings_);
  }

 private:
  Fit fit(const BookProgram& program, const Reading& reading, const BookModel& model) {
    return {program, reading, model, expectation_.differences(model, reading)};
  }

  /// The reading that fits best. A wrong one must be clearly better than the best right one; only_right: none is tried.
  Reading best_reading(const BookModel& model, bool only_right, double* amount = nullptr) {
    std::optional<Reading> right, wrong;
    double of_right = 0, of_wrong = 0;
    for (const Reading& reading : readings_of(picture_.coded)) {
      if (!is_right(reading) && (only_right || (wrong_ && !(reading == *wrong_)))) continue;
      const double found = expectation_.differences(model, reading).amount();
      std::optional<Reading>& best = is_right(reading) ? right : wrong;
      double& min_found = is_right(reading) ? of_right : of_wrong;
      if (!best || found < min_found) best = reading, min_found = found;
    }
    if (amount) *amount = of_right;
    if (wrong) wrong_ = wrong;
    return wrong && of_wrong < clear_improvement * of_right ? *wrong : *right;
  }

  /// Where white cuts off much, the noise tells the number of samples only roughly: takes the one that fits best.
  void fit_samples() {
    double min_found = 0;
    const Reading first = best_reading(expectation_.start_model(), true, &min_found);
    if (agrees(expectation_.differences(expectation_.start_model(), first)) || !expectation_.white_matters()) return;
    const double told = expectation_.samples();
    double best = told;
    for (double samples = told > 0 ? told / 2 : 1; samples <= (told > 0 ? 2 * told : 2048); samples *= 2) {
      expectation_.set_samples(std::max(1.0, samples));
      double amount = 0;
      best_reading(expectation_.start_model(), true, &amount);
      if (amount < clear_improvement * min_found) best = std::max(1.0, samples), min_found = amount;
    }
    if (best > 0) expectation_.set_samples(best);
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
      Fit other = fit(program, best.reading, *expectation_.model_of(program, false));
      const double left = left_by(best.regions, other.regions);
      if (left > clear_improvement) continue;
      best = std::move(other);
      choices.push_back({choice.name, choice.words, 1 - left});
    }
    return best;
  }

  static bool agrees(const RegionDifferences& regions) {
    const Misfit small = misfit_of(regions.of_small());
    return small.different <= max_different * small.blocks && misfit_of(regions.of_large()).different == 0 &&
           misfit_of(regions.of_objects()).different == 0;
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
    findings_.agrees = !findings_.unknown && agrees(right.regions);
  }

  /// How much of the difference is gone with another model and reading; nothing, if that is so noisy that little of the
  /// difference can be seen beside it.
  double gone_with(const Fit& right, const BookModel& model, const Reading& reading) {
    const RegionDifferences other = expectation_.differences(model, reading);
    const double before = amount_of(right.regions.all, other.all), after = amount_of(other.all, right.regions.all);
    return before > min_seen * right.regions.amount() ? 1 - after / before : 0;
  }

  void add_tried(double explained, const Reading& reading, const std::string& name, const std::string& words) {
    if (!best_curve_ || explained > best_explained_) best_curve_ = reading, best_explained_ = explained;
    findings_.tried.push_back({name, words, explained});
  }

  /// Which right curve the picture has may only be seen together with the mistake: the best one counts.
  void judge(const Fit& right, const BookModel& model, const std::string& name, const std::string& words) {
    Reading best = right.reading;
    double max_gone = gone_with(right, model, best);
    for (const Reading& reading : readings_of(picture_.coded)) {
      if (max_gone < promising || !is_right(reading) || reading == right.reading) continue;
      const double gone = gone_with(right, model, reading);
      if (gone > max_gone) max_gone = gone, best = reading;
    }
    add_tried(max_gone, best, name, words);
  }

  void try_reading(const Fit& right, const Reading& best) {
    if (!is_right(best))
      add_tried(gone_with(right, right.model, best), right.reading, name_of_reading(best), words_of_reading(best));
  }

  /// Tries the two lengths of paths by which the scene would be about as dark as the picture.
  void try_depths(const Fit& right, const BookModel& start) {
    double light = 0, expected = 0;
    for (const BlockDifference& block : right.regions.of_small())
      light += block.pixels * (block.expected + block.difference), expected += block.pixels * block.expected;
    const std::vector<double> by_depth = expectation_.light_by_depth();
    const int max_depth = expectation_.start().scene.render.max_depth;
    std::size_t above = 0;
    while (above < by_depth.size() && by_depth[above] * expected < light) ++above;
    for (const std::size_t depth : {above, above - 1})
      if (depth < by_depth.size() && static_cast<int>(depth) < max_depth)
        try_depth(right, start, static_cast<int>(depth));
  }

  void try_depth(const Fit& right, const BookModel& start, int depth) {
    BookModel model = expectation_.start_model(depth);
    for (std::size_t at = 0; at < model.mean.size(); ++at)  // added to what the program's choices change
      model.mean[at] += right.model.mean[at] - start.mean[at];
    if (depth == 0)
      judge(right, model, "attenuation-lost",
            "what is hit sends on no light: attenuation is passed by value, or paths end at the first hit");
    else
      judge(right, model, "depth-" + std::to_string(depth),
            "paths end too early, after " + std::to_string(depth) + (depth == 1 ? " scattering" : " scatterings"));
  }

  void try_mistake(const Fit& right, const Difference& mistake) {
    BookProgram program = right.program;
    if (!mistake.apply(program)) return;
    const BookModel* model = expectation_.model_of(program, true);
    if (model)
      judge(right, *model, mistake.name, mistake.words);
    else
      ++findings_.untried;
  }

  /// Names the best of all, never the best of those for which there was time.
  void name_mistake() {
    auto& tried = findings_.tried;
    std::stable_sort(tried.begin(), tried.end(),
                     [](const Explanation& a, const Explanation& b) { return a.explained > b.explained; });
    if (findings_.untried == 0 && !tried.empty() && tried.front().explained >= min_explained)
      findings_.mistake = tried.front();
  }

  const PictureNumbers& picture_;
  Expectation expectation_;
  Findings findings_;
  std::optional<Reading> wrong_;       ///< the best wrong reading, once all were tried
  std::optional<Reading> best_curve_;  ///< of the mistake that explains most
  double best_explained_ = 0;
};

}  // namespace

Findings explain(const PictureNumbers& picture, const Scene& scene, const Reference& reference,
                 const CheckOptions& options, const std::function<bool()>& go_on) {
  return Search(picture, scene, reference, options, go_on).run();
}

}  // namespace tyndall
