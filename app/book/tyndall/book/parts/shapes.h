#pragma once
#include "materials.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

/// The books' shapes, lists and moves. A world is never traced by these: `hit` is only ever called by the loop in
/// main() of editions 1 to 3, and answered by the probe (loop.h).
struct hittable;

namespace tyndall_book {
bool probe_hit(const hittable& world, hit_record& record);
}

struct hittable {
  virtual ~hittable() = default;
  virtual bool hit(const ray&, interval, hit_record& record) const { return tyndall_book::probe_hit(*this, record); }
  virtual bool hit(const ray&, double, double, hit_record& record) const {
    return tyndall_book::probe_hit(*this, record);
  }
  template <class... Arguments>  // as some readers spell it
  bool Hit(const ray& r, Arguments&&... rest) const {
    return hit(r, std::forward<Arguments>(rest)...);
  }
  virtual aabb bounding_box() const { return aabb(); }
  virtual bool bounding_box(double, double, aabb&) const { return true; }
  virtual double pdf_value(const point3&, const vec3&) const { return 0; }
  virtual vec3 random(const point3&) const { return vec3(1, 0, 0); }

  /// Adds the object to the scene.
  virtual void tyndall_write(tyndall_book::scene_text&, const tyndall_book::placing&) const { tyndall_refuse(); }

 protected:
  [[noreturn]] void tyndall_refuse() const {
    tyndall_book::refuse(tyndall_book::class_of(*this) + ": Tyndall has no such shape");
  }
  /// Refuses a class that the reader has derived from one of ours and given a `hit` of its own.
  template <class T>
  void tyndall_only() const {
    if (tyndall_book::of_class<T>(*this)) return;
    hit_record record;
    const ray away(vec3(1e9, 1e9, 1e9), vec3(1, 1, 1));
    tyndall_book::is_probing_answers() = true;
    tyndall_book::base_called() = nullptr;
    hit(away, interval(0.001, tyndall_book::endless), record);
    const bool first = tyndall_book::base_called() == this;
    tyndall_book::base_called() = nullptr;
    hit(away, 0.001, tyndall_book::endless, record);
    tyndall_book::is_probing_answers() = false;
    if (!first || tyndall_book::base_called() != this) tyndall_refuse();
  }
};
using hitable = hittable;

struct hittable_list : hittable {
  std::vector<shared_ptr<hittable>> objects;

  hittable_list() = default;
  hittable_list(tyndall_book::ref<hittable> object) { add(object); }
  hittable_list(hittable** list, int count) {
    for (int k = 0; k < count; ++k) add(list[k]);
  }
  void clear() { objects.clear(); }
  TYNDALL_BOOK_HITTABLE_LIST_MEMBERS
  void add(tyndall_book::ref<hittable> object) { objects.push_back(object); }
  void tyndall_write(tyndall_book::scene_text& out, const tyndall_book::placing& at) const override {
    tyndall_only<hittable_list>();
    for (const shared_ptr<hittable>& object : objects) {
      if (!object) tyndall_book::refuse("a list holds a null pointer in place of an object");
      object->tyndall_write(out, at);
    }
  }
};
using hitable_list = hittable_list;

/// Tyndall builds a tree of its own. Editions 1 to 3 draw an axis for each node, which the drawing here follows.
struct bvh_node : hittable_list {
  bvh_node(const hittable_list& list) : hittable_list(list) {}
  bvh_node(tyndall_book::ref<hittable> object) : hittable_list(object) {}
  bvh_node(const hittable_list& list, double, double) : hittable_list(list) { draw(list.objects.size()); }
  bvh_node(hittable** list, int count, double, double) : hittable_list(list, count) { draw(objects.size()); }
  bvh_node(const std::vector<shared_ptr<hittable>>& list, std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k) add(list[k]);
  }
  bvh_node(const std::vector<shared_ptr<hittable>>& list, std::size_t from, std::size_t to, double, double)
      : bvh_node(list, from, to) {
    draw(objects.size());
  }

 private:
  static void draw(std::size_t objects) {
    tyndall_book::skip_random(1);
    if (objects <= 2) return;
    draw(objects / 2);
    draw(objects - objects / 2);
  }
};

