#pragma once
#include "files.h"
#include "values.h"

#include <unistd.h>

#include <chrono>
#include <mutex>
#include <optional>
#include <thread>

/// The calls that `tyndall main.cc` inserts into the reader's functions, and what it learns by them before anything is
/// taken over: how get_ray() and the loop around it name a place in the picture.
namespace tyndall_book {

inline int channel() {
  static const int descriptor = std::atoi(std::getenv("TYNDALL_BOOK_CHANNEL"));
  return descriptor;
}
inline void send_bytes(const void* bytes, std::size_t size) {
  for (const char* at = static_cast<const char*>(bytes); size > 0;) {
    const auto sent = write(channel(), at, size);
    if (sent <= 0) std::_Exit(0);
    at += sent, size -= static_cast<std::size_t>(sent);
  }
}
/// Tells the caller. F: a file that is missing, P: the picture, A: answers, E: why there is nothing to be shown.
inline void tell(char kind, const std::string& text) {
  const question head{double(kind), 0, 0, double(text.size())};
  send_bytes(&head, sizeof head), send_bytes(text.data(), text.size());
}

[[noreturn]] inline void give_up(const std::string& why) {
  tell('E', why);
  std::_Exit(0);
}

/// What the camera's members tell of the picture.
template <class C>
picture_told size_of(const C& camera) {
  picture_told size;
  members<C>::each(camera, [&](const char*, char role, const auto& member) {
    using M = std::decay_t<decltype(member)>;
    double* to = role == 'w' ? &size.width : role == 'h' ? &size.height : role == 's' ? &size.samples : nullptr;
    if constexpr (std::is_integral<M>::value && !std::is_same<M, bool>::value)
      if (to && *to == 0) *to = double(member);
  });
  if (size.width <= 1) size.width = size.height = 0;
  return size;
}
/// Its members as text; defined behind the reader's code.
template <class C>
std::string described_camera(const C& camera);

/// One call of get_ray() of the reader's, as a function of a place in the picture.
struct ray_source {
  const void* (*make)(double, double) = nullptr;  ///< his ray for the arguments
  picture_told (*size)() = nullptr;
  std::string (*described)() = nullptr;
  vector (*side)(int, int) = nullptr;  ///< how far it sees as an argument, of those that are parts, goes from 0 to 1
  bool by_places = false;              ///< the arguments are those of session::ray_at()
  bool by_pixels = false;              ///< the arguments are a column and a row, not parts of the picture's sides
  bool rows_first = false;             ///< they are a row and a column
};

/// Whether this thread is asked by us, which the inserted calls look at: then his functions do what they always do.
static thread_local bool is_ours = false;
/// A world that does not answer by itself what a ray meets, and who does in its place. The record is the reader's.
static thread_local const void* replaced_world = nullptr;
static thread_local bool (*answer_of_world)(const void* ray, double low, double high, void* record) = nullptr;

/// Where rays lie in the picture, and all that is needed to ask for them.
struct session : picture_told {
  bool from_top = false;  ///< get_ray()'s second argument is 0 at the picture's top
  ray_source rays;
  vector (*colour)(const void* ray) = nullptr;  ///< what he computes

  /// A ray through the point, in pixels from the upper left corner.
  const void* ray_at(double x, double y) const {
    if (rays.by_places) return rays.make(x, y);
    const double column = std::fmin(x, width - 1), row = std::fmin(y, height - 1);
    if (rays.by_pixels) return rays.rows_first ? rays.make(row, column) : rays.make(column, row);
    return rays.make(x / (width - less), (from_top ? y : height - y) / (height - less));
  }
};

/// Takes the world over, or serves samples; never returns. Defined behind the reader's code.
[[noreturn]] void take_over(session& s);

/// Only one of the reader's threads at a time; the one that takes over keeps it for good, and the others wait.
struct one_thread {
  inline static std::mutex mutex;
  const std::lock_guard<std::mutex> lock{mutex};
};

/// Watches the first pixels of the reader's loop, whose rays get black at once, until it is known what it does.
class watcher {
 public:
  struct place {
    double first, second;
  };
  inline static ray_source rays;
  inline static thread_local place last;  ///< the last arguments of get_ray()

  /// Whether all is known; called for each ray of the loop.
  static bool knows(session& s) {
    if (seen_.empty()) {
      thread_ = std::this_thread::get_id(), begin_ = std::chrono::steady_clock::now(), size_ = rays.size();
      read_head(size_);
      rows_rise_ = !rays.by_pixels && rays.side(0, 1).y > 0;
      rays.rows_first = rays.by_pixels && std::fabs(rays.side(1, 0).y) > std::fabs(rays.side(0, 1).y);
    }
    if (rays.rows_first) std::swap(last.first, last.second);
    if (thread_ != std::this_thread::get_id()) return false;
    seen_.push_back(last);
    static_cast<picture_told&>(s) = size_;
    s.rays = rays, s.by_pixels = rays.by_pixels;
    const bool high = seen_[0].second >= 0.5;
    s.less = rays.by_pixels || (high && seen_[0].second < 1) ? 0 : 1;
    s.from_top = !rays.by_pixels && !high && !rows_rise_;
    if (s.width > 0 && s.height > 0) return s.samples > 0 || count_samples(s);
    return take_size(s);
  }

