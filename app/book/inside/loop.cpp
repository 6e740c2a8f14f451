#include "app/book/inside/inside.h"
#include "app/book/inside/reading.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <utility>

/// How get_ray() and the loop around it name a place in the picture.
namespace tyndall_book {
namespace {

picture_told picture;
bool from_top = false;    // get_ray()'s second argument is 0 at the picture's top
bool rows_first = false;  // its arguments are a row and a column

/// The thread whose loop is watched: the first one that asks for a colour.
std::atomic<std::thread::id> watched{};

std::mutex& mutex() {
  static std::mutex only;
  return only;
}

struct Place {
  double first = 0, second = 0;
};
thread_local Place last;

/// How far get_ray() sees as an argument, of those that are parts, goes from 0 to 1; a lens moves single rays.
vector side(double a, double b) {
  vector sum;
  for (int k = 0; k < 400; ++k) {
    const ray_parts one = loop().parts(loop().ray(k % 2 * a, k % 2 * b));
    sum = sum + ((k % 2 * 2 - 1) / 200.0) * (one.from + one.to);
  }
  return sum;
}

/// Watches the first pixels of the reader's loop, until it is known what it does.
class Watcher {
 public:
  bool knows() {
    if (seen_.empty()) begin();
    if (rows_first) std::swap(last.first, last.second);
    seen_.push_back(last);
    const bool is_known = knows_divisor();
    from_top = !loop().by_pixels && seen_[0].second < 0.5 && !rows_rise_;
    picture.first_row = picture.less != 0 && !from_top ? 1 : 0;
    if (picture.width > 0 && picture.height > 0) return (picture.samples > 0 || counts_samples()) && is_known;
    return takes_size();
  }

 private:
  void begin() {
    loop().tell_size(picture);
    if (picture.width <= 1) picture.width = picture.height = 0;
    read_head(picture);
    picture.by_pixels = loop().by_pixels;
    rows_rise_ = !picture.by_pixels && side(0, 1).y > 0;
    rows_first = picture.by_pixels && std::fabs(side(1, 0).y) > std::fabs(side(0, 1).y);
  }
  /// A loop begins in the first row or the last one, whose place tells what it divides by. That of one of several
  /// threads may begin elsewhere: then the end of a row tells.
  bool knows_divisor() {
    const double row = seen_[0].second, edge = 1.5 / std::max(picture.height, 1);
    const bool is_between = !loop().by_pixels && row > edge && row < 1 - edge;
    farthest_ = std::fmax(farthest_, last.first);
    picture.less = loop().by_pixels || (is_between ? farthest_ < 1 : row >= 0.5 && row < 1) ? 0 : 1;
    return !is_between || last.first < farthest_ - 0.5 || is_later(2);
  }
  bool is_later(int seconds) const { return std::chrono::steady_clock::now() - begin_ > std::chrono::seconds(seconds); }
  bool counts_samples() {
    const auto pixel = [&](const Place& at) {
      if (picture.by_pixels) return std::pair(at.first, at.second);
      return std::pair(std::floor(at.first * (picture.width - picture.less)),
                       std::floor(at.second * (picture.height - picture.less)));
    };
    const bool same = pixel(seen_.back()) == pixel(seen_.front());
    if (same && seen_.size() < 20000 && !is_later(2)) return false;
    picture.samples = static_cast<int>(seen_.size()) - (same ? 0 : 1);
    return true;
  }
  /// By a whole row of the loop.
  bool takes_size() {
    if (seen_.size() < 2) return false;
    if (is_later(10)) give_up("the size of the picture is not known");
    if (seen_.back().first > seen_[seen_.size() - 2].first - (picture.by_pixels ? 2 : 0.5)) return false;
    const std::size_t row = seen_.size() - 1;
    for (std::size_t samples = 1; samples <= row; ++samples) {
      const int columns = static_cast<int>(row / samples), width = picture.by_pixels ? 1 : columns - picture.less;
      bool fits = row % samples == 0;
      for (std::size_t k = 0; fits && k < row; ++k) {
        const auto wanted = static_cast<int>(k / samples);
        const double column = seen_[k].first * width - wanted;
        fits = column > -0.01 && column < 1.01;  // as far as floats can tell
      }
      if (!fits) continue;
      picture.width = columns, picture.samples = static_cast<int>(samples);
      const double aspect = length(side(1, 0)) / length(side(0, 1));
      if (picture.height == 0) picture.height = static_cast<int>(columns / aspect + 0.02);
      return picture.height > 0;
    }
    give_up("the size of the picture is not known");
  }

  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  bool rows_rise_ = false;  ///< rows go up in the world: the picture is turned when it is written
  double farthest_ = 0;     ///< the largest first argument
  std::vector<Place> seen_;
};

/// Rays that the reader's loop makes itself, without a get_ray(): from those of two rows of its picture it is told how
/// their directions grow with column and row.
class RowWatcher {
 public:
  bool knows(const ray_parts& ray) {
    if (seen_.empty() && !read_head(picture)) give_up("the size of the picture is not known, or a get_ray()");
    seen_.push_back(ray.to);
    const std::size_t count = seen_.size(), width = static_cast<std::size_t>(picture.width);
    if (row_ == 0 && count > width && length(seen_[count - 1] - seen_[0]) < 0.5 * length(seen_[count - 2] - seen_[0]))
      row_ = count - 1;
    if (row_ == 0 || count < 2 * row_) return false;
    if (row_ % width != 0) give_up("its loop does not go through the picture row by row");
    vector rows[2], ends[2];
    const double part = 1 / static_cast<double>(row_);
    for (std::size_t k = 0; k < 2 * row_; ++k) rows[k / row_] = rows[k / row_] + part * seen_[k];
    for (std::size_t k = 0; k < row_; ++k) ends[2 * k / row_] = ends[2 * k / row_] + 2 * part * seen_[k];
    picture.samples = static_cast<int>(row_ / width);
    origin_ = ray.from, right_ = (2.0 / picture.width) * (ends[1] - ends[0]), down_ = rows[1] - rows[0];
    corner_ = rows[0] - (0.5 * picture.width) * right_ - 0.5 * down_;
    return true;
  }
  const void* ray_at(double x, double y) const { return loop().made({origin_, corner_ + x * right_ + y * down_}); }

