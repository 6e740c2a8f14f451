#pragma once
#include "hits.h"

/// The reader's world as objects of a scene. A class counts as one of the books' by its members and by what its hit()
/// does, whatever its name is: it is shot at, and the answers are compared.
namespace tyndall_book {

/// How an object is placed by what encloses it.
struct placing {
  std::string moves;      ///< JSON, innermost first, with commas between them
  bool boundary = false;  ///< of a medium: it is written without a material
  bool flipped = false;   ///< its normals point the other way
};

/// An object of the scene: where it lies for the object that encloses it; corner and sides if it is a quad.
struct piece {
  vector centre;
  double size = 1;
  std::string material, moves;
  bool is_quad = false, can_be_filled = false;
  vector q, u, v;
};

template <class N>
class world_text {
 public:
  using shape = typename N::shape;
  using rays = ray_traits<typename N::ray>;

  explicit world_text(scene_text& out) : out_(out) {}
  void add(const shape* object, const placing& at) {
    if (!object) throw not_taken{"a null pointer in place of an object"};
    if (++depth_ > 200) refuse(*object, "holds itself");
    N::with_class(*object, [&](const auto& its) { add_class(its, at); });
    --depth_;
  }

 private:
  template <class T>
  void add_class(const T& o, const placing& at) {
    reason_ = "no such shape in Tyndall";
    if (sphere(o, at) || flat(o, at) || medium(o, at) || list(o, at) || pair(o, at) || moved(o, at)) return;
    refuse(static_cast<const shape&>(o), reason_);
  }

  // Spheres ---------------------------------------------------------------------------------------------------------

  template <class T>
  static bool read_centre(const T& o, motion& m) {
    if constexpr (TYNDALL_HAS(const T, o.center0, o.center1, o.time0, o.time1)) {
      const vector a = to_vector(o.center0), b = to_vector(o.center1);
      const double span = double(o.time1) - double(o.time0), rate = span > 0 ? 1 / span : 0;
      m = {a + (-double(o.time0) * rate) * (b - a), a + ((1 - double(o.time0)) * rate) * (b - a)};
      return true;
    } else if constexpr (TYNDALL_HAS(const T, o.center1, o.center_vec)) {
      m.begin = m.end = to_vector(o.center1);
      if (o.is_moving) m.end = m.begin + to_vector(o.center_vec);
      return true;
    } else {
      decltype(auto) c =
          TYNDALL_ANY(o, center, cen, m_center, centre, center_, _center, mCenter, Center, position, pos, origin, c);
      using C = std::decay_t<decltype(c)>;
      if constexpr (std::is_same<C, typename N::ray>::value)
        return m.begin = rays::origin(c), m.end = m.begin + rays::direction(c), true;
      else if constexpr (is_vector<C>)
        return m.begin = m.end = to_vector(c), true;
      else
        return false;
    }
  }
  template <class T>
  bool sphere(const T& o, const placing& at) {
    decltype(auto) member = TYNDALL_ANY_AS(double, o, radius, m_radius, r, rad, radius_, _radius, mRadius, Radius);
    if constexpr (is_absent<decltype(member)>) {
      return false;
    } else {
      motion centre;
      return read_centre(o, centre) && take_sphere(o, centre, member, at);
    }
  }
  bool take_sphere(const shape& o, const motion& centre, double radius, const placing& at) {
    if (radius == 0) return true;
    const typename N::material* material = nullptr;
    if (!is_sphere<N>(o, centre, radius, random_, material))
      return reason_ = "its hit() is not that of the books' sphere", false;
    const bool moves = length(centre.end - centre.begin) > 0;
    if (moves && at.boundary) refuse(o, "fog in a moving sphere");
    push("{\"type\":\"sphere\",\"center\":" + triple(centre.begin) +
             (moves ? ",\"center_end\":" + triple(centre.end) : "") + ",\"radius\":" + number(radius),
         o, material, at, {centre.at(0.5), std::fabs(radius), "", "", false, true, {}, {}, {}});
    return true;
  }
  // Flat shapes -----------------------------------------------------------------------------------------------------

