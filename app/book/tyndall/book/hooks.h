#pragma once
#include "files.h"
#include "values.h"

#include <pthread.h>
#include <time.h>
#include <unistd.h>

#include <cstdint>
#include <new>
#include <ostream>

/// The calls that `tyndall main.cc` inserts into the reader's functions, and what it learns by them before anything is
/// taken over: how get_ray() and the loop around it name a place in the picture.
namespace tyndall_book {

// Messages to the caller: a letter (P: picture, S: scene, N: note, O: own samples are all there is), the number of
// bytes, a line end, the bytes. Then numbers, see serve().
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
inline void tell(char kind, const std::string& text) {
  const std::string message = kind + std::to_string(text.size()) + "\n" + text;
  send_bytes(message.data(), message.size());
}

/// The camera as its members tell it, by any edition's names. Angles in degrees.
struct camera_values {
  bool known = false;
  vector look_from, look_at{0, 0, -1}, vup{0, 1, 0};
  double vfov = 90, defocus_angle = 0, focus_distance = 1, open = 0, close = 0;
  int width = 0, height = 0, samples = 0;
};
template <class C>
camera_values read_camera(const C& camera);

/// One call of get_ray() of the reader's, as a function of a place in the picture.
struct ray_source {
  const void* (*make)(double, double) = nullptr;  ///< his ray for the arguments
  camera_values (*read)() = nullptr;
  double (*aspect)() = nullptr;  ///< width over height of what it sees, of one whose arguments are parts
  bool by_places = false;        ///< the arguments are those of session::ray_at()
  bool by_pixels = false;        ///< the arguments are a column and a row, not parts of the picture's sides
  double first = 0, second = 0;  ///< the last arguments
};

/// The size that the reader's program writes at the head of its picture; 0: it has not yet.
struct picture_head {
  int width = 0, height = 0;
  static picture_head& get() {
    static picture_head head;
    return head;
  }
};

/// Whether this thread is asked by us: then the reader's functions do what they always do.
static thread_local bool is_ours = false;
/// What the inserted calls ask first.
inline bool is_watching() { return !is_ours; }

/// Where rays lie in the picture, and all that is needed to ask for them.
struct session {
  int width = 0, height = 0, samples = 0;
  int less = 0;           ///< 1: the loop divides by width - 1 and height - 1, as editions 2 and 3 do
  bool from_top = false;  ///< get_ray()'s second argument is 0 at the picture's top
  ray_source rays;
  camera_values camera;
  const void* world = nullptr;                               ///< the reader's, of class N::shape
  int depth = 0;                                             ///< that his loop begins with
  bool has_other_worlds = false;                             ///< colour() takes others than his
  vector (*colour)(const void* ray, void* other) = nullptr;  ///< what he computes; other: see above, else null

  /// A ray through the point, in pixels from the upper left corner.
  const void* ray_at(double x, double y) const {
    if (rays.by_places) return rays.make(x, y);
    if (rays.by_pixels) return rays.make(std::fmin(x, width - 1), std::fmin(y, height - 1));
    return rays.make(x / (width - less), (from_top ? y : height - y) / (height - less));
  }
};

/// Takes the world over, or serves samples; never returns. Defined behind the reader's code.
[[noreturn]] void take_over(session& s);

/// Watches the first pixels of the reader's loop, whose rays get black at once, until it is known what it does.
class watcher {
 public:
  static watcher& get() {
    static watcher one;
    return one;
  }
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;  ///< kept for good by the thread that takes over; the others wait
  ray_source rays;

  /// Whether all is known; called for each ray of the loop.
  bool knows(session& s) {
    if (seen_.empty()) thread_ = pthread_self(), begin_ = now(), camera_ = rays.read();
    if (!pthread_equal(thread_, pthread_self())) return false;
    seen_.push_back({rays.first, rays.second});
    s.camera = camera_, s.rays = rays;
    const picture_head& head = picture_head::get();
    s.width = head.width > 0 ? head.width : camera_.width;
    s.height = head.width > 0 ? head.height : camera_.height;
    s.samples = camera_.samples;
    const bool high = seen_[0].second >= 0.5;
    s.less = rays.by_pixels || (high && seen_[0].second < 1) ? 0 : 1;
    s.from_top = !rays.by_pixels && !high && !is_upside_down();
    if (s.width > 0 && s.height > 0) return s.samples > 0 || count_samples(s);
    return take_size(s);
  }