namespace tyndall_book {

/// ",\"material\":..." of a shape.
inline std::string material_of(const char* shape, const shared_ptr<material>& mat, scene_text& out, const placing& at) {
  if (at.boundary) return "";
  if (!mat)
    refuse(std::string(shape) +
           " without a material: this chapter shows normals or plain colours, and there is no light to trace");
  return ",\"material\":" + mat->tyndall_name(out);
}

}  // namespace tyndall_book

struct sphere : hittable {
  point3 center, center_end;
  double radius = 1;
  tyndall_book::ref<material> mat, mat_ptr;

  sphere() = default;
  sphere(const point3& middle, double r, tyndall_book::ref<material> m = nullptr) : sphere(middle, middle, r, m) {}
  sphere(const point3& from, const point3& to, double r, tyndall_book::ref<material> m)
      : center(from), center_end(to), radius(r), mat(m), mat_ptr(m) {}
  void tyndall_write(tyndall_book::scene_text& out, const tyndall_book::placing& at) const override {
    tyndall_only<sphere>();
    write_as_sphere(out, at);
  }

 protected:
  void write_as_sphere(tyndall_book::scene_text& out, const tyndall_book::placing& at) const {
    const bool moves = (center_end - center).length_squared() > 0;
    if (moves && at.boundary) tyndall_book::refuse("constant_medium in a moving sphere: Tyndall's media stand still");
    out.objects.push_back("{\"type\":\"sphere\",\"center\":" + tyndall_book::triple(center) +
                          (moves ? ",\"center_end\":" + tyndall_book::triple(center_end) : "") +
                          ",\"radius\":" + tyndall_book::number(radius) +
                          tyndall_book::material_of("sphere", mat, out, at) + tyndall_book::transform_of(at) + "}");
  }
};

/// Editions 1 to 3: places at two times of the reader's. The scene has those at the times 0 and 1.
struct moving_sphere : sphere {
  moving_sphere(const point3& from, const point3& to, double begin, double end, double r, tyndall_book::ref<material> m)
      : sphere(place(from, to, begin, end, 0), place(from, to, begin, end, 1), r, m) {}
  void tyndall_write(tyndall_book::scene_text& out, const tyndall_book::placing& at) const override {
    tyndall_only<moving_sphere>();
    write_as_sphere(out, at);
  }

 private:
  static point3 place(const point3& from, const point3& to, double begin, double end, double time) {
    return from + (end > begin ? (time - begin) / (end - begin) : 0) * (to - from);
  }
};

namespace tyndall_book {

/// What quad::is_interior() leaves of the plane corner + a u + b v.
struct outline {
  const char* type = nullptr;   ///< of the scene's object: "quad", "triangle" or "disk"; null: none of them
  double inner = 0, outer = 1;  ///< of a disk: radii of its hole and its rim
};

/// The number in (low, high] from which on holds() is what it is at high, in steps of 1e-12. It is not so at low.
inline double edge_of(const std::function<bool(double)>& holds, double low, double high) {
  const bool beyond = holds(high);
  for (double middle = 0.5 * (low + high); low < middle && middle < high; middle = 0.5 * (low + high))
    (holds(middle) == beyond ? high : low) = middle;
  return std::round(1e12 * high) / 1e12;
}

/// holds(a, b): whether the point belongs to the shape. It is asked at the points of a grid, none of them on an edge.
inline outline outline_of(const std::function<bool(double, double)>& holds) {
  const auto is = [&](const auto& expected) {
    constexpr int cells = 45;
    for (int i = 0; i < cells; ++i)
      for (int k = 0; k < cells; ++k) {
        const double a = 3.3 * (i + 0.5) / cells - 1.61, b = 3.3 * (k + 0.5) / cells - 1.61;
        if (holds(a, b) != expected(a, b)) return false;
      }
    return true;
  };
  if (is([](double a, double b) { return 0 < a && a < 1 && 0 < b && b < 1; })) return {"quad"};
  if (is([](double a, double b) { return 0 < a && 0 < b && a + b < 1; })) return {"triangle"};
  outline disk{"disk", 0, 0};
  const auto at = [&](double radius) { return holds(radius, 0); };
  double within = 0;
  while (within < 1.5 && !at(within)) within += 0.01;
  if (within >= 1.5 || at(100)) return {};
  if (within > 0) disk.inner = edge_of(at, within - 0.01, within);
  disk.outer = edge_of(at, within, 100);
  const auto on_ring = [&](double a, double b) {
    const double radius = std::sqrt(a * a + b * b);
    return disk.inner < radius && radius < disk.outer;
  };
  return is(on_ring) ? disk : outline{};
}

}  // namespace tyndall_book

