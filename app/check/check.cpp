#include "app/check/check.h"

#include "app/book/load_program.h"
#include "app/comparison/baseline.h"
#include "app/files/open_scene.h"
#include "core/accuracy/error.h"
#include "core/base/error.h"
#include "core/base/seconds.h"
#include "core/base/text.h"
#include "core/image/image_io.h"
#include "core/image/image_io_file.h"
#include "core/image/tonemap.h"
#include "core/render/render.h"
#include "core/scene/load.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <system_error>
#include <utility>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

constexpr double part_for_reference = 0.25;        // of the time
constexpr std::uint32_t reference_samples = 8192;  // a pixel, at most
constexpr double part_of_other_scene = 0.05;       // blocks that differ from the start, before others are looked for
constexpr double part_of_right_scene = 0.5;        // of the difference that is left where another one is taken

// For what a program computes itself.
constexpr int max_columns = 64, block_edge = 4;  // of the small picture; of a block in pixels
constexpr double seconds_of_program = 0.5;
constexpr int fewest_samples = 4, most_samples = 200;  // a pixel
constexpr float brightest_sample = 2;                  // of what a sample counts for: few of them would decide else
constexpr double noise_allowed = 5, part_allowed = 0.03, darkest_level = 0.01, blocks_allowed = 0.02;

/// What read_picture() would have made of a PPM with PpmCurve::gamma2.
void read_as_gamma2(LinearImage& image) {
  for (float& value : image.rgb) {
    const float number = srgb_encode(value);
    value = number * number;
  }
}

std::string remark_on_size(const LoadedScene& loaded, const LinearImage& image) {
  const int width = loaded.scene.width, height = loaded.scene.height;
  if (std::abs(static_cast<double>(width) * image.height - static_cast<double>(height) * image.width) <=
      std::max(width, image.width))
    return "";
  return fmt::format("{}: its picture is {}x{}, which is rendered as {}x{} with the same vertical field of view",
                     loaded.name, width, height, image.width, image.height);
}

/// How a picture differs from the scene as a few samples of each pixel show it: enough to tell whether it is a picture
/// of this scene at all.
std::vector<CellDifference> rough_differences(const PictureNumbers& picture, const Scene& scene) {
  constexpr int count = 4;
  const Lattice lattice = lattice_of(picture.width, picture.height);
  const auto samples = book_samples(plain_program(scene), lattice, count);
  LatticeLight expected;
  for (const SampleStatistics& number : statistics_of(samples, count, {count}))
    expected.light.push_back(number.mean - (picture.coded ? number.excess : 0));
  expected.variance.resize(expected.light.size());
  const Regions regions = blocks_of(lattice, edge_of_blocks(lattice));
  std::vector<std::vector<CellDifference>> found;
  for (const Reading& reading : readings_of(picture.coded, true))
    found.push_back(differences_of(read_pixels(picture, lattice, reading), expected, regions));
  return *std::ranges::min_element(found, {}, [](const auto& cells) { return amount_of(cells, cells); });
}

/// Programs place balls at random, and where depends on the order in which a compiler computes arguments. If the
/// picture clearly differs from a program's scene as it was loaded, the program is compiled by other compilers, and the
/// scene that fits is taken in its place. Returns which compiler puts the balls there; "": the one that the program is
/// compiled with. Throws what open_scene() throws where the user interrupts a compiler; go_on: false ends the search.
std::string find_arrangement(const PictureNumbers& picture, const SceneRequest& request, LoadedScene& loaded,
                             const std::function<bool()>& go_on) {
  if (!is_program(request.what)) return "";
  const auto plain = rough_differences(picture, loaded.scene);
  const Misfit misfit = misfit_of(plain);
  if (misfit.different <= part_of_other_scene * misfit.blocks) return "";
  double allowed = part_of_right_scene * amount_of(plain, plain);
  const Scene first = loaded.scene;
  std::string words;
  SceneRequest again = request;
  again.program.told = true;
  for (const char* compiler : {"g++", "clang++"}) {
    if (!go_on()) break;
    again.program.compiler = compiler;
    try {
      LoadedScene other = open_scene(again);
      other.scene.width = picture.width, other.scene.height = picture.height;
      if (other.scene == first) continue;
      const auto found = rough_differences(picture, other.scene);
      if (amount_of(found, found) >= allowed) continue;
      allowed = amount_of(found, found);
      loaded = std::move(other), words = std::string("balls as ") + compiler + " places them";
    } catch (const ProgramInterrupted&) {
      throw;
    } catch (const std::runtime_error&) {  // a compiler that is not there, or that refuses the program
    }
  }
  return words;
}

