#pragma once
#include "probe.h"

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
  if (!is_probing_thread() || known_ == pixel_count) return false;
  check_progress();
  if (!world_) world_ = &world;
  if (world_ != &world) refuse("ray_color() in main() asks several objects for hits: Tyndall takes over one world");
  ++hits_, ++ray_hits_;
  if (ray_hits_ > limit) refuse("ray_color() in main() has no limit of depth");
  if (!counts_ && (known_ < mirrors || (known_ == dimmed && ray_hits_ > 1))) return false;
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
  return counts_ || known_ == shining || (known_ == dimmed_light && ray_hits_ > 1) ? 0.5 : 0;
}

inline double LoopProbe::reflected() {
  ++scatters_;
  if (counts_) return 0;
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

/// main() says itself where pixels end: the sums were not those of whole pixels. All is asked anew.
inline void LoopProbe::follow_words() {
  by_sums_ = false;
  counted_ = has_words_ = true;
  known_ = 0;
  forget_pixel();
}

inline void LoopProbe::take_pixel(const vec3& mean, bool coarse, std::ostream* out) {
  if (done_) return;
  if (is_known_ || known_ == pixel_count) return hand_over(out);
  if (by_sums_) return follow_words();
  if (rays_ > 0 && probing_thread_.load() != std::this_thread::get_id()) return;
  empty_pixels_ = empty_pixels_ || (rays_ == 0 && hits_ == 0);
  if (rays_ == 0 && hits_ == 0) return;
  if (counts_) return forget_pixel();  // it says where pixels end, so that nothing needs to be counted
  answers_.coarse = coarse;
  end_pixel(mean);
  if (is_known_) hand_over(out);
}

inline void LoopProbe::read_size_of(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  std::string kind;
  int width = 0, height = 0;
  if (has_size_ || !(file >> kind && (kind == "P3" || kind == "P6") && file >> width >> height)) return;
  has_size_ = width > 0 && height > 0;
  camera_.image_width = width;
  camera_.image_height = height;
}

/// Pictures that main() has written, in the folder where it runs and above, which are the caller's and temporary.
inline void LoopProbe::read_size_of_new_files() {
  for (const std::string folder : {"./", "../"}) {
    DIR* list = caller() >= 0 ? opendir(folder.c_str()) : nullptr;
    for (const dirent* entry = list ? readdir(list) : nullptr; entry; entry = readdir(list)) {
      struct stat file {};
      const std::string name = folder + entry->d_name;
      if (stat(name.c_str(), &file) == 0 && S_ISREG(file.st_mode) && file.st_mtime >= first_ray_) read_size_of(name);
    }
    if (list) closedir(list);
  }
}

/// The size of the picture, from the header that was written on standard output or into an open file.
inline bool LoopProbe::read_size(std::ostream* out) {
  if (out) out->flush();
  const int width = OutputSpy::get().width(), height = OutputSpy::get().height();
  if (!has_size_ && width > 0 && height > 0) take_size(width, height);
  for (int open = 3; open < 64; ++open)
    if (open != caller()) read_size_of("/proc/self/fd/" + std::to_string(open));
  return has_size_;
}

inline void LoopProbe::take_size(int width, int height) {
  camera_.image_width = width;
  camera_.image_height = height;
  has_size_ = true;
}

/// A few digits, for a sentence.
inline std::string short_text(const vec3& v) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(3);
  out << '(' << v[0] << ", " << v[1] << ", " << v[2] << ')';
  return out.str();
}

inline std::string LoopProbe::summary() const {
  const bool constant = answers_.sky_is_constant();
  return "from the loop in main(): " + std::to_string(camera_.image_width) + " x " +
         std::to_string(camera_.image_height) + ", " + std::to_string(samples_) +
         (samples_ == 1 ? " sample" : " samples") + ", depth " + std::to_string(depth_) + ", sky " +
         (constant ? "" : short_text(answers_.sky(down)) + " to ") + short_text(answers_.sky(up));
}

