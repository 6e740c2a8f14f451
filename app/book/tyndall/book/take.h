#pragma once
#include "files.h"
#include "hooks.h"

/// What is asked of the reader's program when his world stands: its objects, and what his functions answer. The caller
/// judges them.
namespace tyndall_book {

/// An object's members as text: a line each, with a letter, a name and numbers.
struct member_lines {
  std::string text;
  void add(char letter, const char* name, std::initializer_list<double> numbers) {
    text += letter, text += ' ', text += name;
    for (const double number : numbers) {
      char digits[40];
      std::snprintf(digits, sizeof digits, " %.17g", number);
      for (char& c : digits)
        if (c == ',') c = '.';  // the program may be set to another language
      text += digits;
    }
    text += '\n';
  }
  void add(char letter, const char* name, vector a) { add(letter, name, {a.x, a.y, a.z}); }
  void add(char letter, const char* name, const void* address) { add(letter, name, {number_of(address)}); }
};
/// n: a number; v: a vector; r: a ray's origin and direction; s, m, t: addresses of shapes, a material, a texture. N
/// names the reader's classes.
template <class N>
class description {
 public:
  template <class O>
  static std::string of(const O& object) {
    description one;
    members<O>::each(object, [&](const char* name, char, const auto& member) { one.add(name, member); });
    for (int k = 0; one.array_ && k < one.count_; ++k) one.add("array", one.array_[k]);
    return one.lines_.text;
  }