 private:
  std::vector<vector> seen_;  ///< directions
  std::size_t row_ = 0;
  vector origin_, corner_, right_, down_;
};
RowWatcher& rows() {
  static RowWatcher watcher;
  return watcher;
}

const void* object_at(double x, double y) {
  if (!loop().ray) return rows().ray_at(x, y);
  const double column = std::fmin(x, picture.width - 1), row = std::fmin(y, picture.height - 1);
  if (picture.by_pixels) return rows_first ? loop().ray(row, column) : loop().ray(column, row);
  const double less = picture.less;
  return loop().ray(x / (picture.width - less), (from_top ? y : picture.height - y) / (picture.height - less));
}

vector sample(const pixel_place& at) {
  try {
    return loop().colour(object_at(at.x, at.y));
  } catch (...) {  // of the reader's
    return {NAN, NAN, NAN};
  }
}

}  // namespace

one_thread::one_thread() {
  const std::thread::id one = watched;
  if (one != std::thread::id() && one != std::this_thread::get_id())  // it would only be in the other one's way
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  mutex().lock();
}
one_thread::~one_thread() { mutex().unlock(); }

program_loop& loop() {
  static program_loop only;
  return only;
}
void keep_place(double first, double second) { last = {first, second}; }

bool knows_loop(const void* ray) {
  static Watcher watcher;
  if (watched.load() == std::thread::id()) watched = std::this_thread::get_id();
  if (watched.load() != std::this_thread::get_id()) return false;
  return loop().ray ? watcher.knows() : rows().knows(loop().parts(ray));
}

ray_parts ray_at(double x, double y) { return loop().parts(object_at(x, y)); }

void serve(const program_functions* functions) {
  for (const std::string& name : missing_files()) tell('F', name);
  picture.depth = loop().depth;
  tell('P', &picture, sizeof picture);
  std::string scene = "its classes are not those of the books";
  if (functions && !std::getenv("TYNDALL_BOOK_SAMPLES")) scene = tyndall::read_scene(*functions, picture);
  for (const std::string& note : seen_alone()) tell('N', note);
  tell('P', &picture, sizeof picture), tell('S', scene);
  for (;;) {
    const std::string places = next_message();
    std::vector<vector> colours;
    for (std::size_t k = 0; k < places.size() / sizeof(pixel_place); ++k)
      colours.push_back(sample(reinterpret_cast<const pixel_place*>(places.data())[k]));
    tell('A', colours.data(), colours.size() * sizeof(vector));
  }
}

}  // namespace tyndall_book
