#pragma once
// Tyndall as a library: load a scene, change it, render it, look at the numbers. C++17.
//
//   #include <tyndall/tyndall.h>
//
//   auto scene = tyndall::Scene::load("cover");
//   scene.set("/camera/vfov", 30);
//   tyndall::RenderOptions options;
//   options.spp = 64;
//   const auto picture = tyndall::render(scene, options);
//   picture.save("cover.png");
//
// Promises. All functions may be called from any number of threads at once, each with its own objects; const functions
// also with shared ones. Nothing is printed, no signal is handled, there is no global state, and the caller's rounding
// mode and flags of floating point neither change a bit of a picture nor are changed. The same scene, settings, version
// and instruction set give the same bits as the command "tyndall render" (its image_hash is Picture::hash()).
// Every failure is a tyndall::Error, whose what() is the sentence that the command prints; std::bad_alloc where memory
// runs out; what a progress function throws comes out of render() as it is. An object that was moved from can be
// assigned to; any other use of it throws Error. Lengths are in scene units, angles in degrees, colours and radiance
// linear Rec.709 (red, green, blue).
#include <tyndall/builders.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tyndall {
inline namespace v0 {

/// Why something cannot be done, in one line. The parts are empty where the sentence has none of them.
struct TYNDALL_API Error : std::runtime_error {
  Error(const std::string& sentence, std::string file_ = {}, std::string place_ = {}, std::string found_ = {},
        std::string expected_ = {});
  ~Error() override;
  std::string file;      ///< the file, built-in scene or option that is wrong
  std::string place;     ///< where in it: a JSON pointer such as "/materials/gold/fuzz", or "line 3, column 5"
  std::string found;     ///< what stands there
  std::string expected;  ///< what is allowed there
};

namespace detail {

[[noreturn]] TYNDALL_API void fail_moved_from();

/// What a scene, film or picture shares with its copies.
template <class Data>
class Shared {
 public:
  Shared() = default;
  Shared(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  const std::shared_ptr<const Data>& pointer() const {
    if (!data_) fail_moved_from();
    return data_;
  }
  const Data& operator*() const { return *pointer(); }
  const Data* operator->() const { return pointer().get(); }

 private:
  std::shared_ptr<const Data> data_;
};

}  // namespace detail

class Picture;

/// A scene: what a scene file holds. Copies are cheap and independent of each other.
class TYNDALL_API Scene {
 public:
  struct Data;  // the library's own
  /// An empty scene of 800 x 450 pixels in a black void.
  Scene();
  /// A built-in scene's name, a scene file, or an image that Tyndall wrote (PNG or EXR). Throws Error.
  static Scene load(const std::string& what);
  /// A scene file's text. folder: where its relative texture files are. Throws Error.
  static Scene parse(const std::string& json, const std::string& folder = ".");
  /// Names of the built-in scenes.
  static std::vector<std::string> built_in();

  /// Replaces or adds the value at a JSON pointer (RFC 6901) such as "/camera/vfov" or "/materials/gold/fuzz", as the
  /// command's --set does. Throws Error, and then changes nothing, if the scene would not be valid.
  void set(const std::string& pointer, double value);
  void set(const std::string& pointer, const Vec3& value);
  void set(const std::string& pointer, bool value);
  void set(const std::string& pointer, const std::string& text);
  void set(const std::string& pointer, const char* text) { set(pointer, std::string(text)); }
  void set(const std::string& pointer, int value) { set(pointer, static_cast<double>(value)); }
  /// The same for a value of any kind, as JSON.
  void set_json(const std::string& pointer, const std::string& json);
  /// Takes the value at a JSON pointer out of the scene. Throws Error, and then changes nothing, if there is none, or
  /// the scene would not be valid without it.
  void remove(const std::string& pointer);
  /// The value at a JSON pointer, as JSON; a setting that the scene leaves at its default has that value. Throws Error
  /// if there is none.
  std::string get_json(const std::string& pointer) const;
  /// The whole scene as a scene file's text, in normal form.
  std::string json() const;
  /// Writes that text into a file, whole or not at all. Texture files are found from there. Throws Error.
  void save(const std::string& file) const;

  /// Adds a material or a texture by that name, or replaces it. thing: one of <tyndall/builders.h>.
  template <class Thing>
  void add(const std::string& name, const Thing& thing) {
    set_json(std::string(Thing::list) + detail::pointer_step(name), thing.json());
  }
  /// Adds an object: Sphere, Quad, Triangle, Disk, Box or MediumIn, whose materials are there. Throws Error, and then
  /// changes nothing.
  template <class Thing>
  void add(const Thing& object) {
    add_json(object.json());
  }
  /// The same for an object of any kind, as JSON.
  void add_json(const std::string& object);

  int width() const;           ///< pixels
  int height() const;          ///< pixels
  std::string folder() const;  ///< where its relative texture files are

 private:
  detail::Shared<Data> data_;
  friend class Picture;
  friend class Film;
  friend struct Access;
};

/// Pixels x0 <= x < x1, y0 <= y < y1 of the whole image, y down.
struct Region {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// How a render is coming along.
struct Progress {
  std::uint32_t spp = 0;   ///< samples a pixel so far
  double seconds = 0;      ///< rendering so far
  double error = 0;        ///< estimated relative error; infinite before two samples a pixel
  double mrays_per_s = 0;  ///< million rays a second
};

/// Samples gathered so far, as exact sums. Films of disjoint ranges of samples add up to the bits of one render.
class TYNDALL_API Film {
 public:
  struct Data;  // the library's own
  /// Reads an EXR that Tyndall wrote. Throws Error.
  static Film load(const std::string& file);
  /// Adds the samples of parts, in any order: bit for bit the film of one render. Throws Error if they do not make one
  /// picture, or samples overlap or are missing.
  static Film merge(const std::vector<Film>& parts);
  /// Writes an EXR that holds picture, film and scene, and that load(), "tyndall merge" and "tyndall render --resume"
  /// read. Throws Error.
  void save(const std::string& file) const;
  int width() const;          ///< of the film's region, pixels
  int height() const;         ///< likewise
  std::uint32_t spp() const;  ///< samples a pixel; where pixels differ, their mean
  std::string hash() const;   ///< see Picture::hash()
  Scene scene() const;        ///< what it is a film of
  Picture picture() const;    ///< what these samples show, without a clean view

 private:
  explicit Film(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  detail::Shared<Data> data_;
  friend class Picture;
  friend struct Access;
};

/// What render() is asked for beside the scene. A limit that is 0 is none; without any limit the scene's own number of
/// samples is taken, or 64.
struct RenderOptions {
  std::uint32_t spp = 0;    ///< samples a pixel at which to stop, those of `film` included
  double time = 0;          ///< seconds at which to stop
  double target_error = 0;  ///< estimated relative error at which to stop; with `clean` that of the clean view
  bool clean = false;       ///< make the clean view, too; it needs 2 samples a pixel
  int threads = 0;          ///< 0: one for each processor that the process may use
  std::string isa{};        ///< instruction set: scalar, sse4, avx2, avx512 or neon; "": the best of this processor
  std::optional<Region> region{};  ///< the part of the image to render; absent: all of it
  std::uint32_t first_sample = 0;  ///< index of each pixel's first sample, for renders that Film::merge() adds up
  std::optional<Film> film{};      ///< to go on from: of the same scene, region and first sample
  /// Called on the calling thread about every 50 ms. Returns false to stop: the picture so far is the result.
  std::function<bool(const Progress&)> progress{};
};

/// A finished picture. Copies are cheap and share everything; nothing in it ever changes.
class TYNDALL_API Picture {
 public:
  struct Data;         // the library's own
  int width() const;   ///< pixels
  int height() const;  ///< pixels
  /// height x width x 3, top row first: linear radiance.
  const std::vector<float>& rgb() const;
  /// Estimated relative error: its square estimates relMSE, the mean of (x - truth)^2 / (truth^2 + 0.01) over pixels
  /// and channels. Infinite with fewer than 2 samples a pixel.
  double error() const;
  /// False where rare bright paths or a few pixels make up most of the error, so that it cannot be trusted.
  bool error_is_reliable() const;
  /// height x width: the estimated relative error around each pixel (7 x 7 pixels).
  const std::vector<float>& error_map() const;
  /// height x width x 3: the clean view, filtered from the samples. Throws Error unless RenderOptions::clean asked for
  /// it and each pixel has 2 samples.
  const std::vector<float>& clean() const;
  double clean_error() const;  ///< estimated relative error of the clean view; throws as clean() does
  /// What is seen first through the middle of each pixel: height x width x 3 albedo and normal (towards the outside of
  /// the shape), height x width depth along the camera's axis; 0, 0 and infinity where nothing is seen.
  const std::vector<float>& albedo() const;
  const std::vector<float>& normal() const;
  const std::vector<float>& depth() const;
  std::string hash() const;        ///< 16 hexadecimal digits over size and rgb(): image_hash of the command's --stats
  std::string clean_hash() const;  ///< likewise denoised_hash; throws as clean() does
  std::uint32_t spp() const;       ///< samples a pixel; where pixels differ, their mean
  double seconds() const;          ///< that rendering took
  bool stopped() const;            ///< the progress function stopped it
  std::uint64_t rejected() const;  ///< samples that were left out: not finite, or brighter than any light explains
  Film film() const;
  Scene scene() const;
  /// Writes a .png, .exr, .ppm, .pfm or .hdr file, whole or not at all, as the command does. PNG, PPM: the scene's
  /// exposure and tone map. PNG and EXR can be opened again as scenes, an EXR also as a Film. A picture with a clean
  /// view shows that one. Throws Error.
  void save(const std::string& file) const;
  /// The bytes of the PNG that save() writes, without the scene in it.
  std::vector<unsigned char> png() const;

 private:
  explicit Picture(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  detail::Shared<Data> data_;
  friend struct Access;
};

/// Renders until the first limit is reached. Blocks; uses threads of its own while it does. Throws Error for a scene or
/// options that are wrong.
TYNDALL_API Picture render(const Scene& scene, const RenderOptions& options = {});

/// How far a picture is from another one, as "tyndall compare" says it. Means over pixels and channels.
struct Comparison {
  double mse = 0, rmse = 0;
  double relmse = 0;  ///< (x - reference)^2 / (reference^2 + 0.01)
  double psnr = 0;    ///< dB, of the sRGB pictures clipped to [0, 1]; infinite for equal ones
  double flip = 0;    ///< mean difference that an eye sees in [0, 1] (Andersson et al. 2020, 67 pixels a degree)
  Vec3 mean_image{}, mean_reference{};
  /// The mean square of the differences of 16 x 16 blocks in standard errors, and the value up to which noise explains
  /// it; 0 blocks: one of the two has no film with 2 samples a pixel.
  int blocks = 0;
  double block_score = 0, block_limit = 0;
  double worst_z = 0;       ///< largest difference of a block, in standard errors
  bool only_noise = false;  ///< with blocks: the pictures differ by no more than their noise
  /// With blocks: the largest difference of a mean, a block or the number of outliers, in standard errors, corrected
  /// for the number of tests: noise makes it larger than 4 at most once in 16,000 comparisons ("tyndall compare
  /// --max-z").
  double z = 0;
  int unclear_blocks = 0;  ///< with light, but too noisy for a difference to show: of 60 effective samples or fewer
  double enough_spp = 0;   ///< above 0: no block with light can tell, and about so many samples a pixel would do
};
TYNDALL_API Comparison compare(const Picture& image, const Picture& reference);
/// The same of linear pixels, height x width x 3 of both.
TYNDALL_API Comparison compare(const std::vector<float>& image, const std::vector<float>& reference, int width,
                               int height);

/// The library's version, as "tyndall version" says it: "0.2.0".
TYNDALL_API std::string version();

}  // namespace v0
}  // namespace tyndall