  template <class T>
  bool flat(const T& o, const placing& at) {
    if constexpr (TYNDALL_HAS(const T, double(o.x0), double(o.x1), double(o.y0), double(o.k)))
      if (is_flat(o, {o.x0, o.y0, o.k}, {o.x1 - o.x0, 0, 0}, {0, o.y1 - o.y0, 0}, at)) return true;
    if constexpr (TYNDALL_HAS(const T, double(o.x0), double(o.x1), double(o.z0), double(o.k)))
      if (is_flat(o, {o.x0, o.k, o.z0}, {o.x1 - o.x0, 0, 0}, {0, 0, o.z1 - o.z0}, at)) return true;
    if constexpr (TYNDALL_HAS(const T, double(o.y0), double(o.y1), double(o.z0), double(o.k)))
      if (is_flat(o, {o.k, o.y0, o.z0}, {0, o.y1 - o.y0, 0}, {0, 0, o.z1 - o.z0}, at)) return true;
    decltype(auto) q = TYNDALL_ANY(o, Q, q, corner, m_Q, m_q, _Q, Q_, origin, center);
    decltype(auto) u = TYNDALL_ANY(o, u, U, m_u, _u, u_);
    decltype(auto) v = TYNDALL_ANY(o, v, V, m_v, _v, v_);
    if constexpr (is_vector<decltype(q)> && is_vector<decltype(u)> && is_vector<decltype(v)>)
      if (is_flat(o, to_vector(q), to_vector(u), to_vector(v), at)) return true;
    const auto three = [&](const auto& a, const auto& b, const auto& c) {
      const vector first = to_vector(a);
      return is_flat(o, first, to_vector(b) - first, to_vector(c) - first, at);
    };
#define TYNDALL_CORNERS(A, B, C)                                                      \
  if constexpr (TYNDALL_HAS(const T, to_vector(o.A), to_vector(o.B), to_vector(o.C))) \
    if constexpr (is_vector<decltype(o.A)> && is_vector<decltype(o.B)>)               \
      if (three(o.A, o.B, o.C)) return true;
    TYNDALL_CORNERS(v0, v1, v2)
    TYNDALL_CORNERS(a, b, c)
    TYNDALL_CORNERS(p0, p1, p2)
    TYNDALL_CORNERS(p1, p2, p3)
    TYNDALL_CORNERS(v1, v2, v3)
    TYNDALL_CORNERS(A, B, C)
    TYNDALL_CORNERS(vertex0, vertex1, vertex2)
    TYNDALL_CORNERS(vertices[0], vertices[1], vertices[2])
#undef TYNDALL_CORNERS
    return false;
  }
  bool is_flat(const shape& o, vector q, vector u, vector v, const placing& at) {
    const vector n = cross(u, v);
    if (!(length(n) > 0)) return false;
    const vector away = (length(u) + length(v)) * normalized(n);
    const auto holds = [&](double a, double b) {
      const answer<N> its = shoot<N>(o, q + a * u + b * v + away, -1 * away);
      return its.found && std::fabs(its.t - 1) < 10 * rays::precision() * std::fmax(1, largest(q) / length(away));
    };
    const outline found = outline_of(holds);
    if (!found.type) return reason_ = "its hit() is not that of a quad, a triangle, a disk or a ring", false;
    const bool disk = found.type[0] == 'd';
    const double middle = disk ? 0.5 * (found.inner + found.outer) : 0.3;
    const vector inside = q + middle * u + (disk ? 0 : 0.3) * v;
    const answer<N> front = shoot<N>(o, inside + away, -1 * away), back = shoot<N>(o, inside - away, away);
    const answer<N> behind = shoot<N>(o, inside + away, -1 * away, 0, 1.1),
                    before = shoot<N>(o, inside + away, -1 * away, 0, 0.001, 0.9);
    if (behind.found || before.found || !back.found)
      return reason_ = "its hit() does not keep the interval of t", false;
    if (std::fabs(std::fabs(dot(front.normal, normalized(n))) - 1) > 0.02)
      return reason_ = "its normals are not those of the books", false;
    const double side = front.front ? 1 : -1;
    push(std::string("{\"type\":\"") + found.type + (disk ? "\",\"center\":" : "\",\"corner\":") + triple(q) +
             ",\"u\":" + triple(found.outer * u) + ",\"v\":" + triple(found.outer * v) +
             (disk ? ",\"inner\":" + number(found.inner / found.outer) : ""),
         o, front.material, at,
         {inside, found.outer * std::fmin(length(u), length(v)), "", "", found.type[0] == 'q', false, q, u, v});
    if (!at.boundary && shines_on_one_side<N>(front.material))
      add_back(found, q, u, v, (at.flipped ? -side : side) * n, at);
    return true;
  }
  /// Black, close behind a light: Tyndall's lights shine on both sides, those of the third book on one.
  void add_back(const outline& found, vector q, vector u, vector v, vector normal, const placing& at) {
    const double distance = 1e-5 * std::sqrt(length(normal));
    const bool disk = found.type[0] == 'd';
    static const int black = 0;
    const std::string name =
        out_.name_of(black, out_.materials, [] { return "{\"type\":\"lambertian\",\"albedo\":[0,0,0]}"; });
    out_.objects.push_back(std::string("{\"type\":\"") + found.type + (disk ? "\",\"center\":" : "\",\"corner\":") +
                           triple(q - distance * normalized(normal)) + ",\"u\":" + triple(found.outer * u) + ",\"v\":" +
                           triple(found.outer * v) + (disk ? ",\"inner\":" + number(found.inner / found.outer) : "") +
                           ",\"material\":" + name + moves_of(at.moves) + "}");
    pieces_.push_back({});
  }

