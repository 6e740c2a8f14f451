#include "app/check/explain.h"

#include "core/accuracy/error.h"
#include "core/base/seconds.h"
#include "core/render/render.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace tyndall {
namespace {

constexpr std::size_t max_lattice_pixels = 100'000;
constexpr int min_samples = 4, max_samples_of_pixel = 24;
constexpr double part_for_samples = 1 / 60.0;     // of the time, for the samples of one program
constexpr int large_edge = 4;                     // of a large block, in small ones
constexpr double rare_light = 0.5, dark = 0.003;  // of the light of a region, and light, that samples may be off
constexpr double min_cut = 0.02;                  // of the light of single samples, that white cuts off
constexpr double max_different = 1 / 150.0;       // of the small blocks of a picture that agrees
constexpr double min_seen = 0.25;                 // of a difference must be seen beside the noise of another picture
constexpr std::uint32_t first_spp = 16;
constexpr double part_of_difference = 0.05, min_error = 0.002;

BookProgram plain_program(const Scene& scene) {
  BookProgram program{scene, {}};
  program.rules.schlick = scene.render.fresnel == FresnelKind::schlick;
  return program;
}

Lattice lattice_of(int width, int height) {
  Lattice lattice{width, height, 1};
  while (lattice.pixels() > max_lattice_pixels) ++lattice.step;
  return lattice;
}

/// Three numbers of each pixel of the lattice.
Numbers on_lattice(const std::vector<float>& whole, const Lattice& lattice) {
  Numbers part;
  for (int y = 0; y < lattice.height; y += lattice.step)
    for (int x = 0; x < lattice.width; x += lattice.step) {
      const std::ptrdiff_t at = 3 * (std::ptrdiff_t{y} * lattice.width + x);
      part.insert(part.end(), whole.begin() + at, whole.begin() + at + 3);
    }
  return part;
}

/// The regions without pixels that show a noise texture.
Regions without_noise(Regions regions, const SeenObjects& seen) {
  for (std::size_t pixel = 0; pixel < seen.of_pixel.size(); ++pixel)
    if (seen.at(pixel).noisy_texture) regions.of_pixel[pixel] = -1;
  return regions;
}

}  // namespace

Reference render_reference(Scene scene, const LinearImage& picture, double seconds, std::uint32_t spp,
                           const std::function<bool()>& go_on) {
  scene.render.sharing = false, scene.render.adaptive = false, scene.render.sampler = SamplerKind::sobol;
  scene.render.integrator = Integrator::mis;
  scene.render.seed += 0x5eed;  // the picture may be Tyndall's own, whose noise must not be taken for the truth
  const auto prepared = prepare(scene);
  const auto progress = [&](const RenderProgress&) { return go_on(); };
  RenderOptions options;
  options.spp = first_spp;
  RenderResult rendered = render(*prepared, options);
  const double difference = std::sqrt(relative_mse(picture.rgb, resolve(rendered.film)));
  options.spp = spp;
  options.time_limit = std::max(0.0, seconds - rendered.seconds);
  options.target_error = std::isfinite(difference) ? std::max(min_error, part_of_difference * difference) : min_error;
  if (!rendered.interrupted) rendered = render(*prepared, options, progress, std::move(rendered.film));
  const Film& film = rendered.film;
  Reference reference{{film.region.width(), film.region.height(), resolve(film)}, {}};
  reference.variance.reserve(3 * film.pixels.size());
  for (const FilmPixel& pixel : film.pixels) {
    const Vec3f half = half_mean(film, pixel, 0) - half_mean(film, pixel, 1);
    for (const float off : {half.x, half.y, half.z}) reference.variance.push_back(off * off / 4);
  }
  return reference;
}

Expectation::Expectation(const PictureNumbers& picture, const Scene& scene, const Reference& reference,
                         const CheckOptions& options, const std::function<bool()>& go_on)
    : picture_(picture),
      start_(plain_program(scene)),
      lattice_(lattice_of(picture.width, picture.height)),
      edge_(edge_of_blocks(lattice_)),
      reference_{on_lattice(reference.image.rgb, lattice_), on_lattice(reference.variance, lattice_)},
      threads_(0),
      go_on_(go_on) {
  seen_ = seen_objects(scene, lattice_);
  small_ = without_noise(blocks_of(lattice_, edge_), seen_);
  large_ = without_noise(blocks_of(lattice_, large_edge * edge_), seen_);
  objects_ = regions_of(seen_, lattice_);
  take_samples(options);
  const auto kept = [](const Regions& regions) {
    return static_cast<double>(regions.of_pixel.size()) -
           static_cast<double>(std::count(regions.of_pixel.begin(), regions.of_pixel.end(), -1));
  };
  const double pixels = kept(small_);
  for (Regions* regions : {&small_, &large_, &objects_}) *regions = without_rare_light(std::move(*regions));
  comparable_ = pixels > 0 ? kept(small_) / pixels : 1;
  whole_ = {small_.of_pixel, 1};
  for (int& region : whole_.of_pixel) region = std::min(region, 0);
}

