#pragma once
// The small values that scenes are built of.
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#define TYNDALL_API __attribute__((visibility("default")))
#define TYNDALL_HIDDEN __attribute__((visibility("hidden")))

namespace tyndall {
inline namespace v0 {

/// A point or direction in scene units, or linear red, green and blue.
struct Vec3 {
  double x = 0, y = 0, z = 0;
};

/// Linear red, green and blue, or the name of a texture of the scene.
struct Colour {
  Vec3 rgb{};
  std::string texture{};  ///< "": `rgb` counts
  Colour() = default;
  Colour(double red, double green, double blue) : rgb{red, green, blue} {}
  Colour(const Vec3& value) : rgb(value) {}
  Colour(std::string name) : texture(std::move(name)) {}
  Colour(const char* name) : texture(name) {}
};

/// A turn about the y axis in the books' sense: x' = cos x + sin z, z' = -sin x + cos z.
struct RotateY {
  double degrees = 0;
};
struct Translate {
  Vec3 offset{};  ///< scene units
};
/// Applied in the order of the list.
using Transform = std::vector<std::variant<RotateY, Translate>>;

namespace detail {

/// Writes the members of a thing as JSON, one after the other. Throws Error for a number that is not finite.
class TYNDALL_API Members {
 public:
  Members() = default;
  explicit Members(const std::string& type) { (*this)("type", type); }
  Members& operator()(const char* key, double value);
  Members& operator()(const char* key, const Vec3& value);
  Members& operator()(const char* key, const Colour& value);
  Members& operator()(const char* key, const std::string& value);  ///< left out where it is ""
  Members& operator()(const char* key, const Transform& value);    ///< left out where it is empty
  template <class T>
  Members& operator()(const char* key, const std::optional<T>& value) {
    return value ? (*this)(key, *value) : *this;
  }
  template <class... Things>
  Members& operator()(const char* key, const std::variant<Things...>& thing) {
    return put(key, std::visit([](const auto& one) { return one.json(); }, thing));
  }
  std::string text() const { return "{" + text_ + "}"; }

 private:
  Members& put(const char* key, const std::string& json);
  std::string text_;
};

/// A name as one step of a JSON pointer (RFC 6901).
TYNDALL_API std::string pointer_step(const std::string& name);

}  // namespace detail
}  // namespace v0
}  // namespace tyndall