  // Lists, trees, moves ---------------------------------------------------------------------------------------------

  template <class T>
  bool list(const T& o, const placing& at) {
    decltype(auto) member =
        pick(o, TYNDALL_GET(o.objects), TYNDALL_GET(o.sides), TYNDALL_GET(o.m_objects), TYNDALL_GET(o.hittables),
             TYNDALL_GET(o.list), TYNDALL_GET(o._objects), TYNDALL_GET(o.objects_), TYNDALL_GET(o.triangles),
             TYNDALL_GET(o.shapes), TYNDALL_GET(o.children), TYNDALL_GET(o.faces), TYNDALL_GET(o.primitives),
             TYNDALL_GET(o.objs), TYNDALL_GET(o.world), TYNDALL_GET(o.m_list), TYNDALL_GET(o.m_hittables));
    using M = std::decay_t<decltype(member)>;
    std::vector<const shape*> parts;
    if constexpr (TYNDALL_HAS(const T, o.list[0], int(o.list_size))) {
      for (int k = 0; k < int(o.list_size); ++k) parts.push_back(pointer(o.list[k]));
    } else if constexpr (std::is_base_of<shape, M>::value) {
      parts.push_back(&member);
    } else if constexpr (TYNDALL_HAS(const M, *o.begin(), o.end())) {
      using part = decltype(*std::declval<const M&>().begin());
      if constexpr (leads_to<shape, part>())
        for (auto& one : member) parts.push_back(pointer(one));
      else
        return false;
    } else {
      return false;
    }
    return nearest_of(o, parts, at);
  }
  template <class T>
  bool pair(const T& o, const placing& at) {
    if constexpr (TYNDALL_HAS(const T, pointer(o.left), pointer(o.right))) {
      if constexpr (leads_to<shape, decltype((o.left))>()) {
        std::vector<const shape*> parts;
        for (const shape* one :
             {static_cast<const shape*>(pointer(o.left)), static_cast<const shape*>(pointer(o.right))})
          if (one && (parts.empty() || parts[0] != one)) parts.push_back(one);
        return nearest_of(o, parts, at);
      }
    }
    return false;
  }
  /// Takes the parts over; false: hit() does not answer with the nearest of them.
  bool nearest_of(const shape& o, const std::vector<const shape*>& parts, const placing& at) {
    const std::size_t begin = out_.objects.size();
    const bool had_media = std::exchange(has_media_, false);
    for (const shape* part : parts) add(part, at);
    const bool random = has_media_;
    has_media_ = has_media_ || had_media;
    join_box(begin);
    for (int k = 0; !random && k < 40; ++k) {
      const line seed = aimed(begin);
      double nearest = endless;
      for (const shape* part : parts) {
        const answer<N> its = shoot<N>(*part, seed.from, seed.to, 0.5);
        if (its.found) nearest = std::fmin(nearest, its.t);
      }
      const answer<N> its = shoot<N>(o, seed.from, seed.to, 0.5);
      if (its.found != (nearest < endless) || (its.found && !near(its.t, nearest, 0.01)))
        return reason_ = "its hit() is not that of the nearest of its parts", drop(begin), false;
    }
    return true;
  }
  template <class T>
  bool moved(const T& o, const placing& at) {
    decltype(auto) member =
        TYNDALL_ANY(o, object, ptr, m_object, obj, p, list_ptr, hittable, object_, root, shape, child, inner);
    if constexpr (leads_to<shape, decltype((member))>()) {
      const shape* inner = pointer(member);
      decltype(auto) offset = TYNDALL_ANY(o, offset, displacement, m_offset, offset_);
      decltype(auto) sine = TYNDALL_ANY_AS(double, o, sin_theta, sinTheta, m_sin_theta);
      decltype(auto) cosine = TYNDALL_ANY_AS(double, o, cos_theta, cosTheta, m_cos_theta);
      if constexpr (is_vector<decltype(offset)>) {
        return is_moved(o, inner, at, {to_vector(offset)});
      } else if constexpr (!is_absent<decltype(sine)> && !is_absent<decltype(cosine)>) {
        return is_moved(o, inner, at, {{}, sine, cosine});
      } else {
        return is_moved(o, inner, at, {});
      }
    }
    return false;
  }
  bool is_moved(const shape& o, const shape* inner, const placing& at, const move& its) {
    const std::size_t begin = out_.objects.size();
    const std::string text = its.text();
    placing inside = at;
    if (!text.empty()) inside.moves = text + (at.moves.empty() ? "" : "," + at.moves);
    const bool had_media = std::exchange(has_media_, false);
    if (!inner) throw not_taken{"a null pointer in place of an object"};
    inside.flipped = at.flipped != flips(o, *inner, its);
    add(inner, inside);
    const bool random = has_media_;
    has_media_ = has_media_ || had_media;
    for (std::size_t k = begin; k < pieces_.size(); ++k) pieces_[k].centre = its.out(pieces_[k].centre);
    for (int k = 0; !random && k < 60; ++k) {
      const line seed = aimed(begin), within = its.in(seed);
      const answer<N> outer = shoot<N>(o, seed.from, seed.to, 0.5), own = shoot<N>(*inner, within.from, within.to, 0.5);
      if (outer.found != own.found || (own.found && !near(outer.t, own.t, 0.01)))
        return reason_ = "its hit() is not that of what is in it", drop(begin), false;
    }
    return true;
  }
  /// Whether an object turns the sides of what is in it, as the third edition's flip_face does.
  bool flips(const shape& o, const shape& inner, const move& its) {
    for (int k = 0; k < 2000; ++k) {
      const vector from = random_.between(1, 3000) * random_.on_sphere();
      const line seed{from, random_.between(0, 500) * random_.on_sphere() - from}, within = its.in(seed);
      const answer<N> outer = shoot<N>(o, seed.from, seed.to), own = shoot<N>(inner, within.from, within.to);
      if (outer.found && own.found && near(outer.t, own.t, 1e-3)) return outer.front != own.front;
    }
    return false;
  }

