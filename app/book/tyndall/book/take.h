#pragma once
#include "files.h"
#include "hooks.h"

/// What is asked of the reader's program when his world stands: its objects, and what his functions answer. The caller
/// judges them.
namespace tyndall_book {

/// An object's members as text: a line each, with a letter, a name and numbers. n: a number; v: a vector; r: a ray's
/// origin and direction; s, m, t: addresses of shapes, a material, a texture. N names the reader's classes.
template <class N>
class description {
 public:
  template <class O>
  static std::string of(const O& object) {
    description one;
    members<O>::each(object, [&](const char* name, char, const auto& member) { one.add(name, member); });
    for (int k = 0; one.array_ && k < one.count_; ++k) one.add("array", one.array_[k]);
    return one.text_;
  }

 private:
  using shape = typename N::shape;
  using material = typename N::material;
  using texture = typename N::texture;
  void add_line(char letter, const char* name, std::initializer_list<double> numbers) {
    text_ += letter, text_ += ' ', text_ += name;
    for (const double number : numbers) {
      char digits[40];
      std::snprintf(digits, sizeof digits, " %.17g", number);
      for (char& c : digits)
        if (c == ',') c = '.';  // the program may be set to another language
      text_ += digits;
    }
    text_ += '\n';
  }
  template <class T, class M>
  void add_address(char letter, const char* name, const M& member) {
    add_line(letter, name, {number_of(static_cast<const T*>(pointer(member)))});
  }
  template <class M>
  void add(const char* name, const M& member) {
    if constexpr (std::is_arithmetic<M>::value) {
      if (std::is_integral<M>::value && !std::is_same<M, bool>::value) count_ = static_cast<int>(member);
      add_line('n', name, {double(member)});
    } else if constexpr (std::is_same<M, typename N::ray>::value) {
      const vector a = ray_traits<M>::origin(member), b = ray_traits<M>::direction(member);
      add_line('r', name, {a.x, a.y, a.z, b.x, b.y, b.z});
    } else if constexpr (leads_to<shape, const M>()) {
      add_address<shape>('s', name, member);
    } else if constexpr (leads_to<material, const M>()) {
      add_address<material>('m', name, member);
    } else if constexpr (leads_to<texture, const M>()) {
      add_address<texture>('t', name, member);
    } else if constexpr (is_vector<const M>) {
      const vector a = to_vector(member);
      add_line('v', name, {a.x, a.y, a.z});
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
    if (left < 0) add_line('s', name, {});  // also an empty list is one
    if constexpr (is_vector<part> || leads_to<shape, part>())
      for (auto at = std::begin(list); at != std::end(list) && left-- != 0; ++at) add(name, *at);
  }

  std::string text_;
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
        if (final && specular) one.to = ray_traits<M>::direction(member);
      } else if constexpr (TYNDALL_HAS(M, to_vector(o->generate()))) {
        if (final && !specular && one.does != 0) one.to = to_vector(member->generate());
      } else if constexpr (is_vector<M>) {
        one.part = to_vector(member);
      }
    });
}

/// Answers of the reader's functions.
template <class N>
class replies {
 public:
  using shape = typename N::shape;
  using material = typename N::material;
  using texture = typename N::texture;
  using record = typename N::record;
  using ray = typename N::ray;
  using rays = ray_traits<ray>;

  static std::string described(const session& s, char kind, const void* object) {
    if (kind == 'k') return "\n\n" + (s.rays.described ? s.rays.described() : "");
    if (kind == 's') return text_of(*static_cast<const shape*>(object));
    if (kind == 'm') return text_of(*static_cast<const material*>(object));
    return kind == 't' ? text_of(*static_cast<const texture*>(object)) : "";
  }
  static shot_answer hit(const session&, const void*, const shot& one) {
    record r{};
    shot_answer made;
    made.found = N::hit(*static_cast<const shape*>(address_of(one.shape)), rays::make(one.from, one.to, one.time),
                        one.low, one.high, r);
    if (made.found == 0) return made;
    bool timed = false, sided = false;
    members<record>::each(r, [&](const char*, char role, auto& member) {
      using M = std::decay_t<decltype(member)>;
      if constexpr (std::is_same<M, bool>::value) {
        if (role == 'f') made.front = member, sided = true;
      } else if constexpr (std::is_floating_point<M>::value) {
        if (!timed && role == 0) made.t = double(member), timed = true;
      } else if constexpr (leads_to<material, M>()) {
        made.material = number_of(static_cast<const material*>(pointer(member)));
      } else if constexpr (is_vector<M>) {
        if (role == 'n') made.normal = to_vector(member);
      }
    });
    if (!sided) made.front = dot(one.to, made.normal) < 0;
    return made;
  }
  static scatter_answer scatter(const session&, const void* of, const surface_point& at) {
    const auto* its = static_cast<const material*>(of);
    record r = record_at(at, its);
    return N::scatter(*its, rays::make(at.p - at.to, at.to, 0.5), r);
  }
  static vector emitted(const session&, const void* of, const surface_point& at) {
    const auto* its = static_cast<const material*>(of);
    record r = record_at(at, its);
    return N::emitted(*its, rays::make(at.p - at.to, at.to, 0), r, at.u, at.v, make_vector<typename rays::part>(at.p));
  }
  static vector value(const session&, const void* of, const surface_point& at) {
    return N::value(*static_cast<const texture*>(of), at.u, at.v, make_vector<typename rays::part>(at.p));
  }
  static ray_answer ray_at(const session& s, const void*, const pixel_place& at) {
    const ray& one = *static_cast<const ray*>(s.ray_at(at.x, at.y));
    return {rays::origin(one), rays::direction(one), rays::time(one)};
  }
  static light_answer light(const session& s, const void*, const light_question& one) {
    light_answer made;
    wanted_ = &one, told_ = &made;
    replaced_world = address_of(s.world), answer_of_world = answer;
    const ray query = rays::make(one.from, one.to, 0.5);
    made.colour = s.colour(&query);
    if (made.high == 0) {  // it does not ask its world by a hit() that is known: far outside it meets nothing
      const ray far = rays::make(one.from + (1e7 / length(one.to)) * one.to, one.to, 0.5);
      made.colour = s.colour(&far);
    }
    replaced_world = nullptr;
    return made;
  }
  static vector sky(const session& s, const void* of, const ray_answer& seen) {
    return light(s, of, {0, 0, 0, 0, seen.from, seen.to}).colour;
  }

