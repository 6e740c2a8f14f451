#pragma once
#include "answers.h"
#include "camera.h"
#include "rows.h"
#include "spy.h"
#include "sums.h"

#include <sys/stat.h>
#include <dirent.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <mutex>
#include <thread>

namespace tyndall_book {

/// Follows the loop of main() until it knows enough. A pixel ends by write_color(), or with three numbers on std::cout,
/// or, where the loop fills a buffer, when the colours of rays are added to another sum. Of a loop in several threads
/// the first one is followed, while the others wait. If the picture's size is not known by then, the loop goes on,
/// without anything to hit, until main() writes it.
class LoopProbe {
 public:
  static LoopProbe& get() {
    static LoopProbe probe;
    return probe;
  }
  ~LoopProbe();

  ray take_ray(const camera& cam, double u, double v);
  bool take_hit(const hittable& world, hit_record& record);
  /// A pixel has ended; out: null for standard output.
  void take_pixel(const vec3& mean, bool coarse, std::ostream* out);
  /// Something is added to a vector, which may be the sum of a pixel.
  void take_sum(const vec3& sum, const vec3& added);
  void take_size(int width, int height);
  /// Delivers the scene, if all is known.
  void hand_over(std::ostream* out);
  /// What the thing that was hit shines with, and what it reflects; 0: it does not scatter.
  double emission(bool of_third_book);
  double reflected();

 private:
  bool is_probing_thread();
  void check_time();
  void check_progress();
  void check_pixel();
  void end_ray();
  void begin_sums();
  void end_pixel(const vec3& mean);
  void forget_pixel();
  void follow_words();
  void follow_rows(double u, double v);
  bool read_size(std::ostream* out);
  void read_size_of(const std::string& file);
  void read_size_of_new_files();
  std::string summary() const;
  void conclude();

  camera_values camera_;
  const camera* seen_camera_ = nullptr;
  const hittable* world_ = nullptr;
  std::atomic<std::thread::id> probing_thread_{};
  std::clock_t begin_ = 0;
  std::chrono::steady_clock::time_point wall_begin_;
  int known_ = 0;                                           ///< pixels
  long rays_ = 0, hits_ = 0, scatters_ = 0, ray_hits_ = 0;  ///< of this pixel, and of its newest ray
  long samples_ = 0, depth_ = 0, last_hit_ = 0;             ///< rays a pixel; scatterings and hits of the longest path
  bool one_sided_lights_ = false, empty_pixels_ = false, done_ = false;
  LoopAnswers answers_;

