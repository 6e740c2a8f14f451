#pragma once
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall {

/// One JSON object as text, a line a member, in the order in which they are added. Made for figures that are written
/// when memory may be short: whatever runs out, std::bad_alloc comes out.
class JsonText {
 public:
  void add(std::string_view key, std::string_view text);
  void add(std::string_view key, const char* text) { add(key, std::string_view(text)); }
  void add(std::string_view key, const std::vector<std::string>& texts);
  /// Infinite and undefined numbers become null: JSON has no others.
  void add(std::string_view key, std::floating_point auto number) { add_number(key, static_cast<double>(number)); }
  void add(std::string_view key, std::integral auto number) { add_json(key, std::to_string(number)); }
  void add(std::string_view key, bool value) { add_json(key, value ? "true" : "false"); }
  /// null if there is no value.
  template <class T>
  void add(std::string_view key, const std::optional<T>& value) {
    value ? add(key, *value) : add_json(key, "null");
  }
  /// A value that is JSON already.
  void add_json(std::string_view key, std::string_view json);

  bool contains(std::string_view key) const;
  std::string text() const;

 private:
  void add_number(std::string_view key, double number);

  std::vector<std::string> keys_;
  std::string members_;
};

}  // namespace tyndall
