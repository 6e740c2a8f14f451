#pragma once
#include <string>

/// Names of files that one command writes many of: "f/%04d.png" has a number in it, "f/%v.exr" a value.
namespace tyndall {

/// A name with a place for what differs from file to file; %% stands for %.
struct NamePattern {
  std::string before, after;  ///< what stands around the place
  int digits = 0;             ///< least number of digits, filled up with zeros; of a number
};

/// Reads a name with one %d, as %04d or %d. Throws UsageError `found "X", expected Y`.
NamePattern read_numbered_name(const std::string& text);
/// The same with one %v.
NamePattern read_valued_name(const std::string& text);

std::string name_for(const NamePattern& pattern, int number);
/// Slashes in the value become _.
std::string name_for(const NamePattern& pattern, std::string value);

}  // namespace tyndall