 private:
  static bool is_later(int seconds) {
    return std::chrono::steady_clock::now() - begin_ > std::chrono::seconds(seconds);
  }
  static bool count_samples(session& s) {
    const auto column = [&](const place& at) {
      return rays.by_pixels ? at.first : std::floor(at.first * (s.width - s.less));
    };
    const bool same = column(seen_.back()) == column(seen_.front());
    s.samples = double(seen_.size()) - (same ? 0 : 1);
    return !same || seen_.size() >= 20000 || is_later(2);
  }
  /// The size, by a whole row of the loop.
  static bool take_size(session& s) {
    if (seen_.size() < 2) return false;
    if (is_later(10)) give_up("the size of the picture is not known");
    if (seen_.back().first > seen_[seen_.size() - 2].first - (rays.by_pixels ? 2 : 0.5)) return false;
    const std::size_t row = seen_.size() - 1;
    for (std::size_t samples = 1; samples <= row; ++samples) {
      const double columns = static_cast<double>(row / samples), width = rays.by_pixels ? 1 : columns - s.less;
      bool fits = row % samples == 0;
      for (std::size_t k = 0; fits && k < row; ++k) {
        const double column = seen_[k].first * width - static_cast<double>(k / samples);
        fits = column > -0.01 && column < 1.01;  // as far as floats can tell
      }
      if (!fits) continue;
      s.width = columns, s.samples = double(samples);
      const double aspect = length(rays.side(1, 0)) / length(rays.side(0, 1));
      if (s.height == 0) s.height = std::floor(columns / aspect + 0.02);
      return s.height > 0;
    }
    give_up("the size of the picture is not known");
  }

  inline static std::thread::id thread_;
  inline static std::chrono::steady_clock::time_point begin_;
  inline static bool rows_rise_ = false;  ///< rows go up in the world: the picture is turned when it is written
  inline static picture_told size_;
  inline static std::vector<place> seen_;
};

/// Inserted into get_ray(). call: calls it. Each place has a type of its own, so that what is kept is one for each.
template <class C, class F, class A, class B>
void ray_wanted(const C& camera, F call, A first, B second) {
  using ray = decltype(call(first, second));
  static const C* seen;
  static std::optional<F> kept;
  const one_thread only;
  seen = &camera, kept.emplace(call);
  ray_source& rays = watcher::rays;
  watcher::last = {double(first), double(second)};
  rays.by_pixels = std::is_integral<A>::value;
  rays.size = [] { return size_of(*seen); };
  rays.described = [] { return described_camera(*seen); };
  rays.make = [](double a, double b) -> const void* {
    static std::optional<ray> made;
    return &made.emplace((*kept)(static_cast<A>(a), static_cast<B>(b)));
  };
  rays.side = [](int a, int b) {
    vector sum;  // a lens moves single rays
    for (int k = 0; k < 400; ++k) {
      const ray one = (*kept)(static_cast<A>(k % 2 * a), static_cast<B>(k % 2 * b));
      sum = sum + ((k % 2 * 2 - 1) / 200.0) * (ray_traits<ray>::origin(one) + ray_traits<ray>::direction(one));
    }
    return sum;
  };
}

/// Rays that the reader's loop makes itself, without a get_ray(): from those of two rows of its picture it is told how
/// their directions grow with column and row. Whether all is known; called for each ray of the loop.
template <class R>
bool knows_rows(session& s, const R& ray) {
  using rays = ray_traits<R>;
  static std::vector<vector> seen;
  static std::size_t row = 0;
  static picture_told head;
  static vector origin, corner, right, down;  // of the program's only picture
  if (seen.empty() && !read_head(head)) give_up("the size of the picture is not known, or a get_ray()");
  seen.push_back(rays::direction(ray));
  const std::size_t count = seen.size(), width = static_cast<std::size_t>(head.width);
  if (row == 0 && count > width && length(seen[count - 1] - seen[0]) < 0.5 * length(seen[count - 2] - seen[0]))
    row = count - 1;
  if (row == 0 || count < 2 * row) return false;
  if (row % width != 0) give_up("its loop does not go through the picture row by row");
  vector rows[2], ends[2];
  for (std::size_t k = 0; k < 2 * row; ++k) rows[k / row] = rows[k / row] + (1.0 / double(row)) * seen[k];
  for (std::size_t k = 0; k < row; ++k) ends[2 * k / row] = ends[2 * k / row] + (2.0 / double(row)) * seen[k];
  s.width = head.width, s.height = head.height, s.samples = double(row / width);
  origin = rays::origin(ray), right = (2.0 / s.width) * (ends[1] - ends[0]), down = rows[1] - rows[0];
  corner = rows[0] - (0.5 * s.width) * right - 0.5 * down;
  s.rays.by_places = true;
  s.rays.make = [](double x, double y) -> const void* {
    static std::optional<R> made;
    return &made.emplace(rays::make(origin, corner + x * right + y * down, 0));
  };
  return true;
}

/// Inserted into the function that computes the colour of a ray, in place of what it does. ask: calls it; has_camera:
/// there is a get_ray().
template <class Shape, bool has_camera, class F, class R, class W>
auto colour_wanted(F ask, R& ray, W& world, int depth) -> decltype(ask(ray)) {
  const one_thread only;
  session s;
  is_ours = true;
  if (has_camera && !watcher::rays.make) {  // no camera yet: a test of the reader's
    auto made = ask(ray);
    is_ours = false;
    return made;
  }
  is_ours = has_camera ? watcher::knows(s) : knows_rows<std::remove_const_t<R>>(s, ray);
  if (!is_ours) return {};
  static F* query;
  query = &ask;
  s.world = number_of(static_cast<const Shape*>(pointer(world))), s.depth = depth;
  s.first_row = s.less != 0 && !s.from_top;
  s.colour = [](const void* a_ray) { return to_vector((*query)(*static_cast<const std::remove_const_t<R>*>(a_ray))); };
  take_over(s);
}

}  // namespace tyndall_book