/// The samples of each cell, by themselves. brightest: what a sample counts for at most.
std::vector<Pairs> sums_of(const std::vector<BookSample>& samples, const Regions& regions, float brightest) {
  std::vector<Pairs> sums(regions.cells());
  const std::size_t count = samples.size() / regions.of_pixel.size();
  for (std::size_t k = 0; k < samples.size(); ++k) {
    std::size_t cell = regions.cell_of(3 * (k / count));
    for (const float Vec3f::*channel : each_channel) {
      const float own = samples[k].light.*channel;
      const auto value = static_cast<double>(std::isfinite(own) ? std::clamp(own, 0.0f, brightest) : 0);
      sums[cell++].add(value, value);
    }
  }
  return sums;
}

/// As many samples of each pixel as the program computes in its time: those of a pixel follow each other.
std::vector<BookSample> own_samples(const ProgramScene& program, const Lattice& lattice) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<std::vector<Vec3d>> all;  // one sample of each pixel after the other
  // BookRules::short_frame is of loops that count rows from the bottom; those that count from the top are a row ahead.
  const int above = program.picture.first_row - program.picture.less;
  while (all.size() < fewest_samples || (all.size() < most_samples && seconds_since(begin) < seconds_of_program)) {
    const auto number = static_cast<double>(all.size());
    const double across = std::fmod(0.5 + 0.7548776662466927 * number, 1),
                 down = std::fmod(0.5 + 0.5698402909980532 * number, 1);
    std::vector<tyndall_book::pixel_place> places;
    for (int y = 0; y < lattice.rows(); ++y)
      for (int x = 0; x < lattice.columns(); ++x)
        places.push_back({x * lattice.step + across, y * lattice.step + above + down});
    all.push_back(program.own->samples(places));
  }
  std::vector<BookSample> samples;
  for (std::size_t pixel = 0; pixel < lattice.pixels(); ++pixel)
    for (const std::vector<Vec3d>& one : all) samples.push_back({to_float(one[pixel])});
  return samples;
}

/// Whether a texture of a program has, up to a texel, the colours of its file at the same places, by one of the curves
/// that programs read files by: bytes as they are, a power of 2.2, sRGB's.
bool shows_file(const Image::Pixels& file, const std::vector<tyndall_book::image_value>& values) {
  constexpr double precision = 6 / 255.0;  // decoders of JPEG differ
  const auto fits = [&](const tyndall_book::image_value& one, float power) {
    if (!(one.u >= 0 && one.u <= 1 && one.v >= 0 && one.v <= 1)) return false;
    const int column = static_cast<int>(one.u * file.width), row = static_cast<int>((1 - one.v) * file.height);
    Vec3d low{1e9, 1e9, 1e9}, high = -1e9 * Vec3d{1, 1, 1};
    for (int k = 0; k < 9; ++k) {
      const int x = std::clamp(column + k % 3 - 1, 0, file.width - 1),
                y = std::clamp(row + k / 3 - 1, 0, file.height - 1);
      const float* texel = file.rgb.data() + 3 * (std::ptrdiff_t{y} * file.width + x);
      for (const auto& [member, light] :
           {std::pair(&Vec3d::x, texel[0]), {&Vec3d::y, texel[1]}, {&Vec3d::z, texel[2]}}) {
        const double value = static_cast<double>(power > 0 ? std::pow(srgb_encode(light), power) : light);
        low.*member = std::min(low.*member, value), high.*member = std::max(high.*member, value);
      }
    }
    const Vec3d below = low - one.colour, above = one.colour - high;
    return std::max({below.x, below.y, below.z, above.x, above.y, above.z}) <= precision;
  };
  return std::ranges::any_of(std::array{1.0f, 2.2f, 0.0f}, [&](float power) {
    const auto right = std::ranges::count_if(values, [&](const auto& one) { return fits(one, power); });
    return 10 * right >= 9 * std::ssize(values);
  });
}

}  // namespace

