#include "app/check/explain.h"

#include "core/base/thread_pool.h"
#include "core/compile/compile.h"
#include "core/targets/kernels.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

namespace tyndall {
namespace {

constexpr std::size_t max_lattice_pixels = 100'000;
constexpr int min_samples = 4, max_samples_of_pixel = 48;
constexpr double part_for_samples = 1 / 16.0;  // of the time, for the samples of one program
constexpr double max_different = 1 / 400.0;    // of the blocks of a picture that agrees
constexpr double clear_improvement = 0.7;      // of a difference is left where a choice is taken for the program's

/// A scene as kernels read it.
struct Compiled {
  explicit Compiled(const BookProgram& program) : columns(compile(program.scene)) {
    if (program.columns) program.columns(columns);
    textures = texture_views(columns);
    view = view_of(columns, textures);
  }
  Compiled(const Compiled&) = delete;
  Compiled& operator=(const Compiled&) = delete;
  RenderScene columns;
  std::vector<TextureView> textures;
  SceneView view;
};

/// What is known of a program's picture: 3 floats a pixel of the lattice.
struct Model {
  std::vector<float> mean, excess;
};

/// A program, its picture, and how far the user's picture is from that.
struct Fit {
  BookProgram program;
  Reading reading;
  std::vector<BlockDifference> blocks;
  double amount() const { return amount_of(blocks, blocks); }
};

Lattice lattice_of(int width, int height) {
  Lattice lattice{width, height, 1};
  while (lattice.pixels() > max_lattice_pixels) ++lattice.step;
  return lattice;
}

/// Three numbers of each pixel of the lattice.
std::vector<float> on_lattice(const std::vector<float>& whole, const Lattice& lattice) {
  std::vector<float> part;
  part.reserve(3 * lattice.pixels());
  for (int y = 0; y < lattice.height; y += lattice.step)
    for (int x = 0; x < lattice.width; x += lattice.step) {
      const auto at =
          3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(lattice.width) + static_cast<std::size_t>(x));
      part.insert(part.end(), {whole[at], whole[at + 1], whole[at + 2]});
    }
  return part;
}

BookProgram plain_program(const Scene& scene) {
  BookProgram program{scene, {}};
  program.rules.schlick = scene.render.fresnel == FresnelKind::schlick;
  return program;
}

std::string name_of_reading(const Reading& r) {
  std::string name;
  const auto add = [&name](bool wanted, const char* part) {
    if (wanted) name += (name.empty() ? "" : "+") + std::string(part);
  };
  add(r.upside_down, "upside-down"), add(r.mirrored, "mirrored"), add(r.swapped, "red-blue");
  add(r.curve == Curve::none, "no-gamma"), add(r.curve == Curve::gamma2_twice, "gamma-twice");
  return name;
}

std::string words_of_reading(const Reading& r) {
  std::string words;
  const auto add = [&words](bool wanted, const char* part) {
    if (wanted) words += (words.empty() ? "" : ", and ") + std::string(part);
  };
  add(r.upside_down && r.mirrored, "the picture is turned by 180 degrees");
  add(r.upside_down && !r.mirrored, "the picture is upside down");
  add(!r.upside_down && r.mirrored, "the picture is mirrored, left and right");
  add(r.swapped, "red and blue have changed places");
  add(r.curve == Curve::none, "light is written without gamma");
  add(r.curve == Curve::gamma2_twice, "gamma is applied twice");
  return words;
}

/// The search for what explains a picture.
class Search {
 public:
  Search(const PictureNumbers& picture, const Scene& scene, const Reference& reference, const CheckOptions& options,
         const std::function<bool()>& go_on)
      : picture_(picture),
        lattice_(lattice_of(picture.width, picture.height)),
        grid_(grid_of(lattice_)),
        reference_(on_lattice(reference.image.rgb, lattice_)),
        reference_variance_(on_lattice(reference.variance, lattice_)),
        kernels_(*choose_kernels("")),
        threads_(options.threads),
        go_on_(go_on),
        start_(plain_program(scene)) {
    const Compiled compiled(start_);
    verdict_.seen = seen_objects(scene, compiled.columns, compiled.view, kernels_, lattice_);
    for (const int object : verdict_.seen.of_pixel)
      left_out_.push_back(verdict_.seen.objects[static_cast<std::size_t>(object)].noisy_texture ? 1 : 0);
    take_samples(compiled, options.seconds * part_for_samples);
  }

