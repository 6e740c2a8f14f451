#pragma once
#include "tests/bench/table.h"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// Measurements of speed and accuracy. They are no tests: nothing fails for being slow. Figures of one run can be
/// compared; those of two runs only where the machine was equally quiet.
namespace tyndall::bench {

/// What one run is asked to do.
struct Settings {
  std::vector<std::string> parts;          ///< names, in the order of parts()
  std::filesystem::path json;              ///< where to write all figures; empty: nowhere
  std::filesystem::path references = ".";  ///< folder of the reference images
  std::filesystem::path against;           ///< another program "tyndall"; empty: none
  bool quick = false;                      ///< shorter and less exact
  bool thorough = false;                   ///< also what takes minutes
  int repeat = 0;                          ///< repetitions of each measurement; 0: each part's own number
};

/// Something that was measured is wrong: two methods that must agree do not.
struct WrongResult : std::runtime_error {
  using runtime_error::runtime_error;
};

// Each part prints its table while it measures, and returns its rows. Throws WrongResult.
Json measure_throughput(const Settings& settings);      ///< camera samples and rays a second, one thread
Json measure_accuracy(const Settings& settings);        ///< seconds to a given error, two threads
Json measure_closest(const Settings& settings);         ///< closest hits a second, beside Embree's
Json measure_tree(const Settings& settings);            ///< build time and memory of trees over spheres
Json measure_edits(const Settings& settings);           ///< milliseconds from an edit to its picture
Json measure_approximations(const Settings& settings);  ///< how far each approximation moves the mean of pictures
Json measure_clean(const Settings& settings);           ///< milliseconds that the clean view of a film takes
Json measure_start(const Settings& settings);           ///< wall time of the smallest render as a process
Json measure_against(const Settings& settings);  ///< speed and seconds to an error beside another program, in pairs

struct Part {
  const char* name;
  const char* about;
  Json (*measure)(const Settings& settings);
};
const std::vector<Part>& parts();

}  // namespace tyndall::bench
