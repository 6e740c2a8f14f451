#pragma once
#include "hooks.h"

/// What the reader's functions answer when his world stands, for the library, which judges it. N names his classes.
namespace tyndall_book {

/// Tells an object's members.
template <class N>
class teller {
 public:
  template <class O>
  static void tell(const O& object, description& to) {
    teller one{to};
    members<O>::each(object, [&](const char* name, char, const auto& member) { one.add(name, member); });
    for (int k = 0; one.array_ && k < one.count_; ++k) one.add("array", one.array_[k]);
  }

 private:
  using shape = typename N::shape;
  using material = typename N::material;
  using texture = typename N::texture;
  explicit teller(description& to) : to_(to) {}
  void add_numbers(char kind, const char* name, std::initializer_list<double> numbers) {
    to_.take_numbers(kind, name, numbers.begin(), static_cast<int>(numbers.size()));
  }
  template <class M>
  void add(const char* name, const M& member) {
    if constexpr (std::is_arithmetic<M>::value) {
      if (std::is_integral<M>::value && !std::is_same<M, bool>::value) count_ = static_cast<int>(member);
      add_numbers('n', name, {double(member)});
    } else if constexpr (std::is_same<M, typename N::ray>::value) {
      const ray_parts a = ray_traits<M>::parts(&member);
      add_numbers('r', name, {a.from.x, a.from.y, a.from.z, a.to.x, a.to.y, a.to.z});
    } else if constexpr (leads_to<shape, const M>()) {
      to_.take_object('s', name, static_cast<const shape*>(pointer(member)));
    } else if constexpr (leads_to<material, const M>()) {
      to_.take_object('m', name, static_cast<const material*>(pointer(member)));
    } else if constexpr (leads_to<texture, const M>()) {
      to_.take_object('t', name, static_cast<const texture*>(pointer(member)));
    } else if constexpr (is_vector<const M>) {
      const vector a = to_vector(member);
      add_numbers('v', name, {a.x, a.y, a.z});
    } else if constexpr (TYNDALL_HAS(const M, *std::begin(o), std::end(o))) {
      add_all(name, member);
    } else if constexpr (std::is_convertible<M, const shape* const*>::value) {
      array_ = member;  // of the first edition, whose length is another member
    }
  }
  template <class M>
  void add_all(const char* name, const M& list) {
    using part = decltype(*std::begin(list));
    int left = is_vector<part> ? 4 : leads_to<shape, part>() ? -1 : 0;
    if (left < 0) to_.take_object('s', name, nullptr);  // also an empty list is one
    if constexpr (is_vector<part> || leads_to<shape, part>())
      for (auto at = std::begin(list); at != std::end(list) && left-- != 0; ++at) add(name, *at);
  }

  description& to_;
  const shape* const* array_ = nullptr;
  int count_ = 0;
};

/// Reads what the third book's scatter() fills: a mirror's ray, or a density that directions are drawn from.
template <class N, class R>
void read_record(R& all, scatter_answer& one) {
  bool specular = false;  // it is known before a density is asked for, which mirrors lack
  for (const bool final : {false, true})
    members<R>::each(all, [&](const char*, char, auto& member) {
      using M = std::decay_t<decltype(member)>;
      if constexpr (std::is_same<M, bool>::value) {
        specular = member;
      } else if constexpr (std::is_same<M, typename N::ray>::value) {
        if (final && specular) one.to = ray_traits<M>::parts(&member).to;
      } else if constexpr (TYNDALL_HAS(M, to_vector(o->generate()))) {
        if (final && !specular && one.does) one.to = to_vector(member->generate());
      } else if constexpr (is_vector<M>) {
        one.part = to_vector(member);
      }
    });
}

/// Answers of the reader's functions.
template <class N>
class replies {
 public:
  static program_functions functions() {
    return {hit, scatter, emitted, value, light, describe, rays::is_float(), N::draws_by_pdf, N::decodes_images};
  }

 private:
  using shape = typename N::shape;
  using material = typename N::material;
  using texture = typename N::texture;
  using record = typename N::record;
  using ray = typename N::ray;
  using rays = ray_traits<ray>;

