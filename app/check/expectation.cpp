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

/// The regions without pixels that show a noise texture.
Regions without_noise(Regions regions, const SeenObjects& seen) {
  for (std::size_t pixel = 0; pixel < seen.of_pixel.size(); ++pixel)
    if (seen.objects[static_cast<std::size_t>(seen.of_pixel[pixel])].noisy_texture) regions.of_pixel[pixel] = -1;
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
      reference_(on_lattice(reference.image.rgb, lattice_)),
      reference_variance_(on_lattice(reference.variance, lattice_)),
      threads_(0),
      go_on_(go_on) {
  seen_ = seen_objects(scene, lattice_);
  small_ = without_noise(blocks_of(lattice_, edge_), seen_);
  large_ = without_noise(blocks_of(lattice_, large_edge * edge_), seen_);
  objects_ = regions_of(seen_, lattice_);
  take_samples(options);
  const Regions small = without_rare_light(small_);
  const auto left_out = [](const Regions& regions) {
    return static_cast<double>(std::count(regions.of_pixel.begin(), regions.of_pixel.end(), -1));
  };
  const double pixels = static_cast<double>(small_.of_pixel.size()) - left_out(small_);
  comparable_ = pixels > 0 ? 1 - (left_out(small) - left_out(small_)) / pixels : 1;
  small_ = small, large_ = without_rare_light(large_), objects_ = without_rare_light(objects_);
  variance_ = means_of(statistics_of(samples_, count_, {}).variance, large_);
  whole_ = {small_.of_pixel, 1};
  for (int& region : whole_.of_pixel) region = std::min(region, 0);
}

/// The regions without those in which the samples show quite another amount of light than there is: it comes on few
/// paths, so that nobody knows how often white cuts it off.
Regions Expectation::without_rare_light(Regions regions) const {
  const std::vector<double> sampled = means_of(mean_, regions), right = means_of(reference_, regions);
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
  const auto take = [&](int count) { return book_samples(start_, lattice_, count, threads_, [] { return true; }); };
  const auto begin = std::chrono::steady_clock::now();
  count_ = options.samples;
  if (count_ == 0) {
    take(min_samples);
    const double fit = options.seconds * part_for_samples * min_samples / std::max(seconds_since(begin), 1e-6);
    count_ = static_cast<int>(std::clamp(fit, 1.0 * min_samples, 1.0 * max_samples_of_pixel));
  }
  samples_ = take(count_);
  mean_ = statistics_of(samples_, count_, {}).mean;
}

std::vector<double> Expectation::likely_samples(const std::vector<BookSample>& of_program,
                                                const Reading& reading) const {
  const ReadPixels pixels = read_pixels(picture_, lattice_, reading);
  return likely_counts({pixels.light, reference_, pixels.tolerance, reference_variance_}, of_program, count_, small_,
                       white());
}

bool Expectation::white_matters() const {
  const SampleStatistics single = statistics_of(samples_, count_, {});
  double cut = 0, all = 0;
  for (std::size_t at = 0; at < single.mean.size(); ++at)
    cut += static_cast<double>(single.excess[at]), all += static_cast<double>(single.mean[at]);
  return picture_.coded && cut > min_cut * all;
}

std::vector<BookSample> Expectation::samples_of(const BookProgram& program, bool in_time) {
  return book_samples(
      program, lattice_, count_, threads_, in_time ? go_on_ : [] { return true; });
}

std::shared_ptr<const BookModel> Expectation::model_of(const std::vector<BookSample>& samples, double count) const {
  const int group = count > 0 ? std::clamp(static_cast<int>(std::lround(count)), 1, count_) : count_;
  SampleStatistics now = statistics_of(samples, count_, {group, white()}, &samples_);
  for (float& noise : now.noise)  // a picture of unknown samples shows by itself alone how noisy it is
    noise *= count > 0 ? static_cast<float>(group / count) : 0;
  const std::vector<double> common = means_of(now.common, large_);
  std::vector<double> ratios;
  if (picture_.coded && count > count_ * 1.2) ratios = excess_ratios(samples, count_, count, large_);
  for (std::size_t at = 0; at < now.mean.size(); ++at) {
    const int region = large_.of_pixel[at / 3];
    const std::size_t k = 3 * static_cast<std::size_t>(std::max(region, 0)) + at % 3;
    // What it has of the luck of the scene's own samples.
    const bool tells = region >= 0 && variance_[k] > 0;
    const auto passes = static_cast<float>(tells ? std::clamp(common[k] * group / variance_[k], 0.0, 1.0) : 1);
    const float missed = passes * (reference_[at] - mean_[at]);
    float& excess = now.excess[at];
    if (region >= 0 && !ratios.empty())  // means of few samples are too noisy; no pixel is brighter than white
      excess = std::max(excess * static_cast<float>(std::min(1.0, ratios[k])), now.mean[at] + missed - 1);
    now.mean[at] = now.mean[at] - excess + missed;
  }
  return std::make_shared<BookModel>(BookModel{std::move(now.mean), std::move(now.noise), count});
}

/// The picture, read in a way that is tried often: right ones are kept.
const ReadPixels& Expectation::read(const Reading& reading) {
  for (const auto& [known, pixels] : read_)
    if (known == reading) return pixels;
  newest_read_ = read_pixels(picture_, lattice_, reading);
  return is_right(reading) ? read_.emplace_back(reading, std::move(newest_read_)).second : newest_read_;
}

RegionDifferences Expectation::differences(const BookModel& model, const Reading& reading) {
  const ReadPixels& pixels = read(reading);
  const ComparedPixels compared{pixels.light, model.expected, pixels.tolerance, model.noise};
  RegionDifferences result{{},
                           block_differences(compared, whole_),
                           3 * static_cast<std::size_t>(small_.count),
                           3 * static_cast<std::size_t>(large_.count)};
  for (const Regions* regions : {&small_, &large_, &objects_}) {
    const std::vector<BlockDifference> part = block_differences(compared, *regions);
    result.all.insert(result.all.end(), part.begin(), part.end());
  }
  return result;
}

Misfit rough_misfit(const PictureNumbers& picture, const Scene& scene) {
  constexpr int count = 4;
  const Lattice lattice = lattice_of(picture.width, picture.height);
  ThreadPool pool(0);
  const auto samples = book_samples(plain_program(scene), lattice, count, pool, [] { return true; });
  const SampleStatistics statistics = statistics_of(samples, count, {count});
  std::vector<float> expected = statistics.mean;
  const std::vector<float> none(expected.size());
  for (std::size_t at = 0; at < expected.size() && picture.coded; ++at) expected[at] -= statistics.excess[at];
  const Regions regions = blocks_of(lattice, edge_of_blocks(lattice));
  std::optional<Misfit> best;
  for (const Reading& reading : readings_of(picture.coded)) {
    if (!is_right(reading)) continue;
    const ReadPixels pixels = read_pixels(picture, lattice, reading);
    const Misfit misfit = misfit_of(block_differences({pixels.light, expected, pixels.tolerance, none}, regions));
    if (!best || misfit.amount < best->amount) best = misfit;
  }
  return *best;
}

}  // namespace tyndall
