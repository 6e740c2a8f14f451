#pragma once
#include "answers.h"
#include "camera.h"
#include "spy.h"

#include <ctime>
#include <thread>

/// Loops over pixels in main(), editions 1 to 3. The loop, the sky, the depth and the number of samples are the
/// reader's own code, so that code is asked: it calls get_ray, hit and write_color of these headers, which for the
/// first pixels answer in a way that makes ray_color() show what it does.
///
/// | pixel | what its rays meet                              | what ray_color() then returns             |
/// |-------|-------------------------------------------------|-------------------------------------------|
/// | 0 - 4 | nothing, in five directions                     | its sky there                             |
/// | 5     | mirrors without end                             | anything; the number of hits is the depth |
/// | 6     | a mirror that reflects a quarter, then nothing  | a quarter of the sky, if it multiplies    |
/// | 7     | something that shines with 0.5                  | 0.5, if it takes light                    |
/// | 8     | the mirror of a quarter, then what shines       | an eighth, likewise                       |
///
/// Then the scene is written, and the program ends. Where an answer is not what the books' ray_color() would give, the
/// program ends with a sentence instead: a wrong picture is worse than none.
namespace tyndall_book {

/// Follows the loop of main() until it knows enough. Of a loop in several threads nothing is taken.
class LoopProbe {
 public:
  static LoopProbe& get() {
    static LoopProbe probe;
    return probe;
  }
  ~LoopProbe() {
    if (done_) return;
    if (world_) refuse("the loop in main() ended without the books' camera and pixels: there is nothing to take over");
    if (empty_pixels_)
      refuse("main() writes pixels for which it asks no world: there is no light to trace in this chapter");
  }

  ray take_ray(const camera& cam);
  bool take_hit(const hittable& world, hit_record& record);
  /// A pixel has ended; out: null for standard output.
  void take_pixel(const vec3& mean, bool coarse, std::ostream* out);
  /// What the thing that was hit shines with, and what it reflects; 0: it does not scatter.
  double emission(bool of_third_book);
  double reflected();

 private:
  void check_progress();
  void check_pixel();
  void read_size(std::ostream* out);
  std::string summary(bool constant) const;
  void finish(std::ostream* out);