 private:
  struct place {
    double first, second;
  };
  static double now() {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
  }
  double seconds() const { return now() - begin_; }
  /// Whether the first row is low in the world: such a picture is turned when it is written.
  bool is_upside_down() const { return camera_.known; }
  bool count_samples(session& s) {
    const auto column = [&](const place& at) {
      return rays.by_pixels ? at.first : std::floor(at.first * (s.width - s.less));
    };
    const bool same = column(seen_.back()) == column(seen_.front());
    s.samples = static_cast<int>(seen_.size()) - (same ? 0 : 1);
    return !same || seen_.size() >= 20000 || seconds() > 2;
  }
  /// The size, by a whole row of the loop.
  bool take_size(session& s) {
    if (seen_.size() < 2) return false;
    const double side = rays.by_pixels ? 2 : 0.5;
    if (seen_.back().first > seen_[seen_.size() - 2].first - side) {
      if (seconds() > 10) throw not_taken{"the size of the picture is not known"};
      return false;
    }
    const std::size_t row = seen_.size() - 1;
    for (std::size_t samples = 1; samples <= row; ++samples) {
      if (row % samples != 0) continue;
      const double columns = static_cast<double>(row / samples);
      bool fits = true;
      for (std::size_t k = 0; fits && k < row; ++k) {
        const double column = rays.by_pixels ? seen_[k].first : seen_[k].first * (columns - s.less);
        const double expected = static_cast<double>(k / samples);
        fits = column > expected - 0.01 && column < expected + 1.01;  // as far as floats can tell
      }
      if (!fits) continue;
      s.width = static_cast<int>(columns), s.samples = static_cast<int>(samples);
      s.height = camera_.height > 0 ? camera_.height : static_cast<int>(columns / rays.aspect() + 0.02);
      return s.height > 0;
    }
    throw not_taken{"the size of the picture is not known"};
  }

  pthread_t thread_{};
  double begin_ = 0;
  camera_values camera_;
  std::vector<place> seen_;
};

/// Only one of the reader's threads at a time.
struct one_thread {
  one_thread() { pthread_mutex_lock(&watcher::get().mutex); }
  ~one_thread() { pthread_mutex_unlock(&watcher::get().mutex); }
};

/// Inserted into get_ray(). call: calls it. Each place has a type of its own, so that what is kept is one for each.
template <class C, class F, class A, class B>
void ray_wanted(const C& camera, F call, A first, B second) {
  using ray = decltype(call(first, second));
  static const C* seen;
  alignas(F) static unsigned char kept[sizeof(F)];
  const one_thread only;
  seen = &camera;
  new (kept) F(call);
  ray_source& rays = watcher::get().rays;
  rays.first = double(first), rays.second = double(second);
  rays.by_pixels = std::is_integral<A>::value;
  rays.read = [] { return read_camera(*seen); };
  rays.make = [](double a, double b) -> const void* {
    alignas(ray) static unsigned char memory[sizeof(ray)];
    return new (memory) ray((*reinterpret_cast<F*>(kept))(static_cast<A>(a), static_cast<B>(b)));
  };
  rays.aspect = [] {
    vector sums[3];  // a lens moves single rays
    for (int k = 0; k < 600; ++k) {
      const ray one = (*reinterpret_cast<F*>(kept))(static_cast<A>(k % 3 == 1), static_cast<B>(k % 3 == 2));
      sums[k % 3] = sums[k % 3] + ray_traits<ray>::origin(one) + ray_traits<ray>::direction(one);
    }
    return length(sums[1] - sums[0]) / length(sums[2] - sums[0]);
  };
}

/// Rays that the reader's loop makes itself, without a get_ray(): from those of two rows of its picture it is told how
/// their directions grow with column and row.
template <class R>
class row_watcher {
 public:
  /// Whether all is known; called for each ray of the loop.
  static bool knows(session& s, const R& ray) {
    using rays = ray_traits<R>;
    static std::vector<vector> seen;
    static std::size_t row = 0;
    const picture_head& head = picture_head::get();
    if (head.width < 2 || head.height < 2) throw not_taken{"the size of the picture is not known, or a get_ray()"};
    seen.push_back(rays::direction(ray));
    const std::size_t count = seen.size(), width = static_cast<std::size_t>(head.width);
    if (row == 0 && count > width && length(seen[count - 1] - seen[0]) < 0.5 * length(seen[count - 2] - seen[0]))
      row = count - 1;
    if (row == 0 || count < 2 * row) return false;
    if (row % width != 0) throw not_taken{"its loop does not go through the picture row by row"};
    vector rows[2], ends[2];
    for (std::size_t k = 0; k < 2 * row; ++k) rows[k / row] = rows[k / row] + (1.0 / double(row)) * seen[k];
    for (std::size_t k = 0; k < row; ++k) ends[2 * k / row] = ends[2 * k / row] + (2.0 / double(row)) * seen[k];
    s.width = head.width, s.height = head.height, s.samples = static_cast<int>(row / width);
    frame& f = its();
    f.origin = rays::origin(ray), f.right = (2.0 / s.width) * (ends[1] - ends[0]), f.down = rows[1] - rows[0];
    f.corner = rows[0] - (0.5 * s.width) * f.right - 0.5 * f.down;
    s.rays.by_places = true;
    s.rays.make = [](double x, double y) -> const void* {
      alignas(R) static unsigned char memory[sizeof(R)];
      const frame& now = its();
      return new (memory) R(rays::make(now.origin, now.corner + x * now.right + y * now.down, 0));
    };
    return true;
  }