struct quad : hittable {
  point3 Q;
  vec3 u, v;
  tyndall_book::ref<material> mat, mp;

  quad(const point3& corner, const vec3& side_u, const vec3& side_v, tyndall_book::ref<material> m)
      : quad(corner, side_u, side_v, m, 1) {}
  /// Whether the point corner + a u + b v belongs to the shape. Readers derive triangles and disks by another one.
  virtual bool is_interior(double a, double b, hit_record& record) const {
    record.u = a, record.v = b;
    return 0 <= a && a <= 1 && 0 <= b && b <= 1;
  }
  void tyndall_write(tyndall_book::scene_text& out, const tyndall_book::placing& at) const override {
    tyndall_only<quad>();
    write_as_quad(out, at);
  }

 protected:
  quad(const point3& corner, const vec3& side_u, const vec3& side_v, tyndall_book::ref<material> m, double side)
      : Q(corner), u(side_u), v(side_v), mat(m), mp(m), side_(side) {}

  void write_as_quad(tyndall_book::scene_text& out, const tyndall_book::placing& at) const {
    const tyndall_book::outline outline = tyndall_book::outline_of([this](double a, double b) {
      hit_record record{};
      return is_interior(a, b, record);
    });
    if (!outline.type) tyndall_refuse();
    if (at.boundary)
      tyndall_book::refuse(std::string("constant_medium in a ") + outline.type +
                           ": Tyndall's media fill a sphere or a box");
    if (outline.type == std::string("disk")) refuse_image();
    write_at(out, at, outline, Q, mat);
    if (out.one_sided_lights && dynamic_cast<const diffuse_light*>(mat.get())) write_back(out, at, outline);
  }

 private:
  /// The books lay an image on a disk by its half axes, Tyndall by radius and angle.
  void refuse_image() const {
    const auto* matt = dynamic_cast<const lambertian*>(mat.get());
    const auto* light = dynamic_cast<const diffuse_light*>(mat.get());
    const texture* tex = matt ? matt->tex.get() : light ? light->tex.get() : nullptr;
    if (dynamic_cast<const image_texture*>(tex))
      tyndall_book::refuse("a disk with an image_texture: Tyndall lays images on disks by radius and angle");
  }
  void write_at(tyndall_book::scene_text& out, const tyndall_book::placing& at, const tyndall_book::outline& outline,
                const point3& corner, const shared_ptr<material>& m) const {
    const bool disk = outline.type == std::string("disk");
    out.objects.push_back(std::string("{\"type\":\"") + outline.type + (disk ? "\",\"center\":" : "\",\"corner\":") +
                          tyndall_book::triple(corner) + ",\"u\":" + tyndall_book::triple(outline.outer * u) +
                          ",\"v\":" + tyndall_book::triple(outline.outer * v) +
                          (disk ? ",\"inner\":" + tyndall_book::number(outline.inner / outline.outer) : "") +
                          tyndall_book::material_of(outline.type, m, out, at) + tyndall_book::transform_of(at) + "}");
  }
  /// Black, close behind a light: Tyndall's lights shine on both sides, those of the third book on one.
  void write_back(tyndall_book::scene_text& out, const tyndall_book::placing& at,
                  const tyndall_book::outline& outline) const {
    static const shared_ptr<material> black = make_shared<lambertian>(color(0, 0, 0));
    const vec3 normal = (at.flipped ? -side_ : side_) * cross(u, v);
    const double distance = 1e-5 * std::sqrt(normal.length());
    write_at(out, at, outline, Q - distance * unit_vector(normal), black);
  }

