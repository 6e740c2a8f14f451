#pragma once
#include <cxxabi.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

/// Reading of objects whose classes are the reader's: this file is compiled before his code, as C++17.
namespace tyndall_book {

template <class T, class F>
constexpr bool can(F) {
  return std::is_invocable<F, T&>::value;
}
/// Whether an expression of `o`, an object of class T, can be compiled.
#define TYNDALL_HAS(T, ...) (::tyndall_book::can<T>([](auto& o) -> decltype((void)(__VA_ARGS__)) {}))
/// What reads such an expression, for pick().
#define TYNDALL_GET(...) [](auto& o) -> decltype((__VA_ARGS__)) { return __VA_ARGS__; }

/// A member of the object by the first of these names that its class has; absent: by none.
#define TYNDALL_ANY(object, ...) pick(object, TYNDALL_EACH(TYNDALL_MEMBER, __VA_ARGS__))
/// The same, of those that are numbers of that type.
#define TYNDALL_ANY_AS(type, object, ...) pick(object, TYNDALL_EACH(TYNDALL_MEMBER_##type, __VA_ARGS__))
#define TYNDALL_MEMBER(name) TYNDALL_GET(o.name)
#define TYNDALL_MEMBER_double(name) TYNDALL_GET(double(o.name))
#define TYNDALL_MEMBER_int(name) TYNDALL_GET(int(o.name))
#define TYNDALL_MEMBER_bool(name) TYNDALL_GET(bool(o.name))
#define TYNDALL_EACH(m, ...) TYNDALL_PICK(__VA_ARGS__, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1)(m, __VA_ARGS__)
#define TYNDALL_PICK(a, b, c, d, e, f, g, h, i, j, k, l, m, n, count, ...) TYNDALL_EACH_##count
#define TYNDALL_EACH_1(m, a) m(a)
#define TYNDALL_EACH_2(m, a, ...) m(a), TYNDALL_EACH_1(m, __VA_ARGS__)
#define TYNDALL_EACH_3(m, a, ...) m(a), TYNDALL_EACH_2(m, __VA_ARGS__)
#define TYNDALL_EACH_4(m, a, ...) m(a), TYNDALL_EACH_3(m, __VA_ARGS__)
#define TYNDALL_EACH_5(m, a, ...) m(a), TYNDALL_EACH_4(m, __VA_ARGS__)
#define TYNDALL_EACH_6(m, a, ...) m(a), TYNDALL_EACH_5(m, __VA_ARGS__)
#define TYNDALL_EACH_7(m, a, ...) m(a), TYNDALL_EACH_6(m, __VA_ARGS__)
#define TYNDALL_EACH_8(m, a, ...) m(a), TYNDALL_EACH_7(m, __VA_ARGS__)
#define TYNDALL_EACH_9(m, a, ...) m(a), TYNDALL_EACH_8(m, __VA_ARGS__)
#define TYNDALL_EACH_10(m, a, ...) m(a), TYNDALL_EACH_9(m, __VA_ARGS__)
#define TYNDALL_EACH_11(m, a, ...) m(a), TYNDALL_EACH_10(m, __VA_ARGS__)
#define TYNDALL_EACH_12(m, a, ...) m(a), TYNDALL_EACH_11(m, __VA_ARGS__)
#define TYNDALL_EACH_13(m, a, ...) m(a), TYNDALL_EACH_12(m, __VA_ARGS__)
#define TYNDALL_EACH_14(m, a, ...) m(a), TYNDALL_EACH_13(m, __VA_ARGS__)

struct absent {};
/// In the place of classes that the reader's program does not have.
struct absent_material {
  virtual ~absent_material() = default;
};
struct absent_texture {
  virtual ~absent_texture() = default;
};

/// What the first of the readers that can be compiled reads; absent: none can.
template <class T, class F, class... G>
decltype(auto) pick(T& object, F first, G... rest) {
  if constexpr (std::is_invocable<F, T&>::value)
    return first(object);
  else if constexpr (sizeof...(rest) > 0)
    return pick(object, rest...);
  else
    return absent{};
}
template <class T>
constexpr bool is_absent = std::is_same<std::decay_t<T>, absent>::value;

template <class T>
T larger(T a, T b) {
  return a < b ? b : a;
}

struct vector {
  double x = 0, y = 0, z = 0;
};
inline vector operator+(vector a, vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline vector operator-(vector a, vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline vector operator*(double s, vector a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(vector a, vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline vector cross(vector a, vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(vector a) { return std::sqrt(dot(a, a)); }
inline vector normalized(vector a) { return (1 / length(a)) * a; }
inline double largest(vector a) { return std::fmax(std::fabs(a.x), std::fmax(std::fabs(a.y), std::fabs(a.z))); }
/// Whether two values agree, as far as numbers of the reader's precision can.
inline bool near(double a, double b, double precision) {
  return std::fabs(a - b) <= precision * std::fmax(1.0, std::fmax(std::fabs(a), std::fabs(b)));
}
inline bool near(vector a, vector b, double precision) {
  return largest(a - b) <= precision * std::fmax(1.0, std::fmax(largest(a), largest(b)));
}

/// A vector or colour of the reader's.
template <class T>
vector to_vector(const T& a) {
  const auto x = [](auto n, auto m, auto k) { return vector{double(n), double(m), double(k)}; };
  if constexpr (TYNDALL_HAS(const T, double(o.x()), double(o.y()), double(o.z())))
    return x(a.x(), a.y(), a.z());
  else if constexpr (TYNDALL_HAS(const T, double(o.x), double(o.y), double(o.z)))
    return x(a.x, a.y, a.z);
  else if constexpr (TYNDALL_HAS(const T, double(o[0])))
    return x(a[0], a[1], a[2]);
  else if constexpr (TYNDALL_HAS(const T, double(o.e[0])))
    return x(a.e[0], a.e[1], a.e[2]);
  else if constexpr (TYNDALL_HAS(const T, double(o.r()), double(o.g()), double(o.b())))
    return x(a.r(), a.g(), a.b());
  else
    return x(a.r, a.g, a.b);
}
template <class T>
constexpr bool is_vector =
    !is_absent<T> && !std::is_arithmetic<std::decay_t<T>>::value && !std::is_pointer<std::decay_t<T>>::value &&
    (TYNDALL_HAS(const std::decay_t<T>, double(o.x()), double(o.z())) ||
     TYNDALL_HAS(const std::decay_t<T>, double(o.x), double(o.z)) || TYNDALL_HAS(const std::decay_t<T>, double(o[2])) ||
     TYNDALL_HAS(const std::decay_t<T>, double(o.e[2])) ||
     TYNDALL_HAS(const std::decay_t<T>, double(o.r()), double(o.b())) ||
     TYNDALL_HAS(const std::decay_t<T>, double(o.r), double(o.b)));

/// What a pointer of any kind points to; an object is taken for itself.
template <class P>
auto* pointer(P& p) {
  if constexpr (TYNDALL_HAS(P, o.get()))
    return p.get();
  else if constexpr (std::is_pointer<std::decay_t<P>>::value)
    return p;
  else
    return &p;
}
/// Whether P is an object of class T, a class derived from it, or a pointer of any kind to one.
template <class T, class P>
constexpr bool leads_to() {
  if constexpr (is_absent<P>)
    return false;
  else
    return std::is_base_of<T, std::decay_t<decltype(*pointer(std::declval<std::remove_reference_t<P>&>()))>>::value;
}

/// The rays of a class, by any edition's names.
template <class R>
struct ray_traits {
  template <class T>
  static decltype(auto) direction_of(T& ray) {
    return pick(ray, TYNDALL_GET(o.direction()), TYNDALL_GET(o.dir), TYNDALL_GET(o.direction), TYNDALL_GET(o.B),
                TYNDALL_GET(o.getDirection()), TYNDALL_GET(o.Direction()), TYNDALL_GET(o.d),
                TYNDALL_GET(o.m_direction));
  }
  template <class T>
  static decltype(auto) origin_of(T& ray) {
    return pick(ray, TYNDALL_GET(o.origin()), TYNDALL_GET(o.orig), TYNDALL_GET(o.origin), TYNDALL_GET(o.A),
                TYNDALL_GET(o.getOrigin()), TYNDALL_GET(o.Origin()), TYNDALL_GET(o.o), TYNDALL_GET(o.m_origin));
  }
  using part = std::decay_t<decltype(direction_of(std::declval<const R&>()))>;
  static_assert(is_vector<part>, "a ray has a direction");
  using number = std::decay_t<decltype(std::declval<const part&>(), 0.0)>;

  static vector origin(const R& ray) { return to_vector(origin_of(ray)); }
  static vector direction(const R& ray) { return to_vector(direction_of(ray)); }
  static double time(const R& ray) {
    decltype(auto) time = pick(ray, TYNDALL_GET(double(o.time())), TYNDALL_GET(double(o.tm)),
                               TYNDALL_GET(double(o._time)), TYNDALL_GET(double(o.time)));
    if constexpr (is_absent<decltype(time)>)
      return 0;
    else
      return time;
  }
  static part make_vector(vector a) {
    if constexpr (std::is_constructible<part, float, float, float>::value)
      return part(a.x, a.y, a.z);
    else
      return part{decltype(part().x)(a.x), decltype(part().x)(a.y), decltype(part().x)(a.z)};
  }
  static R make(vector from, vector to, double time) {
    part a = make_vector(from), b = make_vector(to);
    if constexpr (std::is_constructible<R, part&, part&, double>::value)
      return R(a, b, time);
    else if constexpr (std::is_constructible<R, part&, part&>::value)
      return R(a, b);
    else
      return R{a, b};
  }
  /// What two computations of the same number may differ by.
  static double precision() {
    const double third = to_vector(make_vector({1.0 / 3, 0, 0})).x;
    return third == 1.0 / 3 ? 1e-6 : 2e-3;
  }
};

/// The name of an object's class.
template <class T>
std::string class_of(const T& object) {
  int failed = 0;
  char* name = abi::__cxa_demangle(typeid(object).name(), nullptr, nullptr, &failed);
  const std::string text = name ? name : typeid(object).name();
  std::free(name);
  return text;
}

/// Reads back as the same number, whatever language the program is set to.
inline std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  for (char& c : text)
    if (c == ',') c = '.';
  return text;
}
inline std::string triple(vector v) { return "[" + number(v.x) + "," + number(v.y) + "," + number(v.z) + "]"; }
/// For people.
inline std::string words(vector v) {
  char text[120];
  std::snprintf(text, sizeof text, "(%.4g, %.4g, %.4g)", v.x, v.y, v.z);
  return text;
}
/// A JSON string.
inline std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    char escape[8];
    std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned char>(c));
    if (static_cast<unsigned char>(c) < 0x20) {
      out += escape;
    } else {
      if (c == '"' || c == '\\') out += '\\';
      out += c;
    }
  }
  return out + "\"";
}

/// Numbers of our own: the reader's generator is his.
struct random_numbers {
  unsigned long long state = 0x9e3779b97f4a7c15ULL;
  double next() {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return double(state >> 11) / 9007199254740992.0;
  }
  double between(double a, double b) { return a + (b - a) * next(); }
  vector on_sphere() {
    const double z = between(-1, 1), angle = between(0, 6.283185307179586), r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }
};

/// Why something cannot be taken over, for the user.
struct not_taken {
  std::string reason;
};
/// Refuses an object of the reader's.
template <class T>
[[noreturn]] void refuse(const T& object, const std::string& why) {
  throw not_taken{class_of(object) + ": " + why};
}

/// The scene as it becomes text: Tyndall's JSON.
struct scene_text {
  std::string textures, materials;   ///< members of JSON objects
  std::vector<std::string> objects;  ///< JSON objects
  std::vector<std::string> notes;    ///< what the user should know
  bool fuzz_on_sphere = false, matt_in_sphere = false, has_noise = false, has_images = false;
  const void *matt = nullptr, *shining = nullptr;  ///< a material that scatters one colour, and one that shines
  vector albedo, light;                            ///< their colours

  /// The quoted name of a texture or material, which is added to `list` when it is asked for first. text: makes it.
  template <class T, class Text>
  std::string name_of(const T& thing, std::string& list, const Text& text) {
    const auto known = names_.find(&thing);
    if (known != names_.end()) return known->second;
    const std::string made = text(), kind = class_of(thing);
    if (made[0] != '{') return names_[&thing] = made;  // a colour needs no name
    const std::string name = quoted(kind + " " + std::to_string(++counts_[kind]));
    list += (list.empty() ? "" : ",\n") + name + ":" + made;
    return names_[&thing] = name;
  }
  void note(const std::string& text) {
    for (const std::string& known : notes)
      if (known == text) return;
    notes.push_back(text);
  }

 private:
  std::map<const void*, std::string> names_;
  std::map<std::string, int> counts_;
};

}  // namespace tyndall_book