  camera_values camera_;
  const camera* seen_camera_ = nullptr;
  const hittable* world_ = nullptr;
  const std::thread::id thread_ = std::this_thread::get_id();
  std::clock_t begin_ = 0;
  int known_ = 0;                                           ///< pixels
  long rays_ = 0, hits_ = 0, scatters_ = 0, ray_hits_ = 0;  ///< of this pixel, and of its newest ray
  long samples_ = 0, depth_ = 0, last_hit_ = 0;             ///< rays a pixel; scatterings and hits of the longest path
  bool one_sided_lights_ = false, empty_pixels_ = false, done_ = false;
  LoopAnswers answers_;
};

inline void LoopProbe::check_progress() {
  constexpr long limit = 2000000;
  constexpr std::clock_t max_seconds = 5;
  if (std::this_thread::get_id() != thread_)
    refuse("main() computes its picture in threads of its own: Tyndall takes over a loop in one thread");
  if (begin_ == 0) begin_ = std::clock() + 1;
  const bool late = known_ == 0 && rays_ % 1024 == 0 && std::clock() - begin_ > max_seconds * CLOCKS_PER_SEC;
  if (rays_ > limit || late)
    refuse(
        "the loop in main() ends no pixel by write_color() or on std::cout: Tyndall sees nothing that it could take "
        "over");
}

inline ray LoopProbe::take_ray(const camera& cam) {
  check_progress();
  if (!seen_camera_) camera_ = cam;
  if (seen_camera_ && seen_camera_ != &cam) refuse("the loop in main() takes rays of several cameras");
  seen_camera_ = &cam;
  ++rays_;
  ray_hits_ = 0;
  return ray(cam.lookfrom, direction_of(known_), cam.shutter_open);
}

/// What all rays hit in the pixels from 5 on.
struct probe_material : material {
  bool scatter(const ray& in, const hit_record&, color& part, ray& out) const override { return answer(in, part, out); }
  bool scatter(const ray& in, const hit_record&, vec3& part, ray& out) const override { return answer(in, part, out); }
  bool scatter(const ray& in, const hit_record&, color& part, ray& out, double& pdf) const override {
    pdf = 1;
    return answer(in, part, out);
  }
  bool scatter(const ray& in, const hit_record&, vec3& part, ray& out, float& pdf) const override {
    pdf = 1;
    return answer(in, part, out);
  }
  bool scatter(const ray& in, const hit_record&, scatter_record& record) const override {
    record.skip_pdf = record.is_specular = true;
    const bool scatters = answer(in, record.attenuation, record.skip_pdf_ray);
    record.specular_ray = record.skip_pdf_ray;
    return scatters;
  }
  double scattering_pdf(const ray&, const hit_record&, const ray&) const override { return 1; }
  color emitted() const override { return grey(LoopProbe::get().emission(false)); }
  color emitted(double, double, const point3&) const override { return grey(LoopProbe::get().emission(false)); }
  color emitted(const ray&, const hit_record&, double, double, const point3&) const override {
    return grey(LoopProbe::get().emission(true));
  }
  static vec3 grey(double value) { return vec3(value, value, value); }
  static bool answer(const ray& in, vec3& part, ray& out) {
    const double reflected = LoopProbe::get().reflected();
    part = grey(reflected);
    out = in;
    return reflected > 0;
  }
};

inline bool LoopProbe::take_hit(const hittable& world, hit_record& record) {
  constexpr long limit = 5000;  // of calls within each other: the stack has room for as many
  check_progress();
  if (!world_) world_ = &world;
  if (world_ != &world) refuse("ray_color() in main() asks several objects for hits: Tyndall takes over one world");
  ++hits_, ++ray_hits_;
  if (ray_hits_ > limit) refuse("ray_color() in main() has no limit of depth");
  if (known_ < mirrors || (known_ == dimmed && ray_hits_ > 1)) return false;
  static probe_material seen;
  record = hit_record();
  record.normal = vec3(0, -1, 0);
  record.t = 1;
  record.mat = record.mat_ptr = record.matPtr = record.mat_pointer = &seen;
  record.material = record.material_ptr = record.materialPtr = &seen;
  TYNDALL_BOOK_HIT_MATERIALS
  return true;
}

inline double LoopProbe::emission(bool of_third_book) {
  one_sided_lights_ = one_sided_lights_ || of_third_book;
  return known_ == shining || (known_ == dimmed_light && ray_hits_ > 1) ? 0.5 : 0;
}

inline double LoopProbe::reflected() {
  ++scatters_;
  if (known_ == mirrors) return 1;
  return known_ == shining || ray_hits_ > 1 ? 0 : 0.25;
}

inline void LoopProbe::check_pixel() {
  if (rays_ == 0)
    refuse("main() makes its rays itself, without the books' camera: Tyndall does not know where it looks");
  if (!world_) refuse("ray_color() in main() asks no world for hits: there is nothing to take over");
  if (known_ == 0) samples_ = rays_;
  if (rays_ != samples_) refuse("the loop in main() takes more samples in some pixels than in others");
  const bool twice = known_ == dimmed || known_ == dimmed_light;
  const bool even = known_ == mirrors ? hits_ % rays_ == 0 && scatters_ % rays_ == 0 : hits_ == (twice ? 2 : 1) * rays_;
  if (known_ == mirrors && scatters_ == 0)
    refuse("ray_color() in main() asks no material to scatter: there is no light to trace in this chapter");
  if (!even) refuse("ray_color() in main() does not ask once a ray for a hit: it does something else than the books'");
  if (known_ != mirrors) return;
  last_hit_ = hits_ / rays_;
  depth_ = scatters_ / rays_;
}

inline void LoopProbe::take_pixel(const vec3& mean, bool coarse, std::ostream* out) {
  if (done_) return;
  empty_pixels_ = empty_pixels_ || (rays_ == 0 && hits_ == 0);
  if (rays_ == 0 && hits_ == 0) return;
  check_pixel();
  answers_.coarse = coarse;
  answers_.mean[known_++] = mean;
  rays_ = hits_ = scatters_ = 0;
  if (known_ == pixel_count) finish(out);
}

/// The size of the picture, from the header that was written on standard output or into an open file.
inline void LoopProbe::read_size(std::ostream* out) {
  if (out) out->flush();
  int width = OutputSpy::get().width(), height = OutputSpy::get().height();
  for (int open = 3; open < 64 && height == 0; ++open) {
    std::ifstream file("/proc/self/fd/" + std::to_string(open));
    std::string kind;
    if (open != caller() && file >> kind && kind == "P3") file >> width >> height;
  }
  if (width < 1 || height < 1)
    refuse("the loop in main() writes no header of a picture (P3, width, height): Tyndall does not know its size");
  camera_.image_width = width;
  camera_.image_height = height;
}

/// A few digits, for a sentence.
inline std::string short_text(const vec3& v) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(3);
  out << '(' << v[0] << ", " << v[1] << ", " << v[2] << ')';
  return out.str();
}