  double side_;  ///< 1: the books' normal is along cross(u, v); -1: against it
};

// The shapes that the chapter on quads names as additions, by the names that readers give them. A program that defines
// a class of such a name in a file of its own keeps it.
#ifndef TYNDALL_BOOK_OWN_tri
struct tri : quad {
  using quad::quad;
  bool is_interior(double a, double b, hit_record&) const override { return 0 <= a && 0 <= b && a + b <= 1; }
};
#endif
#ifndef TYNDALL_BOOK_OWN_triangle
struct triangle : quad {
  using quad::quad;
  bool is_interior(double a, double b, hit_record&) const override { return 0 <= a && 0 <= b && a + b <= 1; }
};
#endif
#ifndef TYNDALL_BOOK_OWN_ellipse
struct ellipse : quad {
  using quad::quad;
  bool is_interior(double a, double b, hit_record&) const override { return a * a + b * b <= 1; }
};
#endif
#ifndef TYNDALL_BOOK_OWN_disk
struct disk : quad {
  using quad::quad;
  bool is_interior(double a, double b, hit_record&) const override { return a * a + b * b <= 1; }
};
#endif
#ifndef TYNDALL_BOOK_OWN_annulus
struct annulus : quad {
  double inner;

  annulus(const point3& center, const vec3& half_u, const vec3& half_v, double hole, tyndall_book::ref<material> m)
      : quad(center, half_u, half_v, m), inner(hole) {}
  bool is_interior(double a, double b, hit_record&) const override {
    const double radius = std::sqrt(a * a + b * b);
    return inner <= radius && radius <= 1;
  }
};
#endif

/// Editions 1 to 3: rectangles along the axes. The order of their sides is that of the books' uv coordinates.
struct xy_rect : quad {
  xy_rect(double x0, double x1, double y0, double y1, double k, tyndall_book::ref<material> m)
      : quad(point3(x0, y0, k), vec3(x1 - x0, 0, 0), vec3(0, y1 - y0, 0), m, 1) {}
  void tyndall_write(tyndall_book::scene_text& out, const tyndall_book::placing& at) const override {
    tyndall_only<xy_rect>();
    write_as_quad(out, at);
  }
};
struct xz_rect : quad {
  xz_rect(double x0, double x1, double z0, double z1, double k, tyndall_book::ref<material> m)
      : quad(point3(x0, k, z0), vec3(x1 - x0, 0, 0), vec3(0, 0, z1 - z0), m, -1) {}
  void tyndall_write(tyndall_book::scene_text& out, const tyndall_book::placing& at) const override {
    tyndall_only<xz_rect>();
    write_as_quad(out, at);
  }
};
struct yz_rect : quad {
  yz_rect(double y0, double y1, double z0, double z1, double k, tyndall_book::ref<material> m)
      : quad(point3(k, y0, z0), vec3(0, y1 - y0, 0), vec3(0, 0, z1 - z0), m, 1) {}
  void tyndall_write(tyndall_book::scene_text& out, const tyndall_book::placing& at) const override {
    tyndall_only<yz_rect>();
    write_as_quad(out, at);
  }
};

/// A class in editions 1 to 3, a function that returns a pointer in the fourth: box(...) turns into one where it is
/// used as one.
struct box : hittable {
  point3 low, high;
  tyndall_book::ref<material> mat;