/// All answers are there: what the loop does is known, or refused.
inline void LoopProbe::conclude() {
  follows_sums = false;
  answers_.find_gamma();
  const bool is_scaled =
      by_sums_ && !answers_.takes_light() && samples_ > 3 && answers_.brightest() * static_cast<double>(samples_) < 2;
  if (is_scaled || !answers_.adds_up()) refuse("ray_color() in main() does something else with light than the books'");
  if (!answers_.sky_is_constant() && !answers_.sky_is_gradient())
    refuse("the sky of ray_color() in main() is neither one colour nor a gradient from top to bottom");
  objects_.one_sided_lights = one_sided_lights_;
  world_->tyndall_write(objects_, {});
  if (objects_.has_lights && !answers_.takes_light())
    refuse("ray_color() in main() takes no light of things that shine, though the world has some");
  rows_.begin(samples_, camera_.has_aspect_ratio ? camera_.aspect_ratio : 0);
  is_known_ = !by_sums_ || read_size(nullptr);
  if (by_sums_) hand_over(nullptr);
}

/// The answers are there, but the size is not: rows tell it, while other threads go on waiting.
inline void LoopProbe::follow_rows(double u, double v) {
  const bool tell = rows_.take(u, v);
  if (tell) take_size(rows_.width(), rows_.height());
  is_known_ = tell || rows_.gives_up();
  if (tell) hand_over(nullptr);
}

inline void LoopProbe::hand_over(std::ostream* out) {
  const std::lock_guard<std::mutex> lock(handing_over_);
  if (known_ < pixel_count || done_ || !read_size(out)) return;
  done_ = true;
  const long pixels = static_cast<long>(camera_.image_width) * camera_.image_height;
  if (by_sums_ && samples_ == 1) samples_ = std::max(1L, (all_rays_ + pixels / 2) / pixels);  // a loop in passes
  note(summary());
  const double ratio = static_cast<double>(camera_.image_width) / camera_.image_height;
  if (camera_.has_aspect_ratio && std::fabs(camera_.aspect_ratio / ratio - 1) > 0.02)
    note("the camera's aspect ratio is not that of the picture, which main() stretches and Tyndall does not");
  if (answers_.coarse && answers_.gamma != 2) note("main() writes its picture by another curve than gamma 2");
  if (objects_.has_images) note("editions 1 to 3 take the numbers of images as they are, Tyndall takes them as sRGB");
  camera_.samples_per_pixel = static_cast<int>(samples_);
  const std::string sky = answers_.sky_is_constant()
                              ? triple(answers_.sky(up))
                              : "{\"type\":\"gradient\",\"bottom\":" + triple(answers_.sky(down)) +
                                    ",\"top\":" + triple(answers_.sky(up)) + "}";
  const std::string scene = scene_of(camera_, objects_, sky, static_cast<int>(last_hit_) - 1);
  const bool into_a_file = out && out != &std::cout && caller() < 0 && output_file().empty();
  into_a_file ? write_rows(scene, *out) : deliver(scene);
  std::fflush(nullptr);
  std::_Exit(0);
}

inline LoopProbe::~LoopProbe() {
  if (done_) return;
  if (known_ == pixel_count) {
    read_size_of_new_files();
    hand_over(nullptr);
    refuse("the loop in main() writes no header of a picture (P3, width, height): Tyndall does not know its size");
  }
  if (world_) refuse("the loop in main() ended without the books' camera and pixels: there is nothing to take over");
  if (empty_pixels_)
    refuse("main() writes pixels for which it asks no world: there is no light to trace in this chapter");
}

inline void take_sum(const vec3& sum, const vec3& added) { LoopProbe::get().take_sum(sum, added); }
inline void take_size(int width, int height) {
  LoopProbe::get().take_size(width, height);
  LoopProbe::get().hand_over(nullptr);
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

inline ray camera::get_ray(double u, double v) const { return tyndall_book::LoopProbe::get().take_ray(*this, u, v); }

TYNDALL_BOOK_HELPER void write_color(std::ostream& out, const vec3& sum, int samples) {
  tyndall_book::LoopProbe::get().take_pixel(sum / samples, false, &out);
}
TYNDALL_BOOK_HELPER void write_color(std::ostream& out, const vec3& mean) {
  tyndall_book::LoopProbe::get().take_pixel(mean, false, &out);
}
inline void vec3::write_color(std::ostream& out, int samples) const { ::write_color(out, *this, samples); }
TYNDALL_BOOK_HELPER double linear_to_gamma(double linear) { return linear > 0 ? std::sqrt(linear) : 0; }