 private:
  /// A line each: the class of an object, and the file that was read before it was made; then its members.
  template <class O>
  static std::string text_of(const O& object) {
    int failed = 0;
    char* name = abi::__cxa_demangle(typeid(object).name(), nullptr, nullptr, &failed);
    const std::string text = name ? name : typeid(object).name();
    std::free(name);
    const std::string& file = opened_files::get().of_objects[dynamic_cast<const void*>(&object)];
    return text + '\n' + file + '\n' + N::members_of(object);
  }
  static bool answer(const void* met, double low, double high, void* into) {
    if (told_->hits == 0) told_->low = low, told_->high = high;
    if (told_->hits == 1) told_->second = rays::direction(*static_cast<const ray*>(met));
    if (told_->hits >= wanted_->firsts + wanted_->thens) return false;
    const double material_met = told_->hits++ < wanted_->firsts ? wanted_->first : wanted_->then;
    *static_cast<record*>(into) = record_at({vector()}, static_cast<const material*>(address_of(material_met)));
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
        if (role == 'f') member = at.front != 0;
      } else if constexpr (std::is_floating_point<M>::value) {
        member = static_cast<M>(role == 'u' ? at.u : role == 'v' ? at.v : 1);
      } else if constexpr (leads_to<material, M>()) {
        set(member, const_cast<material*>(of));
      } else if constexpr (is_vector<M>) {
        member = make_vector<M>(role == 'n' ? vector{0, at.front != 0 || !is_facing ? 1.0 : -1.0, 0} : at.p);
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
inline void receive_bytes(void* to, std::size_t size) {
  for (char* at = static_cast<char*>(to); size > 0;) {
    const auto got = read(channel(), at, size);
    if (got <= 0) std::_Exit(0);
    at += got, size -= static_cast<std::size_t>(got);
  }
}
template <class A>
void add(std::string& answers, const A& one) {
  answers.append(reinterpret_cast<const char*>(&one), sizeof one);
}
/// A question that has come, and its answers.
struct query {
  question head;
  std::string given, answers;
  char letter() const { return static_cast<char>(head.letter); }

  /// Answers if it is the question of this letter; by numbers that are none (NaN) where the reader's function throws.
  template <class A, class Q>
  void answer(char of_letter, const session& s, A (*of)(const session&, const void*, const Q&)) {
    if (letter() != of_letter) return;
    const std::size_t different = given.size() / sizeof(Q);
    const std::size_t count = head.count > 0 ? static_cast<std::size_t>(head.count) : different;
    for (std::size_t k = 0; k < count; ++k) try {
        add(answers, of(s, address_of(head.object), reinterpret_cast<const Q*>(given.data())[k % different]));
      } catch (...) {
        for (std::size_t n = 0; n < sizeof(A); n += sizeof(double)) add(answers, double(NAN));
        replaced_world = nullptr;
      }
  }
};
inline vector sample(const session& s, const void*, const pixel_place& at) { return s.colour(s.ray_at(at.x, at.y)); }
inline void answer_samples(const session& s, query& one) { one.answer('p', s, sample); }
template <class N>
void answer(const session& s, query& one) {
  using its = replies<N>;
  one.answer('h', s, its::hit), one.answer('x', s, its::scatter), one.answer('e', s, its::emitted);
  one.answer('v', s, its::value), one.answer('r', s, its::ray_at), one.answer('c', s, its::light);
  one.answer('y', s, its::sky), answer_samples(s, one);
  one.answers += its::described(s, one.letter(), address_of(one.head.object));
}

/// Tells the picture, then answers for as long as questions come.
[[noreturn]] inline void serve(const session& s, void (*answer)(const session&, query&)) {
  for (const std::string& name : opened_files::get().missing)
    if (!name.empty()) tell('F', name);
  const picture_told& told = s;
  tell('P', std::string(reinterpret_cast<const char*>(&told), sizeof told));
  for (;;) {
    query one;
    receive_bytes(&one.head, sizeof one.head);
    one.given.resize(static_cast<std::size_t>(one.head.size));
    receive_bytes(&one.given[0], one.given.size());
    answer(s, one);
    tell('A', one.answers);
  }
}

}  // namespace tyndall_book