  SumFollower sums_;
  RowFollower rows_;
  bool by_sums_ = false;                                   ///< pixels are told apart by their sums
  bool has_words_ = false;                                 ///< they are told apart by write_color() or std::cout
  bool counts_ = false, counted_ = false, whole_ = false;  ///< rays a pixel are counted by light, as the sky is black
  bool skips_ = false;                                     ///< the rest of this pixel
  std::atomic<bool> is_known_{false};                      ///< all but the picture's size
  std::atomic<long> all_rays_{0};
  bool has_size_ = false;
  std::time_t first_ray_ = 0;
  std::mutex handing_over_;
  scene_text objects_;
};

/// Whether this thread is the one whose pixels are followed: the first that asks. Other threads wait here until all is
/// known, for 10 seconds at most; from then on no thread is followed.
inline bool LoopProbe::is_probing_thread() {
  if (is_known_) return false;
  std::thread::id nobody{};
  const std::thread::id self = std::this_thread::get_id();
  if (probing_thread_.compare_exchange_strong(nobody, self) || nobody == self) return true;
  constexpr std::chrono::seconds patience(10);
  const auto begin = std::chrono::steady_clock::now();
  while (!is_known_ && std::chrono::steady_clock::now() - begin < patience)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  if (!is_known_)
    refuse("main() computes its picture in threads of its own, of which none does whole pixels: Tyndall cannot follow");
  return false;
}

inline void LoopProbe::check_progress() {
  constexpr long limit = 2000000;
  constexpr std::clock_t max_seconds = 5;
  constexpr std::chrono::seconds max_wall_seconds(8);  // less than the caller waits, also on a busy machine
  const auto now = std::chrono::steady_clock::now();
  if (begin_ == 0) begin_ = std::clock() + 1, wall_begin_ = now, first_ray_ = std::time(nullptr);
  const bool late = known_ == 0 && rays_ % 1024 == 0 &&
                    (std::clock() - begin_ > max_seconds * CLOCKS_PER_SEC || now - wall_begin_ > max_wall_seconds);
  if (rays_ > limit || late)
    refuse(
        "the loop in main() ends no pixel by write_color() or on std::cout, and adds no colours of rays to a sum: "
        "Tyndall sees nothing that it could take over");
}

/// Ends a loop that goes on for its size alone, if that takes too long.
inline void LoopProbe::check_time() {
  constexpr std::chrono::seconds longest(16);
  const long rays = ++all_rays_;
  if (rays % 65536 == 0) hand_over(nullptr);
  if (rays % 4096 != 0 || std::chrono::steady_clock::now() - wall_begin_ < longest) return;
  refuse(
      "main() tells the size of its picture only after its loop, which takes too long for Tyndall to wait for: fewer "
      "samples there, or a header (P3, width, height) before the loop, help");
}

inline ray LoopProbe::take_ray(const camera& cam, double u, double v) {
  if (!is_probing_thread()) {
    check_time();
    return ray(cam.lookfrom, direction_of(up), cam.shutter_open);
  }
  end_ray();
  if (known_ == pixel_count) {
    follow_rows(u, v);
    return ray(cam.lookfrom, direction_of(up), cam.shutter_open);
  }
  check_progress();
  if (!seen_camera_) camera_ = cam;
  if (seen_camera_ && seen_camera_ != &cam) refuse("the loop in main() takes rays of several cameras");
  seen_camera_ = &cam;
  follows_sums = true;
  ++all_rays_;
  ++rays_;
  ray_hits_ = 0;
  return ray(cam.lookfrom, direction_of(known_), cam.shutter_open);
}

inline void LoopProbe::take_sum(const vec3& sum, const vec3& added) {
  if (is_known_ || rays_ == 0 || probing_thread_.load() != std::this_thread::get_id()) return;
  sums_.take(sum, added);
}

/// Looks at what the newest ray has been added to, when the next one begins.
inline void LoopProbe::end_ray() {
  if (rays_ == 0 || known_ == pixel_count) return;
  const SumFollower::Step step = sums_.end_ray();
  if (step == SumFollower::none) return;
  const bool has_light = sums_.total().length_squared() > 0;
  if (by_sums_) {
    if (rays_ > 1 && step == SumFollower::other)
      refuse("the loop in main() takes more samples in some pixels than in others");
    if (rays_ < samples_) return;
    skips_ ? forget_pixel() : end_pixel(sums_.total() / static_cast<double>(samples_));
    return;
  }
  if (known_ > 0 || has_words_) return;
  if (rays_ == 1 && !has_light && !counted_) counts_ = counted_ = true;
  if (step == SumFollower::other) begin_sums();
}

/// A pixel has ended without a word: pixels are told apart by their sums from now on. The newest ray is the first of a
/// pixel that is left out.
inline void LoopProbe::begin_sums() {
  const bool is_partial = counts_ && !whole_;  // its first ray met nothing, and the sum may be older than that
  const long in_pixel = rays_ - 1, hits = hits_ - ray_hits_;
  whole_ = true;
  if (!is_partial) {
    by_sums_ = true;
    samples_ = rays_ = in_pixel;
    hits_ = hits;
    if (!counts_) end_pixel(sums_.total_before() / static_cast<double>(in_pixel));
    counts_ = false;
    skips_ = true;
  }
  rays_ = 1;
  hits_ = scatters_ = 0;
  if (by_sums_ && samples_ == 1) forget_pixel();
}

inline void LoopProbe::forget_pixel() {
  rays_ = hits_ = scatters_ = 0;
  counts_ = skips_ = false;
  sums_.reset();
}

inline void LoopProbe::end_pixel(const vec3& mean) {
  check_pixel();
  answers_.mean[known_++] = mean;
  forget_pixel();
  if (known_ == pixel_count) conclude();
}

}  // namespace tyndall_book
