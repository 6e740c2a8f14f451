#pragma once
#include "core/base/error.h"
#include "core/base/fields.h"
#include "core/film/film.h"
#include "core/scene/load.h"
#include "core/scene/settings.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// The values of command-line options, as text and as what they mean. All readers take the whole text or throw
/// UsageError `found "X", expected Y`; nothing is clamped.
namespace tyndall {

struct Size {
  int width = 0, height = 0;  ///< pixels
};

/// first <= n < last.
template <class T>
struct Range {
  T first = 0, last = 0;
};
using SampleRange = Range<std::uint32_t>;
using FrameRange = Range<int>;

/// One sample of a pixel.
struct SampleKey {
  int x = 0, y = 0;
  std::uint32_t sample = 0;
};

/// What stands between the separators.
std::vector<std::string> split_at(const std::string& text, char separator);
/// A whole number, low <= n <= high.
std::int64_t read_whole(const std::string& text, std::int64_t low, std::int64_t high);
/// The same; expected: "a whole number >= 0", ...
std::int64_t read_whole(const std::string& text, Valid valid, const std::string& expected);
/// A finite number in a range. expected: "a number > 0", ...
double read_number(const std::string& text, Valid valid, const std::string& expected);
/// WIDTHxHEIGHT, both at least 1.
Size read_size(const std::string& text);
/// A:B, A < B, at most max_samples of them.
SampleRange read_samples(const std::string& text);
/// A:B, A < B.
FrameRange read_frames(const std::string& text);
/// X0,Y0,X1,Y1 with X0 < X1 and Y0 < Y1.
Region read_region(const std::string& text);
/// X,Y,SAMPLE, none below 0.
SampleKey read_sample_key(const std::string& text);
/// POINTER=VALUE; the pointer starts with "/".
Override read_override(const std::string& text);
/// A file name with one of these endings (".png", any case).
std::filesystem::path read_file_name(const std::string& text, const std::vector<std::string>& endings);
/// The index of text in names. The message of a near miss suggests what was meant.
std::size_t read_name(const std::string& text, const std::vector<std::string>& names);

/// A value of the scene by its JSON pointer, and what it is to be in turn in a sweep, each as --set takes it.
struct SweepAxis {
  std::string pointer;
  std::vector<std::string> values;
};
inline constexpr int max_sweep_steps = 10000;
/// POINTER=FROM:TO:STEPS, POINTER=[0,0.1,0.5] or POINTER=gold,glass.
SweepAxis read_sweep_axis(const std::string& text);

/// A name of the files that one command writes many of, with a place for what differs from file to file: "f/%04d.png"
/// has a number in it, "f/%v.exr" a value; %% stands for %.
struct NamePattern {
  std::string before, after;  ///< what stands around the place
  int digits = 0;             ///< least number of digits, filled up with zeros; of a number
};
/// Reads a name with one %d, as %04d or %d.
NamePattern read_numbered_name(const std::string& text);
/// The same with one %v.
NamePattern read_valued_name(const std::string& text);
std::string name_for(const NamePattern& pattern, int number);
/// Slashes in the value become _.
std::string name_for(const NamePattern& pattern, std::string value);

}  // namespace tyndall