  static void describe(char kind, const void* object, description& to) {
    if (kind == 'k' && loop().describe_camera) loop().describe_camera(to);
    if (kind == 's') describe_all_of(*static_cast<const shape*>(object), to);
    if (kind == 'm') describe_all_of(*static_cast<const material*>(object), to);
    if (kind == 't') describe_all_of(*static_cast<const texture*>(object), to);
  }
  template <class O>
  static void describe_all_of(const O& object, description& to) {
    to.take_object('c', typeid(object).name(), dynamic_cast<const void*>(&object));
    N::describe(object, to);
  }
  static hit_answer hit(const void* of, const shot& one) {
    record r{};
    hit_answer made;
    made.found = N::hit(*static_cast<const shape*>(of), rays::make(one), one.low, one.high, r);
    if (!made.found) return made;
    bool timed = false, sided = false;
    members<record>::each(r, [&](const char*, char role, auto& member) {
      using M = std::decay_t<decltype(member)>;
      if constexpr (std::is_same<M, bool>::value) {
        if (role == 'f') made.front = member, sided = true;
      } else if constexpr (std::is_floating_point<M>::value) {
        if (!timed && role == 0) made.t = double(member), timed = true;
      } else if constexpr (leads_to<material, M>()) {
        made.material = static_cast<const material*>(pointer(member));
      } else if constexpr (is_vector<M>) {
        if (role == 'n') made.normal = to_vector(member);
      }
    });
    if (!sided) made.front = dot(one.to, made.normal) < 0;
    return made;
  }
  static scatter_answer scatter(const void* of, const surface_point& at) {
    const auto* its = static_cast<const material*>(of);
    record r = record_at(at, its);
    return N::scatter(*its, rays::make({at.p - at.to, at.to, 0.5}), r);
  }
  static vector emitted(const void* of, const surface_point& at) {
    const auto* its = static_cast<const material*>(of);
    record r = record_at(at, its);
    return N::emitted(*its, rays::make({at.p - at.to, at.to, 0}), r, at.u, at.v,
                      make_vector<typename rays::part>(at.p));
  }
  static vector value(const void* of, const surface_point& at) {
    return N::value(*static_cast<const texture*>(of), at.u, at.v, make_vector<typename rays::part>(at.p));
  }
  static light_answer light(const light_question& one) {
    light_answer made;
    wanted_ = &one, told_ = &made;
    replaced_world = loop().world, answer_of_world = answer;
    made.colour = loop().colour(rays::kept({one.from, one.to, 0.5}));
    if (made.high == 0)  // it does not ask its world by a hit() that is known: far outside it meets nothing
      made.colour = loop().colour(rays::kept({one.from + (1e7 / length(one.to)) * one.to, one.to, 0.5}));
    replaced_world = nullptr;
    return made;
  }
  static bool answer(const void* met, double low, double high, void* into) {
    if (told_->hits == 0) told_->low = low, told_->high = high;
    if (told_->hits == 1) told_->second = rays::parts(met).to;
    if (told_->hits >= wanted_->firsts + wanted_->thens) return false;
    const void* material_met = told_->hits++ < wanted_->firsts ? wanted_->first : wanted_->then;
    *static_cast<record*>(into) = record_at({vector()}, static_cast<const material*>(material_met));
    return true;
  }
  static record record_at(const surface_point& at, const material* of) {
    record r{};
    bool is_facing = false;  // normals to the ray, as editions 2 to 4 do
    members<record>::each(r, [&](const char*, char role, auto& member) {
      is_facing = is_facing || (std::is_same<std::decay_t<decltype(member)>, bool>::value && role == 'f');
    });
    members<record>::each(r, [&](const char*, char role, auto& member) {
      using M = std::decay_t<decltype(member)>;
      if constexpr (std::is_same<M, bool>::value) {
        if (role == 'f') member = at.front;
      } else if constexpr (std::is_floating_point<M>::value) {
        member = static_cast<M>(role == 'u' ? at.u : role == 'v' ? at.v : 1);
      } else if constexpr (leads_to<material, M>()) {
        set(member, const_cast<material*>(of));
      } else if constexpr (is_vector<M>) {
        member = make_vector<M>(role == 'n' ? vector{0, at.front || !is_facing ? 1.0 : -1.0, 0} : at.p);
      }
    });
    return r;
  }
  template <class M>
  static void set(M& member, material* of) {
    if constexpr (std::is_assignable<M&, material*>::value)
      member = of;
    else if constexpr (std::is_assignable<M&, std::shared_ptr<material>>::value)
      member = std::shared_ptr<material>(of, [](material*) {});
    else if (of)
      throw 0;  // it cannot be asked of single hits
  }

  inline static const light_question* wanted_ = nullptr;  ///< of the colour that is asked for
  inline static light_answer* told_ = nullptr;
};

}  // namespace tyndall_book
