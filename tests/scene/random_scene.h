#pragma once
#include "core/scene/check.h"

#include <cmath>
#include <random>

/// Valid scenes that use every value of the format, driven by the same lists as reading and writing.
namespace tyndall {

class SceneGenerator {
 public:
  explicit SceneGenerator(unsigned seed) : random_(seed) {}

  Scene scene() {
    Scene out;
    out.name = name();
    out.width = 1 + below(65536);
    out.height = 1 + below(65536);
    out.camera = camera();
    out.background = background();
    fill(out.render);
    fill(out.display);
    for (int i = below(5); i > 0; --i) out.textures.push_back(texture(out.textures.size()));
    textures_ = static_cast<int>(out.textures.size());
    for (int i = 1 + below(5); i > 0; --i) out.materials.push_back(material(out.materials.size()));
    materials_ = static_cast<int>(out.materials.size());
    out.objects = objects(3);
    return out;
  }

 private:
  std::mt19937 random_;
  int textures_ = 0, materials_ = 0;

  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  bool chance() { return below(2) == 0; }

  /// A number of any magnitude and number of digits within the range.
  double number(const Valid& valid) {
    while (true) {
      const double unit = std::uniform_real_distribution(-1.0, 1.0)(random_);
      double v = unit * std::pow(10.0, below(13) - 6);
      if (std::isfinite(valid.low) && std::isfinite(valid.high))
        v = valid.low + (valid.high - valid.low) * std::abs(unit);
      if (below(4) == 0) v = std::round(v);
      if (valid.contains(v) && valid.contains(static_cast<double>(static_cast<float>(v)))) return v;
    }
  }

  void fill(const Valid& valid, double& out) { out = number(valid); }
  void fill(const Valid& valid, int& out) { out = static_cast<int>(valid.low) + below(5000); }
  void fill(const Valid&, std::uint32_t& out) { out = static_cast<std::uint32_t>(random_()); }
  void fill(const Valid&, bool& out) { out = chance(); }
  template <NamedEnum E>
  void fill(const Valid&, E& out) {
    out = static_cast<E>(below(count_of<E>()));
  }
  void fill(const Valid& valid, Vec3d& out) { out = {number(valid), number(valid), number(valid)}; }
  template <class T>
  void fill(const Valid& valid, std::optional<T>& out) {
    if (chance()) fill(valid, out.emplace());
  }
  template <class Owner>
  void fill(Owner& out) {
    const auto one = [&](const auto& field) {
      if (field.required || chance()) fill(field.valid, out.*field.value);
    };
    std::apply([&](const auto&... field) { (one(field), ...); }, fields_of<Owner>());
  }

  /// A text with letters that JSON, pointers and terminals treat specially.
  std::string name() {
    constexpr const char* letters[] = {"a",  "B",    "7", " ",  "/",    "~", "\"", "\\",
                                       "\n", "\x01", "ä", "世", "🙂", "'", "{",  "//"};
    std::string out;
    for (int i = below(8); i > 0; --i) out += letters[below(16)];
    return out;
  }
  std::string unique_name(std::size_t i) { return name() + std::to_string(i); }

  Camera camera() {
    Camera out;
    fill(out);
    out.vup = {0, 1, 0};
    out.look_at = out.look_from + Vec3d{1 + std::abs(out.look_from.x), 0.1, 0.2};
    out.shutter_open = number(any_number());
    out.shutter_close = chance() ? out.shutter_open : out.shutter_open + number(at_least(0));
    return out;
  }

  /// One of the first `count` kinds of a list, with all of its values.
  template <class... Kinds>
  void fill_kind(std::variant<Kinds...>& out, int count) {
    int left = below(count);
    const auto take = [&]<class Kind>(const Kind*) {
      if constexpr (requires { fields(static_cast<const Kind*>(nullptr)); })
        if (left-- == 0) fill(out.template emplace<Kind>());
    };
    (take(static_cast<const Kinds*>(nullptr)), ...);
  }

  Background background() {
    Background out;
    if (chance())
      fill(at_least(0), out.emplace<Vec3d>());
    else
      fill_kind(out, 2);  // without pictures of the sky
    return out;
  }

  Texture texture(std::size_t i) {
    Texture out{unique_name(i), {}};
    fill_kind(out.kind, 3);  // without pictures
    return out;
  }

  ColourOrTexture colour(const Valid& valid) {
    if (textures_ > 0 && chance()) return TextureIndex{below(textures_)};
    Vec3d out;
    fill(valid, out);
    return out;
  }

  Material material(std::size_t i) {
    Material out;
    out.name = unique_name(i);
    fill_kind(out.kind, 4);
    if (!std::holds_alternative<Dielectric<>>(out.kind))
      out.colour = colour(std::holds_alternative<Light<>>(out.kind) ? at_least(0) : between(0, 1));
    return out;
  }

  Transform transform() {
    Transform out;
    for (int i = below(3); i > 0; --i) fill_kind(out.emplace_back(RotateY()), 2);
    return out;
  }

  Box<> box() {
    Box<> out;
    fill(out);
    out.max = {out.min.x + number(above(0.1)), out.min.y + number(above(0.1)), out.min.z + number(above(0.1))};
    return out;
  }
  Quad<> quad() {
    Quad<> out;
    fill(out);
    if (dot(out.u, out.u) == 0) out.u.x = 1;
    out.v = {out.u.y + 1, -out.u.x, out.u.z - 1};
    return out;
  }

  void fill_flat(Solid3d& solid) {
    const Quad<> frame = quad();
    const int which = below(3);
    if (which == 0) solid.shape = frame;
    if (which == 1) solid.shape = Triangle<>{frame.corner, frame.u, frame.v};
    if (which == 2) solid.shape = Disk<>{frame.corner, frame.u, frame.v, chance() ? 0.625 : 0};
  }

  Object object(int depth) {
    Object out;
    if (chance()) out.name = name();
    out.transform = transform();
    const int kind = below(depth > 0 ? 5 : 4);
    if (kind == 4) {
      out.kind = Group{objects(depth - 1)};
    } else if (kind == 3) {
      Volume fog;
      Sphere<> ball{{1, 2, 3}, number(above(0.1)), std::nullopt};
      if (chance())
        fog.boundary = ball;
      else
        fog.boundary = box();
      fog.boundary_transform = transform();
      fill(fog.medium);
      fog.albedo = colour(between(0, 1));
      out.kind = fog;
    } else {
      Solid3d solid;
      if (kind == 0) fill(solid.shape.emplace<Sphere<>>());
      if (kind == 1) fill_flat(solid);
      if (kind == 2) solid.shape = box();
      solid.material = below(materials_);
      out.kind = solid;
    }
    return out;
  }

  std::vector<Object> objects(int depth) {
    std::vector<Object> out;
    for (int i = below(6); i > 0; --i) out.push_back(object(depth));
    return out;
  }
};

inline Scene random_scene(unsigned seed) { return SceneGenerator(seed).scene(); }

}  // namespace tyndall