  box(const point3& a, const point3& b, tyndall_book::ref<material> m)
      : low(std::fmin(a[0], b[0]), std::fmin(a[1], b[1]), std::fmin(a[2], b[2])),
        high(std::fmax(a[0], b[0]), std::fmax(a[1], b[1]), std::fmax(a[2], b[2])),
        mat(m) {}
  operator shared_ptr<hittable>() const { return make_shared<box>(*this); }
  operator shared_ptr<hittable_list>() const { return make_shared<hittable_list>(make_shared<box>(*this)); }
  void tyndall_write(tyndall_book::scene_text& out, const tyndall_book::placing& at) const override {
    tyndall_only<box>();
    out.objects.push_back("{\"type\":\"box\",\"min\":" + tyndall_book::triple(low) +
                          ",\"max\":" + tyndall_book::triple(high) + tyndall_book::material_of("box", mat, out, at) +
                          tyndall_book::transform_of(at) + "}");
  }
};

struct translate : hittable {
  tyndall_book::ref<hittable> object;
  vec3 offset;

  translate(tyndall_book::ref<hittable> what, const vec3& shift) : object(what), offset(shift) {}
  void tyndall_write(tyndall_book::scene_text& out, const tyndall_book::placing& at) const override {
    tyndall_only<translate>();
    write_moved(*this, object, out, at, "{\"translate\":" + tyndall_book::triple(offset) + "}");
  }

  /// Writes an object below one more move, which the moves around it follow.
  static void write_moved(const hittable& mover, const shared_ptr<hittable>& object, tyndall_book::scene_text& out,
                          const tyndall_book::placing& at, const std::string& move) {
    if (!object) tyndall_book::refuse(tyndall_book::class_of(mover) + " of a null pointer in place of an object");
    tyndall_book::placing inside = at;
    if (!move.empty()) inside.moves.insert(inside.moves.begin(), move);
    object->tyndall_write(out, inside);
  }
};

struct rotate_y : hittable {
  tyndall_book::ref<hittable> object;
  double degrees;

  rotate_y(tyndall_book::ref<hittable> what, double angle) : object(what), degrees(angle) {}
  void tyndall_write(tyndall_book::scene_text& out, const tyndall_book::placing& at) const override {
    tyndall_only<rotate_y>();
    translate::write_moved(*this, object, out, at, "{\"rotate_y\":" + tyndall_book::number(degrees) + "}");
  }
};

struct flip_face : hittable {
  tyndall_book::ref<hittable> object;

  flip_face(tyndall_book::ref<hittable> what) : object(what) {}
  void tyndall_write(tyndall_book::scene_text& out, const tyndall_book::placing& at) const override {
    tyndall_only<flip_face>();
    tyndall_book::placing inside = at;
    inside.flipped = !inside.flipped;
    translate::write_moved(*this, object, out, inside, "");
  }
};
using flip_normals = flip_face;

struct constant_medium : hittable {
  tyndall_book::ref<hittable> boundary;
  double density;
  tyndall_book::ref<texture> tex;

  constant_medium(tyndall_book::ref<hittable> fills, double d, const vec3& colour)
      : constant_medium(fills, d, make_shared<solid_color>(colour)) {}
  constant_medium(tyndall_book::ref<hittable> fills, double d, tyndall_book::ref<texture> colour)
      : boundary(fills), density(d), tex(colour) {}
  void tyndall_write(tyndall_book::scene_text& out, const tyndall_book::placing& at) const override {
    tyndall_only<constant_medium>();
    if (at.boundary)
      tyndall_book::refuse("constant_medium in a constant_medium: Tyndall's media fill a sphere or a box");
    if (!boundary || !tex) tyndall_book::refuse("constant_medium without a boundary or a colour");
    tyndall_book::placing inside = at;
    inside.boundary = true;
    std::vector<std::string> fills;
    std::swap(fills, out.objects);
    boundary->tyndall_write(out, inside);
    std::swap(fills, out.objects);
    if (fills.size() != 1)
      tyndall_book::refuse("constant_medium in a list of " + std::to_string(fills.size()) +
                           " objects: Tyndall's media fill one sphere or box");
    out.objects.push_back("{\"type\":\"medium\",\"boundary\":" + fills[0] + ",\"density\":" +
                          tyndall_book::number(density) + ",\"albedo\":" + tex->tyndall_text(out) + "}");
  }
};