inline std::string LoopProbe::summary(bool constant) const {
  return "from the loop in main(): " + std::to_string(camera_.image_width) + " x " +
         std::to_string(camera_.image_height) + ", " + std::to_string(samples_) +
         (samples_ == 1 ? " sample" : " samples") + ", depth " + std::to_string(depth_) + ", sky " +
         (constant ? "" : short_text(answers_.sky(down)) + " to ") + short_text(answers_.sky(up));
}

inline void LoopProbe::finish(std::ostream* out) {
  done_ = true;
  read_size(out);
  answers_.find_gamma();
  if (!answers_.adds_up()) refuse("ray_color() in main() does something else with light than the books'");
  const bool constant = answers_.sky_is_constant();
  if (!constant && !answers_.sky_is_gradient())
    refuse("the sky of ray_color() in main() is neither one colour nor a gradient from top to bottom");
  scene_text objects;
  objects.one_sided_lights = one_sided_lights_;
  world_->tyndall_write(objects, {});
  if (objects.has_lights && !answers_.takes_light())
    refuse("ray_color() in main() takes no light of things that shine, though the world has some");
  note(summary(constant));
  const double ratio = static_cast<double>(camera_.image_width) / camera_.image_height;
  if (camera_.has_aspect_ratio && std::fabs(camera_.aspect_ratio / ratio - 1) > 0.02)
    note("the camera's aspect ratio is not that of the picture, which main() stretches and Tyndall does not");
  if (answers_.coarse && answers_.gamma != 2) note("main() writes its picture by another curve than gamma 2");
  if (objects.has_images) note("editions 1 to 3 take the numbers of images as they are, Tyndall takes them as sRGB");
  camera_.samples_per_pixel = static_cast<int>(samples_);
  const std::string sky = constant ? triple(answers_.sky(up))
                                   : "{\"type\":\"gradient\",\"bottom\":" + triple(answers_.sky(down)) +
                                         ",\"top\":" + triple(answers_.sky(up)) + "}";
  const std::string scene = scene_of(camera_, objects, sky, static_cast<int>(last_hit_) - 1);
  const bool into_a_file = out && out != &std::cout && caller() < 0 && output_file().empty();
  into_a_file ? write_rows(scene, *out) : deliver(scene);
  std::fflush(nullptr);
  std::_Exit(0);
}

inline void take_written_pixel(const vec3& fractions) { LoopProbe::get().take_pixel(fractions, true, nullptr); }

inline bool probe_hit(const hittable& world, hit_record& record) {
  base_called() = &world;
  return !is_probing_answers() && LoopProbe::get().take_hit(world, record);
}

// Before main(), in its thread. The stream must be there first, also where a compiler begins with inline variables.
static const std::ios_base::Init streams_first;
[[maybe_unused]] static const bool watching = (OutputSpy::get(), LoopProbe::get(), true);
[[maybe_unused]] static const bool guarding = caller() >= 0 && (InputGuard::get(), true);

}  // namespace tyndall_book

inline ray camera::get_ray(double, double) const { return tyndall_book::LoopProbe::get().take_ray(*this); }

TYNDALL_BOOK_HELPER void write_color(std::ostream& out, const vec3& sum, int samples) {
  tyndall_book::LoopProbe::get().take_pixel(sum / samples, false, &out);
}
TYNDALL_BOOK_HELPER void write_color(std::ostream& out, const vec3& mean) {
  tyndall_book::LoopProbe::get().take_pixel(mean, false, &out);
}
inline void vec3::write_color(std::ostream& out, int samples) const { ::write_color(out, *this, samples); }
TYNDALL_BOOK_HELPER double linear_to_gamma(double linear) { return linear > 0 ? std::sqrt(linear) : 0; }