  // Fog -------------------------------------------------------------------------------------------------------------

  template <class T>
  bool medium(const T& o, const placing& at) {
    decltype(auto) member = TYNDALL_ANY(o, boundary, m_boundary, boundary_);
    decltype(auto) phase = TYNDALL_ANY(o, phase_function, m_phase_function, phaseFunction, phase);
    decltype(auto) free =
        pick(o, TYNDALL_GET(-1 / double(o.neg_inv_density)), TYNDALL_GET(-1 / double(o.negInvDensity)),
             TYNDALL_GET(-1 / double(o.m_neg_inv_density)), TYNDALL_GET(double(o.density)));
    if constexpr (leads_to<shape, decltype((member))>() && leads_to<typename N::material, decltype((phase))>() &&
                  !is_absent<decltype(free)>) {
      take_medium(o, *pointer(member), *pointer(phase), free, at);
      return true;
    }
    return false;
  }
  void take_medium(const shape& o, const shape& boundary, const typename N::material& phase, double extinction,
                   const placing& at) {
    if (at.boundary) refuse(o, "fog within fog");
    placing inside = at;
    inside.boundary = true;
    const std::size_t begin = out_.objects.size();
    add(&boundary, inside);
    if (out_.objects.size() != begin + 1 || !pieces_.back().can_be_filled)
      refuse(o, "Tyndall's fog fills one sphere or one box");
    const std::string text = out_.objects.back();
    const line seed = aimed(begin);
    const piece filled = pieces_.back();
    drop(begin);
    check_passing(o, boundary, extinction, seed);
    out_.objects.push_back("{\"type\":\"medium\",\"boundary\":" + text + ",\"density\":" + number(extinction) +
                           ",\"albedo\":" + medium_colour<N>(out_, phase) + "}");
    pieces_.push_back({filled.centre, filled.size, "", "", false, false, {}, {}, {}});
    has_media_ = true;
  }
  /// Counts how often rays pass the fog.
  void check_passing(const shape& o, const shape& boundary, double extinction, const line& seed) {
    const vector to = normalized(seed.to);
    const answer<N> in = shoot<N>(boundary, seed.from, to, 0, -1e9),
                    out = shoot<N>(boundary, seed.from, to, 0, in.t + 1e-4);
    if (!in.found || !out.found) return;
    constexpr int rounds = 4000;
    int passed = 0;
    for (int k = 0; k < rounds; ++k) passed += shoot<N>(o, seed.from, to).found ? 0 : 1;
    const double expected = rounds * std::exp(-extinction * (out.t - in.t));
    if (std::fabs(passed - expected) > 5 * std::sqrt(expected + 1) + 3)
      refuse(o, "it is denser or thinner than the books' fog");
  }