bool names_scene(const std::string& name) {
  if (is_program(name)) return true;
  if (std::ranges::any_of(built_in_scenes(), [&](const BuiltIn& scene) { return scene.name == name; })) return true;
  const fs::path file = picture_name(name).file;
  const std::string ending = lower_case(file.extension().string());
  std::error_code error;
  const bool is_there = fs::exists(file, error), folder = fs::is_directory(file, error);
  if (!is_there && ending == ".json") return true;
  const bool picture = has_picture_ending(file) || ending == ".pnm";
  if (folder || (!is_there && !picture))
    throw UsageError(
        (name.empty() ? "REFERENCE" : printable(name)) + ": found " + (folder ? "a folder" : "no such file") +
        ", expected a picture, or a scene: its file, its name (\"tyndall scenes\" lists them) or a MAIN.cc");
  return !picture && fs::is_regular_file(file, error) && image_kind(read_bytes(file, kind_size)) == ImageKind::unknown;
}

NoisyImage render_reference(Scene scene, const LinearImage& picture, double seconds, std::uint32_t spp,
                            const std::function<bool()>& go_on) {
  scene.render.sharing = false, scene.render.adaptive = false, scene.render.sampler = SamplerKind::sobol;
  scene.render.integrator = Integrator::mis;
  scene.render.seed += 0x5eed;  // the picture may be Tyndall's own, whose noise must not be taken for the truth
  const auto prepared = prepare(scene);
  constexpr double part_of_difference = 0.05, min_error = 0.002;
  RenderOptions options;
  options.spp = 16;  // at first
  RenderResult rendered = render(*prepared, options);
  const double difference = std::sqrt(relative_mse(picture.rgb, resolve(rendered.film)));
  options.spp = spp;
  options.time_limit = std::max(0.0, seconds - rendered.seconds);
  options.target_error = std::isfinite(difference) ? std::max(min_error, part_of_difference * difference) : min_error;
  rendered = render(
      *prepared, options, [&](const RenderProgress&) { return go_on(); }, std::move(rendered.film));
  // Without samples in a half of a pixel its noise is not known.
  const std::size_t numbers = 3 * rendered.film.pixels.size();
  return noisy_image(rendered.film).value_or(NoisyImage{{}, resolve(rendered.film), std::vector<float>(numbers)});
}