/// The regions without those in which the samples show quite another amount of light than there is: it comes on few
/// paths, so that nobody knows how often white cuts it off.
Regions Expectation::without_rare_light(Regions regions) const {
  const Numbers sampled = means_of(regions, single_, &SampleStatistics::mean),
                right = means_of(regions, reference_.light);
  for (int& region : regions.of_pixel) {
    if (region < 0) continue;
    const auto first = 3 * static_cast<std::size_t>(region);
    const double light = right[first] + right[first + 1] + right[first + 2];
    const double off = sampled[first] + sampled[first + 1] + sampled[first + 2] - light;
    if (std::abs(off) > rare_light * light + dark) region = -1;
  }
  return regions;
}

/// Takes the samples of the scene as it is: as many as the time allows.
void Expectation::take_samples(const CheckOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  count_ = options.samples;
  if (count_ == 0) {
    count_ = min_samples;
    samples_of(start_, false);
    const double fit = options.seconds * part_for_samples * min_samples / std::max(seconds_since(begin), 1e-6);
    count_ = static_cast<int>(std::clamp(fit, 1.0 * min_samples, 1.0 * max_samples_of_pixel));
  }
  samples_ = samples_of(start_, false);
  single_ = statistics_of(samples_, count_, {});
}

std::vector<double> Expectation::likely_samples(const std::vector<BookSample>& of_program,
                                                const Reading& reading) const {
  return likely_counts(read_pixels(picture_, lattice_, reading), reference_, of_program, count_, small_, white());
}

bool Expectation::white_matters() const {
  double cut = 0, all = 0;
  for (const SampleStatistics& number : single_) cut += number.excess, all += number.mean;
  return picture_.coded && cut > min_cut * all;
}

std::vector<BookSample> Expectation::samples_of(const BookProgram& program, bool in_time) {
  return book_samples(
      program, lattice_, count_, threads_, in_time ? go_on_ : [] { return true; });
}

ExpectedPixels Expectation::expected_of(const std::vector<BookSample>& samples, double count) const {
  const int group = count > 0 ? std::clamp(static_cast<int>(std::lround(count)), 1, count_) : count_;
  const auto now = statistics_of(samples, count_, {group, white()}, &samples_);
  const Numbers common = means_of(large_, now, &SampleStatistics::common),
                variance = means_of(large_, single_, &SampleStatistics::variance);
  Numbers ratios;
  if (picture_.coded && count > count_ * 1.2) ratios = excess_ratios(samples, count_, count, large_);
  ExpectedPixels expected;
  for (std::size_t at = 0; at < now.size(); ++at) {
    const std::size_t cell = large_.cell_of(at);
    const bool known = cell != Regions::no_cell;
    // What it has of the luck of the scene's own samples.
    const double passes = known && variance[cell] > 0 ? std::clamp(common[cell] * group / variance[cell], 0.0, 1.0) : 1;
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

Differences Expectation::differences(const ExpectedPixels& expected, const Reading& reading) {
  ReadPixels& pixels = read_[reading];
  if (pixels.light.empty()) pixels = read_pixels(picture_, lattice_, reading);
  Differences result{differences_of(pixels, expected, small_),
                     differences_of(pixels, expected, large_),
                     differences_of(pixels, expected, objects_),
                     {},
                     differences_of(pixels, expected, whole_)};
  for (const auto* part : {&result.small, &result.large, &result.objects})
    result.all.insert(result.all.end(), part->begin(), part->end());
  if (!reading.is_right()) read_.erase(reading);  // those are tried once
  return result;
}

bool Differences::agree_in_blocks() const {
  const Misfit misfit = misfit_of(small);
  return misfit.different <= max_different * misfit.blocks;
}

bool Differences::agree() const {
  return agree_in_blocks() && misfit_of(large).different == 0 && misfit_of(objects).different == 0 &&
         misfit_of(whole).different == 0;
}

double Differences::left_by(const Differences& now) const {
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

double Differences::gone(const Differences& after) const {
  const double seen = amount_of(all, after.all);
  return seen > min_seen * amount() ? 1 - amount_of(after.all, all) / seen : 0;
}

double Differences::unseen_light() const {
  double light = 0, unseen = 0;
  for (const CellDifference& channel : whole)
    light += channel.expected, unseen += channel.tolerance + noise_limit * channel.error;
  return light > 0 ? unseen / light : 0;
}

std::vector<CellDifference> rough_differences(const PictureNumbers& picture, const Scene& scene) {
  constexpr int count = 4;
  const Lattice lattice = lattice_of(picture.width, picture.height);
  ThreadPool pool(0);
  const auto samples = book_samples(plain_program(scene), lattice, count, pool, [] { return true; });
  ExpectedPixels expected;
  for (const SampleStatistics& number : statistics_of(samples, count, {count}))
    expected.light.push_back(number.mean - (picture.coded ? number.excess : 0));
  expected.variance.resize(expected.light.size());
  const Regions regions = blocks_of(lattice, edge_of_blocks(lattice));
  std::vector<CellDifference> best;
  for (const Reading& reading : readings_of(picture.coded, true)) {
    auto found = differences_of(read_pixels(picture, lattice, reading), expected, regions);
    if (best.empty() || amount_of(found, found) < amount_of(best, best)) best = std::move(found);
  }
  return best;
}

}  // namespace tyndall