 private:
  struct frame {
    vector origin, corner, right, down;
  };
  static frame& its() {  ///< of the program's only picture
    static frame f;
    return f;
  }
};

/// A world for a reader's function that takes one of class W: his list of one shape, or the shape itself.
template <class Shape, class W, class F>
vector with_world(Shape* shape, const F& ask) {
  const std::shared_ptr<Shape> shared(shape, [](Shape*) {});
  using plain = std::remove_const_t<W>;
  if constexpr (std::is_same<plain, Shape>::value) {
    return ask(*shape);
  } else if constexpr (std::is_pointer<plain>::value || std::is_same<plain, std::shared_ptr<Shape>>::value ||
                       std::is_same<plain, std::shared_ptr<const Shape>>::value) {
    if constexpr (std::is_convertible<Shape*, plain>::value) {
      plain world = shape;
      return ask(world);
    } else if constexpr (std::is_constructible<plain, std::shared_ptr<Shape>>::value) {
      plain world = shared;
      return ask(world);
    }
  } else if constexpr (std::is_default_constructible<plain>::value) {
    plain world{};
    if constexpr (TYNDALL_HAS(plain, o.add(std::shared_ptr<Shape>())))
      return world.add(shared), ask(world);
    else if constexpr (TYNDALL_HAS(plain, o.objects.push_back(std::shared_ptr<Shape>())))
      return world.objects.push_back(shared), ask(world);
    else if constexpr (TYNDALL_HAS(plain, o.add(static_cast<Shape*>(nullptr))))
      return world.add(shape), ask(world);
  }
  throw not_taken{"the world cannot be replaced to ask for the sky"};
}

/// Inserted into the function that computes the colour of a ray in a world, in place of what it does. ask: calls it.
/// is_given: the world is an argument, so that another one can be asked; has_camera: there is a get_ray().
template <class Shape, bool is_given, bool has_camera, class F, class R, class W>
auto colour_wanted(F ask, R& ray, W& world, int depth) -> decltype(ask(ray, world, depth)) {
  using colour = decltype(ask(ray, world, depth));
  const one_thread only;
  watcher& w = watcher::get();
  session s;
  is_ours = true;
  if (has_camera && !w.rays.make) {  // no camera yet: a test of the reader's
    colour made = ask(ray, world, depth);
    is_ours = false;
    return made;
  }
  try {
    const bool known = has_camera ? w.knows(s) : row_watcher<std::remove_const_t<R>>::knows(s, ray);
    is_ours = known;
    if (!known) return colour{};
  } catch (const not_taken& why) {
    tell('E', why.reason);
    std::_Exit(0);
  }
  static F* query;
  static W* his;
  static int begin;
  query = &ask, his = &world, begin = depth;
  s.world = static_cast<const Shape*>(pointer(world));
  s.depth = depth, s.has_other_worlds = is_given;
  s.colour = [](const void* a_ray, void* other) {
    const auto& its_ray = *static_cast<const std::remove_const_t<R>*>(a_ray);
    if (!other) return to_vector((*query)(its_ray, *his, begin));
    return with_world<Shape, W>(static_cast<Shape*>(other),
                                [&](auto& given) { return to_vector((*query)(its_ray, given, begin)); });
  };
  take_over(s);
}

/// Catches the size behind the "P3" that the reader's program writes to a stream or prints.
struct head_text {
  const char* text;
};
class head_stream {
 public:
  explicit head_stream(std::ostream& out) : out_(out) {}
  template <class T>
  head_stream& operator<<(const T& part) {
    if constexpr (std::is_integral<T>::value && !std::is_same<T, char>::value) take(static_cast<int>(part));
    out_ << part;
    return *this;
  }
  head_stream& operator<<(std::ostream& (*change)(std::ostream&)) {
    out_ << change;
    return *this;
  }
  operator std::ostream&() { return out_; }
  static void take(int size) {
    static int count = 0;
    picture_head& head = picture_head::get();
    if (++count == 1) head.width = size;
    if (count == 2) head.height = size;
  }

 private:
  std::ostream& out_;
};
inline head_stream operator<<(std::ostream& out, head_text head) {
  out << head.text;
  return head_stream(out);
}
template <class T>
T head_size(T size) {
  head_stream::take(static_cast<int>(size));
  return size;
}

}  // namespace tyndall_book
