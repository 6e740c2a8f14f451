#pragma once
#include "core/base/seconds.h"
#include "core/scene/scene.h"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

/// Measurements of speed and accuracy. They are no tests: nothing fails for being slow. Figures of one run can be
/// compared; those of two runs only where the machine was equally quiet.
namespace tyndall::bench {

/// What one run is asked to do.
struct Settings {
  std::vector<std::string> parts;  ///< names; none: all
  std::filesystem::path against;   ///< another program "tyndall"; empty: none
  bool quick = false;              ///< shorter and less exact
};

/// Something that was measured is wrong: two methods that must agree do not.
struct WrongResult : std::runtime_error {
  using runtime_error::runtime_error;
};

// Each part prints its table while it measures. Throws WrongResult.
void measure_accuracy(const Settings& settings);
void measure_closest(const Settings& settings);
void measure_clean(const Settings& settings);
void measure_approximations(const Settings& settings);

/// A table that is printed row by row, as the figures come: the first column to the left, the others to the right.
class Table {
 public:
  Table(const std::string& title, std::vector<std::string> headings);
  void add(const std::vector<std::string>& cells) const;

 private:
  std::vector<std::string> headings_;
};

/// A number with so many digits after the point; "-" for what is none.
std::string cell(double value, int digits);

/// Wall time of a call in seconds.
template <class Call>
double seconds_of(Call&& call) {
  const Clock::time_point start = Clock::now();
  call();
  return seconds_since(start);
}

/// The value that `fraction` (in [0, 1]) of the values do not exceed, interpolated between neighbours; not a number for
/// none.
double quantile(std::vector<double> values, double fraction);
double median(std::vector<double> values);

/// Threads that this process may run at once (see thread_count), at most two.
int two_threads();

struct NamedScene {
  std::string name;
  Scene scene;
};

/// A built-in scene in another size. Throws SceneError.
Scene built_in(const std::string& name, int width, int height);

}  // namespace tyndall::bench