  Findings run() {
    const auto [right, best] = best_readings();
    verdict_.curve = right.curve;
    Fit closest = *fit_of(start_, best);
    choose(closest);  // editions can be told apart in an upside-down picture, too, once it is turned
    const std::optional<Fit> found = fit_of(closest.program, right);
    const Fit fit = found ? *found : *fit_of(start_, right);
    describe(fit);
    if (verdict_.agrees) return std::move(verdict_);
    try_reading(fit, best);
    for (const int depth : tried_depths(start_.scene.render.max_depth)) try_depth(fit, depth);
    for (const Difference& mistake : usual_mistakes()) try_mistake(fit, mistake);
    name_mistake();
    return std::move(verdict_);
  }

 private:
  /// Takes the samples of the scene as it is: as many as the time allows.
  void take_samples(const Compiled& compiled, double seconds) {
    const auto always = [] { return true; };
    const auto begin = std::chrono::steady_clock::now();
    book_samples(compiled.view, kernels_, start_.rules, lattice_, min_samples, threads_, always);
    const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    count_ =
        std::clamp(static_cast<int>(min_samples * seconds / std::max(spent, 1e-6)), min_samples, max_samples_of_pixel);
    samples_ = book_samples(compiled.view, kernels_, start_.rules, lattice_, count_, threads_, always);
    group_ = count_;
    base_ = statistics_of(samples_, count_, group_);
  }

  /// How many samples a pixel the picture seems to have: the variance of one sample over that of its pixels.
  void find_sample_count(const Reading& reading) {
    const ReadPixels pixels = read_pixels(picture_, lattice_, reading);
    const std::vector<float> none(reference_.size());
    const auto blocks = block_differences({pixels.light, reference_, pixels.tolerance, none, left_out_}, grid_);
    std::vector<double> of_sample(blocks.size()), of_reference(blocks.size()), excess(blocks.size()), ratios;
    for (std::size_t at = 0; at < reference_.size(); ++at) {
      const std::size_t block = 3 * grid_.block_of(at / 3) + at % 3;
      of_sample[block] += static_cast<double>(base_.variance[at]);
      of_reference[block] += static_cast<double>(reference_variance_[at]);
      excess[block] += static_cast<double>(base_.excess[at]);
    }
    std::vector<double> sorted;
    for (std::size_t k = 0; k < blocks.size(); ++k)
      if (blocks[k].pixels > 0) sorted.push_back(of_sample[k] / blocks[k].pixels);
    if (sorted.empty()) return;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    const double median = sorted[sorted.size() / 2];
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      const double n = blocks[k].pixels, step = blocks[k].tolerance;
      if (n == 0 || of_sample[k] / n < median || excess[k] / n > 1e-3) continue;
      const double noise = blocks[k].error * blocks[k].error * n - of_reference[k] / n - step * step / 12;
      if (noise > step * step / 12) ratios.push_back(of_sample[k] / n / noise);
    }
    if (ratios.size() < 8) return;
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
    verdict_.samples = std::max(1.0, ratios[ratios.size() / 2]);
    group_ = std::clamp(static_cast<int>(std::lround(verdict_.samples)), 1, count_);
    base_ = statistics_of(samples_, count_, group_);
    models_.clear();
  }

  /// The right reading and the reading of any kind that fit best.
  std::pair<Reading, Reading> best_readings() {
    std::array<Reading, 2> best;
    for (const bool again : {false, true}) {  // the second time with the number of samples, for the best one's curve
      std::array<double, 2> amounts{-1, -1};
      for (const Reading& reading : readings_of(picture_.coded)) {
        const double amount = blocks_of(base_model(), reading).second;
        for (const std::size_t any : {std::size_t{0}, std::size_t{1}}) {
          if ((any == 0 && !is_right(reading)) || (amounts[any] >= 0 && amount >= amounts[any])) continue;
          amounts[any] = amount, best[any] = reading;
        }
      }
      if (amounts[1] > clear_improvement * amounts[0]) best[1] = best[0];
      if (!again) find_sample_count(best[1]);
    }
    return {best[0], best[1]};
  }

  Model base_model() const { return finished({base_.mean, base_.excess}); }

  /// Corrects the excess of groups of samples for pictures of more samples than were taken.
  Model finished(Model model) const {
    if (verdict_.samples <= count_ * 1.2) return model;
    std::vector<double> wanted(3 * grid_.count()), taken(3 * grid_.count());
    for (std::size_t at = 0; at < model.mean.size(); ++at) {
      if (model.excess[at] <= 0) continue;
      const double mean = static_cast<double>(model.mean[at]), variance = static_cast<double>(base_.variance[at]);
      const std::size_t block = 3 * grid_.block_of(at / 3) + at % 3;
      wanted[block] += lognormal_excess(mean, variance / verdict_.samples);
      taken[block] += lognormal_excess(mean, variance / count_);
    }
    for (std::size_t at = 0; at < model.mean.size(); ++at) {
      const std::size_t block = 3 * grid_.block_of(at / 3) + at % 3;
      if (taken[block] > 0) model.excess[at] *= static_cast<float>(std::min(1.0, wanted[block] / taken[block]));
    }
    return model;
  }