Check check_picture(const CheckRequest& request) {
  auto begin = std::chrono::steady_clock::now();
  const double limit = request.options.seconds;
  std::string stage = "rendering the scene";
  const std::function<bool()> go_on = [&] {
    const double seconds = seconds_since(begin);
    return (!request.progress || request.progress(stage, seconds)) && seconds < limit;
  };
  PictureFile picture = read_whole_picture(request.image);
  const PictureNumbers numbers = numbers_of(picture);
  LoadedScene loaded = open_scene(request.scene);
  begin = std::chrono::steady_clock::now();  // how long compilers take is not for the user to say
  const std::string remark = remark_on_size(loaded, picture.image);
  loaded.scene.width = picture.image.width, loaded.scene.height = picture.image.height;
  const std::string arrangement = find_arrangement(numbers, request.scene, loaded, go_on);
  const Scene& scene = loaded.scene;
  NoisyImage reference = render_reference(scene, picture.image, part_for_reference * limit, reference_samples, go_on);
  stage = "looking for what explains the difference";
  Check check;
  check.verdict = explain(numbers, scene, reference, request.options, go_on);
  if (!arrangement.empty())
    check.verdict.choices.insert(check.verdict.choices.begin(), {"arrangement", arrangement, {}, 1});
  const bool ppm = picture.kind == ImageKind::ppm;
  // Read by the square of its numbers, as that fits better.
  const bool gamma2 = ppm && request.ppm == PpmCurve::srgb && check.verdict.curve == TransferCurve::gamma2;
  if (ppm && (gamma2 || request.ppm == PpmCurve::gamma2)) read_as_gamma2(picture.image);
  const std::size_t pixels = picture.image.rgb.size() / 3;
  PicturePair pair{{pixels, pixels}, {}, {loaded.name, {scene.width, scene.height, std::move(reference.mean)}}};
  pair.image = {request.image, take_pixels(pair, request.image, std::move(picture))};
  pair.image.pixels.frame.reset();
  if (!remark.empty()) pair.remarks.push_back(remark);
  if (gamma2)
    pair.remarks.push_back(request.image.string() +
                           ": read as the books' programs write it (gamma 2), which fits the scene better");
  check.comparison = compare_pair(std::move(pair));
  return check;
}

std::string differs_from_own(const Scene& scene, const ProgramScene& program) {
  auto values = program.images.begin();
  for (const Texture& texture : scene.textures)
    if (const auto* image = std::get_if<Image>(&texture.kind); image && values != program.images.end())
      if (!shows_file(*image->pixels, *values++))
        return texture.name + ": its colours are not those of " + image->file + " at the same places";
  if (program.picture.has_noise || program.picture.has_images) return "";
  const Lattice lattice{scene.width, scene.height, std::max(1, scene.width / max_columns)};
  const Regions regions = blocks_of(lattice, block_edge);
  // Samples that are drawn in another way have other bright ones, and the same mean. Rare bright ones decide more
  // blocks there.
  const float brightest = program.picture.draws_by_pdf ? 1e9f : brightest_sample;
  const double allowed = program.picture.draws_by_pdf ? 5 * blocks_allowed : blocks_allowed;
  const std::vector<BookSample> samples = own_samples(program, lattice);
  const int count = static_cast<int>(samples.size() / lattice.pixels());
  const BookRules rules{.diffuse = program.picture.matt_in_sphere ? DiffuseRule::filled_sphere : DiffuseRule::cosine,
                        .fuzz = program.picture.fuzz_on_sphere ? FuzzRule::sphere : FuzzRule::filled_sphere,
                        .schlick = true,
                        .short_frame = program.picture.less != 0};
  const std::vector<Pairs> own = sums_of(samples, regions, brightest),
                           ours = sums_of(book_samples({scene, rules}, lattice, count), regions, brightest);
  const auto apart = [&](std::size_t cell) {
    const double a = own[cell].mean(), b = ours[cell].mean(), difference = std::abs(a - b);
    return difference > noise_allowed * std::sqrt(own[cell].variance_of_mean() + ours[cell].variance_of_mean()) &&
           difference > part_allowed * std::max({a, b, darkest_level});
  };
  int different = 0, first = regions.count;
  for (std::size_t cell = 0; cell < regions.cells(); cell += 3)
    if (apart(cell) || apart(cell + 1) || apart(cell + 2))
      ++different, first = std::min(first, static_cast<int>(cell / 3));
  if (different <= std::max(1.0, allowed * regions.count)) return "";
  const int columns = (lattice.columns() + block_edge - 1) / block_edge, size = block_edge * lattice.step;
  return fmt::format("what it computes differs from its scene in {} of {} blocks, first at pixel ({}, {})", different,
                     regions.count, first % columns * size, first / columns * size);
}

}  // namespace tyndall