  // Text ------------------------------------------------------------------------------------------------------------

  static std::string moves_of(const std::string& moves) {
    return moves.empty() ? "" : ",\"transform\":[" + moves + "]";
  }
  void push(const std::string& body, const shape& o, const typename N::material* material, const placing& at,
            piece its) {
    if (!at.boundary && !material) refuse(o, "it has no material: there is no light to trace in this chapter");
    its.material = at.boundary ? "" : ",\"material\":" + material_name<N>(out_, *material);
    its.moves = at.moves;
    out_.objects.push_back(body + its.material + moves_of(at.moves) + "}");
    pieces_.push_back(its);
  }
  void drop(std::size_t begin) { out_.objects.resize(begin), pieces_.resize(begin); }
  /// A ray near one of the objects from that one on, if there are any.
  line aimed(std::size_t begin) {
    const std::size_t count = pieces_.size() - begin;
    const piece one =
        count > 0 ? pieces_[begin + static_cast<std::size_t>(random_.next() * static_cast<double>(count))] : piece{};
    const vector at = one.centre + (random_.between(0, 0.7) * one.size) * random_.on_sphere();
    const vector from = one.centre + (random_.between(1.5, 6) * one.size) * random_.on_sphere();
    return {from, at - from};
  }

  /// Six quads that enclose a box are one, as the books' box() makes them.
  void join_box(std::size_t begin) {
    if (out_.objects.size() != begin + 6) return;
    vector low{endless, endless, endless}, high{-endless, -endless, -endless};
    const auto each = [](vector& a, vector b, auto f) { a = {f(a.x, b.x), f(a.y, b.y), f(a.z, b.z)}; };
    for (std::size_t k = begin; k < begin + 6; ++k)
      for (double s : {0.0, 1.0}) {
        const vector corner = pieces_[k].q + s * pieces_[k].u + s * pieces_[k].v;
        each(low, corner, [](double a, double b) { return std::fmin(a, b); });
        each(high, corner, [](double a, double b) { return std::fmax(a, b); });
      }
    int sides = 0;
    for (std::size_t k = begin; k < begin + 6; ++k) {
      const piece& one = pieces_[k];
      if (!one.is_quad || one.material != pieces_[begin].material) return;
      const vector a = one.q, b = one.q + one.u + one.v, size = high - low;
      const double at[3] = {a.x, a.y, a.z}, to[3] = {b.x, b.y, b.z}, lows[3] = {low.x, low.y, low.z},
                   sizes[3] = {size.x, size.y, size.z};
      int flat = -1, whole = 0;
      for (int axis = 0; axis < 3; ++axis) {
        if (near(at[axis], to[axis], 1e-9)) flat = axis;
        if (near(std::fabs(to[axis] - at[axis]), sizes[axis], rays::precision())) ++whole;
      }
      if (flat < 0 || whole != 2) return;
      sides |= 1 << (2 * flat + (near(at[flat], lows[flat], rays::precision()) ? 0 : 1));
    }
    if (sides != 63) return;
    const piece first = pieces_[begin];
    drop(begin);
    out_.objects.push_back("{\"type\":\"box\",\"min\":" + triple(low) + ",\"max\":" + triple(high) + first.material +
                           moves_of(first.moves) + "}");
    pieces_.push_back(
        {0.5 * (low + high), 0.5 * length(high - low), first.material, first.moves, false, true, {}, {}, {}});
  }

  scene_text& out_;
  std::vector<piece> pieces_;  ///< one for each object of the scene
  random_numbers random_;
  std::string reason_;
  int depth_ = 0;
  bool has_media_ = false;
};

}  // namespace tyndall_book