  /// The picture that is expected of a program.
  std::vector<float> expected_of(const Model& model) const {
    std::vector<float> expected(reference_.size());
    for (std::size_t at = 0; at < expected.size(); ++at) {
      const float cut = picture_.coded ? model.excess[at] : 0;
      expected[at] = std::max(0.0f, reference_[at] + (model.mean[at] - base_.mean[at]) - cut);
    }
    return expected;
  }

  std::vector<float> noise_variance() const {
    std::vector<float> variance = base_.variance;
    const auto samples = static_cast<float>(verdict_.samples > 0 ? verdict_.samples : 1e6);
    for (float& value : variance) value /= samples;
    return variance;
  }

  std::pair<std::vector<BlockDifference>, double> blocks_of(const Model& model, const Reading& reading) const {
    const ReadPixels pixels = read_pixels(picture_, lattice_, reading);
    auto blocks =
        block_differences({pixels.light, expected_of(model), pixels.tolerance, noise_variance(), left_out_}, grid_);
    const double amount = amount_of(blocks, blocks);
    return {std::move(blocks), amount};
  }

  /// The picture of a program, rendered with the random numbers of the scene's own; null if there is no time left.
  const Model* model_of(const BookProgram& program) {
    if (!program.columns)
      for (const auto& [known, model] : models_)
        if (known.scene == program.scene && known.rules == program.rules && !known.columns) return model.get();
    const auto samples =
        book_samples(Compiled(program).view, kernels_, program.rules, lattice_, count_, threads_, go_on_);
    if (samples.empty()) {
      verdict_.out_of_time = true;
      return nullptr;
    }
    SampleStatistics statistics = statistics_of(samples, count_, group_);
    auto model = std::make_unique<Model>(finished({std::move(statistics.mean), std::move(statistics.excess)}));
    models_.emplace_back(program, std::move(model));
    return models_.back().second.get();
  }

  std::optional<Fit> fit_of(const BookProgram& program, const Reading& reading) {
    const bool plain = program.scene == start_.scene && program.rules == start_.rules && !program.columns;
    if (plain) return Fit{program, reading, blocks_of(base_model(), reading).first};
    const Model* model = model_of(program);
    if (!model) return {};
    return Fit{program, reading, blocks_of(*model, reading).first};
  }

  /// Takes over the choices of editions that bring the picture clearly closer to the program's, where they show at all.
  void choose(Fit& fit) {
    for (const Difference& choice : usual_choices()) {
      if (agrees(fit)) return;
      BookProgram program = fit.program;
      if (!choice.apply(program)) continue;
      std::optional<Fit> other = fit_of(program, fit.reading);
      if (!other) return;
      double before = 0, after = 0;
      for (std::size_t k = 0; k < fit.blocks.size(); ++k) {
        const BlockDifference &a = fit.blocks[k], &b = other->blocks[k];
        const double error = std::max(a.error, b.error), change = std::abs(a.difference - b.difference);
        if (a.pixels == 0 || change <= a.tolerance + 2 * error) continue;
        before += a.pixels * std::max(0.0, std::abs(a.difference) - 2 * error) / a.tolerance;
        after += b.pixels * std::max(0.0, std::abs(b.difference) - 2 * error) / b.tolerance;
      }
      if (before <= 0 || after > clear_improvement * before) continue;
      fit = std::move(*other);
      std::erase_if(verdict_.choices,
                    [&](const Explanation& old) { return choice.name == "fresnel" && old.name == "schlick"; });
      verdict_.choices.push_back({choice.name, choice.words, 1 - after / before});
    }
  }

  bool agrees(const Fit& fit) const {
    const Misfit misfit = misfit_of(fit.blocks);
    return misfit.different <= max_different * misfit.blocks;
  }