 private:
  using shape = typename N::shape;
  using material = typename N::material;
  using texture = typename N::texture;
  template <class M>
  void add(const char* name, const M& member) {
    if constexpr (std::is_arithmetic<M>::value) {
      if (std::is_integral<M>::value && !std::is_same<M, bool>::value) count_ = static_cast<int>(member);
      lines_.add('n', name, {double(member)});
    } else if constexpr (std::is_same<M, typename N::ray>::value) {
      const vector a = ray_traits<M>::origin(member), b = ray_traits<M>::direction(member);
      lines_.add('r', name, {a.x, a.y, a.z, b.x, b.y, b.z});
    } else if constexpr (leads_to<shape, const M>()) {
      lines_.add('s', name, static_cast<const shape*>(pointer(member)));
    } else if constexpr (leads_to<material, const M>()) {
      lines_.add('m', name, static_cast<const material*>(pointer(member)));
    } else if constexpr (leads_to<texture, const M>()) {
      lines_.add('t', name, static_cast<const texture*>(pointer(member)));
    } else if constexpr (is_vector<const M>) {
      lines_.add('v', name, to_vector(member));
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
    if (left < 0) lines_.add('s', name, std::initializer_list<double>());  // also an empty list is one
    if constexpr (is_vector<part> || leads_to<shape, part>())
      for (auto at = std::begin(list); at != std::end(list) && left-- != 0; ++at) add(name, *at);
  }

  member_lines lines_;
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

/// A line each: the class of an object, and the file that was read before it was made.
inline std::string text_of_object(const std::type_info& type, const void* object) {
  int failed = 0;
  char* name = abi::__cxa_demangle(type.name(), nullptr, nullptr, &failed);
  const std::string text = name ? name : type.name();
  std::free(name);
  std::string file;
  for (const opened_file& one : opened_files::get().of_objects)
    if (one.object == object) file = one.name;
  return text + '\n' + file + '\n';
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

  /// k: the camera.
  static std::string described(const session& s, char kind, const void* object) {
    if (kind == 'k') return "\n\n" + (s.rays.described ? s.rays.described() : "");
    if (kind == 's') return described_object(*static_cast<const shape*>(object));
    if (kind == 'm') return described_object(*static_cast<const material*>(object));
    return described_object(*static_cast<const texture*>(object));
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
  static vector value(const session&, const void* of, const texture_place& at) {
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
    return light(s, of, {seen.from, seen.to}).colour;
  }

 private:
  template <class O>
  static std::string described_object(const O& object) {
    return text_of_object(typeid(object), dynamic_cast<const void*>(&object)) + N::members_of(object);
  }
  static bool answer(const void* met, double low, double high, void* into) {
    if (told_->hits == 0) told_->low = low, told_->high = high;
    if (told_->hits == 1) told_->second = rays::direction(*static_cast<const ray*>(met));
    if (told_->hits >= wanted_->firsts + wanted_->thens) return false;
    const double material_met = told_->hits++ < wanted_->firsts ? wanted_->first : wanted_->then;
    *static_cast<record*>(into) =
        record_at({{}, {}, 1, 0.37, 0.63}, static_cast<const material*>(address_of(material_met)));
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
/// How a question is answered, and the bytes of both.
struct reply {
  char letter = 0;  ///< 0: there are no more
  std::size_t in = 0, out = 0;
  void (*make)(const session& s, const void* object, const void* in, void* out) = nullptr;
};
template <class Q, class A, A (*of)(const session&, const void*, const Q&)>
constexpr reply reply_to(char letter) {
  return {letter, sizeof(Q), sizeof(A), [](const session& s, const void* object, const void* in, void* out) {
            new (out) A(of(s, object, *static_cast<const Q*>(in)));
          }};
}
inline vector sample(const session& s, const void*, const pixel_place& at) { return s.colour(s.ray_at(at.x, at.y)); }

/// Answers for as long as questions come, by numbers that are none (NaN) where the reader's function throws. described:
/// answers all other letters by texts, whose questions are addresses.
[[noreturn]] inline void serve(const session& s, const reply* replies,
                               std::string (*described)(const session&, char, const void*)) {
  for (question query;;) {
    receive_bytes(&query, sizeof query);
    const void* object = address_of(query.object);
    const reply* its = replies;
    while (its->letter != 0 && its->letter != static_cast<char>(query.letter)) ++its;
    if (its->letter == 0) {
      std::string text;
      for (double left = query.count; left > 0; --left) {
        double address = 0;
        receive_bytes(&address, sizeof address);
        text += described(s, static_cast<char>(query.letter), address_of(address)) + '\f';
      }
      tell('D', text);
      continue;
    }
    const auto count = static_cast<std::size_t>(query.count), different = static_cast<std::size_t>(query.different);
    std::string given(different * its->in, 0), made(count * its->out, 0);
    receive_bytes(&given[0], given.size());
    for (std::size_t k = 0; k < count; ++k) try {
        its->make(s, object, &given[k % different * its->in], &made[k * its->out]);
      } catch (...) {
        for (std::size_t n = 0; n < its->out; n += sizeof(double)) new (&made[k * its->out + n]) double(NAN);
        replaced_world = nullptr;
      }
    send_bytes(made.data(), made.size());
  }
}

inline void tell_picture(const picture_told& told) {
  for (const std::string& name : opened_files::get().missing)
    if (!name.empty()) tell('F', name);
  tell('P', std::string(reinterpret_cast<const char*>(&told), sizeof told));
}
template <class N>
[[noreturn]] void take_over_world(session& s) {
  using its = replies<N>;
  static constexpr reply all[] = {reply_to<shot, shot_answer, its::hit>('h'),
                                  reply_to<surface_point, scatter_answer, its::scatter>('x'),
                                  reply_to<surface_point, vector, its::emitted>('e'),
                                  reply_to<texture_place, vector, its::value>('v'),
                                  reply_to<pixel_place, ray_answer, its::ray_at>('r'),
                                  reply_to<light_question, light_answer, its::light>('c'),
                                  reply_to<ray_answer, vector, its::sky>('y'),
                                  reply_to<pixel_place, vector, sample>('p'),
                                  {}};
  s.is_float = its::rays::is_float();
  tell_picture(s);
  serve(s, all, its::described);
}
[[noreturn]] inline void take_samples(session& s) {
  static constexpr reply all[] = {reply_to<pixel_place, vector, sample>('p'), {}};
  s.world = 0;
  tell_picture(s);
  serve(s, all, nullptr);
}

}  // namespace tyndall_book