  /// What the verdict says of the picture before mistakes are looked for.
  void describe(const Fit& fit) {
    const Misfit misfit = misfit_of(fit.blocks);
    verdict_.blocks = misfit.blocks, verdict_.different = misfit.different;
    verdict_.block_edge = grid_.edge * lattice_.step;
    const bool plain = fit.program.rules == start_.rules;
    const Model* model = plain ? nullptr : model_of(fit.program);
    const Model start = plain ? base_model() : Model{};
    const ReadPixels pixels = read_pixels(picture_, lattice_, fit.reading);
    verdict_.objects = object_differences(
        {pixels.light, expected_of(model ? *model : start), pixels.tolerance, noise_variance(), left_out_},
        verdict_.seen);
    std::erase_if(verdict_.objects, [&](const ObjectDifference& object) {
      return !object.different || verdict_.seen.objects[static_cast<std::size_t>(object.object)].noisy_texture;
    });
    verdict_.agrees = agrees(fit) && verdict_.objects.empty();
  }

  /// How much of the difference of `fit` is gone in `other`.
  void judge(const Fit& fit, const std::vector<BlockDifference>& other, const std::string& name,
             const std::string& words) {
    const double all = fit.amount();
    if (all <= 0) return;
    verdict_.tried.push_back({name, words, (amount_of(fit.blocks, other) - amount_of(other, fit.blocks)) / all});
  }

  void try_reading(const Fit& fit, const Reading& best) {
    if (is_right(best)) return;
    std::optional<Fit> other = fit_of(fit.program, best);
    if (other) judge(fit, other->blocks, name_of_reading(best), words_of_reading(best));
  }

  void try_depth(const Fit& fit, int depth) {
    const SampleStatistics cut = statistics_of(samples_, count_, group_, depth);
    Model model = finished({cut.mean, cut.excess});
    if (!(fit.program.rules == start_.rules)) {  // added to what the program's choices change
      const Model* chosen = model_of(fit.program);
      if (!chosen) return;
      for (std::size_t at = 0; at < model.mean.size(); ++at) model.mean[at] += chosen->mean[at] - base_.mean[at];
    }
    judge(fit, blocks_of(model, fit.reading).first, "depth-" + std::to_string(depth),
          "paths end too early, after " + std::to_string(depth) + (depth == 1 ? " scattering" : " scatterings"));
  }

  void try_mistake(const Fit& fit, const Difference& mistake) {
    BookProgram program = fit.program;
    if (!mistake.apply(program)) return;
    const std::optional<Fit> other = fit_of(program, fit.reading);
    if (other) judge(fit, other->blocks, mistake.name, mistake.words);
  }

  void name_mistake() {
    auto& tried = verdict_.tried;
    std::stable_sort(tried.begin(), tried.end(),
                     [](const Explanation& a, const Explanation& b) { return a.explained > b.explained; });
    if (!tried.empty() && tried.front().explained >= min_explained) verdict_.mistake = tried.front();
  }

  const PictureNumbers& picture_;
  Lattice lattice_;
  BlockGrid grid_;
  std::vector<float> reference_, reference_variance_;  ///< on the lattice
  std::vector<char> left_out_;
  Kernels kernels_;
  ThreadPool threads_;
  const std::function<bool()>& go_on_;
  BookProgram start_;
  int count_ = 0, group_ = 0;  ///< samples that were taken of each pixel; of a pixel of the picture, as far as taken
  std::vector<BookSample> samples_;
  SampleStatistics base_;
  std::vector<std::pair<BookProgram, std::unique_ptr<Model>>> models_;
  Findings verdict_;
};

}  // namespace

Misfit rough_misfit(const PictureNumbers& picture, const Scene& scene, int threads) {
  constexpr int count = 4;
  const Lattice lattice = lattice_of(picture.width, picture.height);
  const BookProgram program = plain_program(scene);
  const Compiled compiled(program);
  ThreadPool pool(threads);
  const auto samples =
      book_samples(compiled.view, *choose_kernels(""), program.rules, lattice, count, pool, [] { return true; });
  const SampleStatistics statistics = statistics_of(samples, count, count);
  std::vector<float> expected = statistics.mean, none(expected.size());
  for (std::size_t at = 0; at < expected.size() && picture.coded; ++at) expected[at] -= statistics.excess[at];
  const std::vector<char> all(lattice.pixels());
  std::optional<Misfit> best;
  for (const Reading& reading : readings_of(picture.coded)) {
    if (!is_right(reading)) continue;
    const ReadPixels pixels = read_pixels(picture, lattice, reading);
    const Misfit misfit =
        misfit_of(block_differences({pixels.light, expected, pixels.tolerance, none, all}, grid_of(lattice)));
    if (!best || misfit.amount < best->amount) best = misfit;
  }
  return *best;
}

Findings explain(const PictureNumbers& picture, const Scene& scene, const Reference& reference,
                const CheckOptions& options, const std::function<bool()>& go_on) {
  return Search(picture, scene, reference, options, go_on).run();
}

}  // namespace tyndall
