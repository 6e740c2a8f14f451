#include "app/book/program_outline.h"

#include "core/base/text.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>

namespace tyndall {
namespace {

bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }
bool is_number(const Parameter& one) { return one.identifiers.size() == 1 && !one.has("<") && !one.has("*"); }
/// The type's own name.
std::string last_of(const Parameter& one) { return one.identifiers.empty() ? "" : one.identifiers.back(); }
/// Whether the function may set it.
bool is_set(const Parameter& one) { return !one.has("const") && one.has("&"); }
bool is_real(const Parameter& parameter) {
  return is_one_of(last_of(parameter), {"double", "float", "real", "Real", "Float"});
}
bool is_colour(const Function& function) {
  return !is_one_of(function.result, {"", "bool", "void", "double", "float", "int", "auto"});
}
/// What a member is for, by its name; see members in tyndall/book/values.h.
std::string role_of(const std::string& member) {
  const std::string whole = key_of(member), key = whole[0] == 'm' && whole.size() == 2 ? whole.substr(1) : whole;
  constexpr std::pair<const char*, char> parts[] = {{"norm", 'n'},  {"front", 'f'},  {"face", 'f'},  {"outside", 'f'},
                                                    {"width", 'w'}, {"height", 'h'}, {"sample", 's'}};
  for (const auto& [part, role] : parts)
    if (contains(key, part)) return {'\'', role, '\''};
  if (key == "n" || key == "u" || key == "v") return "'" + key + "'";
  return key == "spp" ? "'s'" : "0";
}
/// What stands for the function's parameters, in their order.
template <class Of>
std::string for_each_parameter(const Function& function, const Of& of) {
  std::vector<std::string> all;
  for (const Parameter& parameter : function.parameters) all.push_back(of(parameter));
  return joined(all);
}

class Inserter {
 public:
  Inserter(const std::string& text, const ProgramOutline& outline) : text_(text), outline_(outline) {}

  InsertedCalls run(bool reads_world) {
    find_roles();
    if (ray_.empty()) return {"", "has no function hit() of a class of shapes, which rays could be asked for"};
    const auto each = [&](void (Inserter::*insert_into)(const Function&)) {
      for (const Function& function : outline_.functions)
        if (!function.body.empty()) (this->*insert_into)(function);
    };
    each(&Inserter::hook_camera), each(&Inserter::hook);
    if (!has_colour_) each(&Inserter::hook_without_world);
    if (!has_colour_) return {"", "has no function that computes the colour of a ray in a world"};
    show_heads();
    hurry_through_images();
    const std::string end = reads_world ? tail() : R"(namespace tyndall_book {
template <class C> void describe_camera(const C&, description&) {}
void take_over() { serve(nullptr); }
}
)";
    return {with_insertions() + "\n# 1 \"tyndall/book/names\"\n" + end, ""};
  }

 private:
  void insert(const char* at, const std::string& call) {
    insertions_.emplace(static_cast<std::size_t>(at - text_.data()), call);
  }
  void insert(const Function& function, const std::string& call) { insert(function.body.data() + 1, call); }
  std::string with_insertions() const {
    std::string made = text_;
    for (auto one = insertions_.rbegin(); one != insertions_.rend(); ++one) made.insert(one->first, one->second);
    return made;
  }
  std::string qualified(const std::string& name) const {
    const OutlinedClass* known = outline_.class_named(name);
    return known ? known->qualified : name;
  }

  void find_roles() {
    for (const bool first : {true, false})
      for (const Function& function : outline_.functions) {
        const std::string key = key_of(function.name), owner = function.owner;
        if (owner.empty() || !function.is_virtual || !outline_.class_named(owner)->bases.empty()) continue;
        if (first && shape_.empty() && (key.starts_with("hit") || key.starts_with("intersect"))) take_hit(function);
        if (first && !scatter_ && key.starts_with("scatter") && function.result == "bool")
          material_ = owner, scatter_ = &function;
        if (!first && !emitted_ && owner == material_ && key.starts_with("emit")) emitted_ = &function;
        if (!first && !value_ && contains(key_of(owner), "texture") && function.parameters.size() >= 2)
          texture_ = owner, value_ = &function;
      }
  }
  void take_hit(const Function& function) {
    std::string ray, record;
    for (const Parameter& parameter : function.parameters) {
      const std::string type = last_of(parameter);
      if (!outline_.class_named(type)) continue;
      if (ray.empty() && contains(key_of(type), "ray"))
        ray = type;
      else if (is_set(parameter) && (record.empty() || contains(key_of(type), "rec")))
        record = type;
    }
    if (ray.empty() || record.empty() || function.result != "bool") return;
    shape_ = function.owner, ray_ = ray, record_ = record, hit_ = &function;
  }

  // The calls -------------------------------------------------------------------------------------------------------

  void hook(const Function& function) {
    if (function.name == hit_->name && outline_.is_derived(function.owner, shape_)) hook_hit(function);
    if (function.result.empty() && outline_.is_derived(function.owner, texture_) && !function.parameters.empty())
      insert(function, " const ::tyndall_book::texture_made tyndall_made{this};");
    if (!may_be_hooked(function)) return;
    for (const Parameter& parameter : function.parameters)
      for (const std::string& name : parameter.identifiers)
        if (outline_.is_derived(name, shape_)) return hook_colour(function, parameter.name);
  }
  /// Whether it is none of the things' own functions, and can be called again.
  bool may_be_called(const Function& function) const {
    const std::string& owner = function.owner;
    if (owner == ray_ || outline_.is_derived(owner, shape_) || outline_.is_derived(owner, material_)) return false;
    return std::none_of(function.parameters.begin(), function.parameters.end(),
                        [&](const Parameter& one) { return one.name.empty() || one.has(record_); });
  }
  /// Whether it computes the colour of a ray.
  bool may_be_hooked(const Function& function) const {
    return may_be_called(function) && is_colour(function) && !is_camera(function) &&
           std::any_of(function.parameters.begin(), function.parameters.end(),
                       [&](const Parameter& one) { return one.has(ray_); });
  }
  bool is_camera(const Function& function) const {
    if (!may_be_called(function) || !contains(key_of(function.name), "ray") || function.parameters.size() < 2)
      return false;
    const Parameter &first = function.parameters[0], &second = function.parameters[1];
    return (" " + function.result).ends_with(" " + ray_) && is_number(first) && is_number(second) &&
           !outline_.class_named(last_of(first));
  }
  void hook_camera(const Function& function) {
    if (!is_camera(function)) return;
    has_camera_ = true;
    const std::string first = function.parameters[0].name, second = function.parameters[1].name;
    const std::string arguments = for_each_parameter(function, [&](const Parameter& parameter) {
      return parameter.name == first ? "tyndall_a" : parameter.name == second ? "tyndall_b" : parameter.name;
    });
    insert(function,
           fmt::format(" if (!::tyndall_book::is_ours) ::tyndall_book::ray_wanted({}, [=](auto tyndall_a, auto "
                       "tyndall_b) mutable {{ return {}({}); }}, {}, {});",
                       !function.owner.empty() && !function.is_static ? "*this" : "0", function.name, arguments, first,
                       second));
  }
  /// The world answers by its hit() unless it is asked to answer for us.
  void hook_hit(const Function& function) {
    std::string ray, record, low = "0", high = "0";
    int reals = 0;
    for (const Parameter& parameter : function.parameters) {
      if (parameter.name.empty()) return;
      if (parameter.has(ray_))
        ray = parameter.name;
      else if (parameter.has(record_))
        record = parameter.name;
      else if (is_real(parameter))
        (reals++ == 0 ? low : high) = parameter.name;
      else if (!is_set(parameter))
        low = fmt::format("::tyndall_book::end_of({}, false)", parameter.name),
        high = fmt::format("::tyndall_book::end_of({}, true)", parameter.name);
    }
    if (!ray.empty() && !record.empty())
      insert(function, fmt::format(" if (::tyndall_book::replaced_world == static_cast<const {}*>"
                                   "(this)) return ::tyndall_book::answer_of_world(&{}, {}, {}, &{});",
                                   qualified(shape_), ray, low, high, record));
  }
  void hook_colour(const Function& function, const std::string& world) {
    has_colour_ = true;
    std::string ray;
    const std::string arguments = for_each_parameter(function, [&](const Parameter& parameter) -> std::string {
      if (!parameter.has(ray_) || !ray.empty()) return parameter.name;
      ray = parameter.name;
      return "tyndall_ray";
    });
    insert(function,
           fmt::format(" if (!::tyndall_book::is_ours) return ::tyndall_book::colour_wanted<{}, {}>([&](const auto& "
                       "tyndall_ray) {{ return {}({}); }}, {}, {}, ::tyndall_book::first_whole({}));",
                       qualified(shape_), has_camera_, function.name, arguments, ray, world,
                       for_each_parameter(function, [](const Parameter& one) { return one.name; })));
  }
  /// A function of a ray alone, whose world is a member or a global object that it asks for hits.
  void hook_without_world(const Function& function) {
    if (!may_be_hooked(function)) return;
    for (const std::string dot : {".", "->"}) {
      const std::size_t at = function.body.find(dot + hit_->name + "(");
      if (at == std::string_view::npos) continue;
      const std::size_t from = 1 + function.body.substr(0, at).find_last_not_of(
                                       "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.>-");
      if (from < at) return hook_colour(function, std::string(function.body.substr(from, at - from)));
    }
  }

  /// What begins a picture in the P3 format is not kept in a buffer.
  void show_heads() {
    for (const char* head : {"\"P3", "\"P6"})
      for (std::size_t at = 0; (at = text_.find(head, at + 1)) != std::string::npos;)
        if (const std::size_t before = text_.find_last_not_of(" \t\n", at - 1); text_.compare(before - 1, 2, "<<") == 0)
          insert(text_.data() + at, "::std::unitbuf << ");
  }
  /// A library that decodes images is as long as all else, and takes no time when it runs: it is not optimised.
  void hurry_through_images() {
    const std::size_t first = text_.find("stb_image.h\" 1"), last = text_.rfind("stb_image.h\"");
    const std::size_t begin = text_.find('\n', first), end = text_.find("\n# ", last);
    if (first == std::string::npos || end == std::string::npos) return;
    insert(text_.data() + begin, "\n#pragma GCC push_options\n#pragma GCC optimize(\"O0\")");
    insert(text_.data() + end, "\n#pragma GCC pop_options");
  }

  // The tail --------------------------------------------------------------------------------------------------------

  /// Calls one of the reader's functions, whose parameters tell what they are.
  std::string call(const Function& function, const char* object, const char* first, const char* second) const {
    int reals = 0;
    return fmt::format("const_cast<{}.{}({})", object, function.name,
                       for_each_parameter(function, [&](const Parameter& parameter) -> std::string {
                         if (parameter.has(ray_)) return "in";
                         if (parameter.has(record_)) return "record";
                         if (is_real(parameter)) return reals++ == 0 ? first : second;
                         return &function == hit_ ? qualified(last_of(parameter)) + "(low, high)" : "p";
                       }));
  }
  /// scatter() answers by a colour and a ray, by a colour and a direction, or by a record of its own.
  std::string scatter_call() {
    if (!scatter_) return "return {};";
    std::vector<std::string> others;  // types of what it sets besides a ray
    std::string begin, end = "read_record<names>(part, one);";
    bool has_ray = false;
    const std::string arguments = for_each_parameter(*scatter_, [&](const Parameter& parameter) -> std::string {
      if (parameter.has(record_)) return "record";
      if (parameter.has(ray_) && !is_set(parameter)) return "in";
      has_ray = has_ray || parameter.has(ray_);
      if (parameter.has(ray_)) return "out";
      const bool real = is_real(parameter);
      draws_by_pdf_ = draws_by_pdf_ || real;
      std::string name = real ? "density" : others.empty() ? "part" : "to";
      const std::string type = real ? last_of(parameter) : qualified(last_of(parameter));
      begin += fmt::format("{} {}{{}}; ", type, name);
      if (!real) others.push_back(type);
      return name;
    });
    if (has_ray) end = "one.part = to_vector(part), one.to = ray_traits<ray>::parts(&out).to;";
    if (others.size() == 2) end = "one.part = to_vector(part), one.to = to_vector(to);";
    draws_by_pdf_ = draws_by_pdf_ || end[0] == 'r';
    return fmt::format("ray out = in; {}scatter_answer one; one.does = const_cast<material&>(m).{}({}); {} return one;",
                       begin, scatter_->name, arguments, end);
  }
  bool decodes_images() const {
    return std::any_of(outline_.functions.begin(), outline_.functions.end(), [](const Function& function) {
      return !function.name.starts_with("stbi") && contains(function.body, "stbi_loadf");
    });
  }
  /// A function that describes the members of an object by its class.
  std::string members_of(const std::string& root, const char* type) const {
    std::string text = fmt::format("  static void describe(const {}& o, description& to) {{\n", type);
    for (const OutlinedClass& one : outline_.classes)
      if (one.name != root && one.can_be_named && outline_.is_derived(one.name, root))
        text += fmt::format(
            "    if (typeid(o) == typeid({0})) return teller<names>::tell(dynamic_cast<const {0}&>(o), to);\n",
            one.qualified);
    return text + "  }\n";
  }
  /// What tells the members of the reader's classes.
  std::string members() const {
    std::string text;
    for (const OutlinedClass& one : outline_.classes) {
      if (!one.can_be_named) continue;
      text += "template <> struct members<" + one.qualified + "> {\n";
      text += "  template <class O, class F> static void each(O& o, const F& f) { ";
      for (const std::string& base : one.bases)
        if (const OutlinedClass* known = outline_.class_named(base); known && known->can_be_named)
          text += fmt::format("members<{}>::each(o, f); ", known->qualified);
      for (const std::string& member : one.members)
        text += fmt::format("f(\"{}\", {}, o.{}); ", key_of(member), role_of(member), member);
      text += "} };\n";
    }
    return text;
  }
  std::string tail() {
    const auto class_or = [&](const std::string& name, const char* absent) {
      return name.empty() ? absent : qualified(name);
    };
    const auto value_of = [&](const Function* function, const char* object) {
      return function ? "return to_vector(" + call(*function, object, "u", "v") + ");" : "return {};";
    };
    const std::string scatter = scatter_call();
    return "namespace tyndall_book {\n" + members() +
           fmt::format(R"(struct names {{
  using shape = {};
  using ray = {};
  using record = {};
  using material = {};
  using texture = {};
  static constexpr bool draws_by_pdf = {}, decodes_images = {};
  static bool hit(const shape& o, const ray& in, double low, double high, record& record) {{ return {}; }}
  static scatter_answer scatter(const material& m, const ray& in, record& record) {{ {} }}
  template <class P>
  static vector emitted(const material& m, const ray& in, record& record, double u, double v, const P& p) {{ {} }}
  template <class P> static vector value(const texture& t, double u, double v, const P& p) {{ {} }}
)",
                       qualified(shape_), qualified(ray_), qualified(record_), class_or(material_, "absent_class<'m'>"),
                       class_or(texture_, "absent_class<'t'>"), draws_by_pdf_, decodes_images(),
                       call(*hit_, "shape&>(o)", "low", "high"), scatter, value_of(emitted_, "material&>(m)"),
                       value_of(value_, "texture&>(t)")) +
           members_of(shape_, "shape") + members_of(material_, "material") + members_of(texture_, "texture") +
           R"(};
template <class C> void describe_camera(const C& camera, description& to) { teller<names>::tell(camera, to); }
void take_over() {
  const program_functions functions = replies<names>::functions();
  serve(&functions);
}
}
)";
  }

  const std::string& text_;
  const ProgramOutline& outline_;
  /// Classes that play these roles, whatever their names are; "": there is none. Then their functions.
  std::string shape_, ray_, record_, material_, texture_;
  const Function *hit_ = nullptr, *scatter_ = nullptr, *emitted_ = nullptr, *value_ = nullptr;
  std::multimap<std::size_t, std::string> insertions_;
  bool has_camera_ = false, has_colour_ = false, draws_by_pdf_ = false;
};

}  // namespace

InsertedCalls insert_calls(const std::string& text, const ProgramOutline& outline, bool reads_world) {
  return Inserter(text, outline).run(reads_world);
}

}  // namespace tyndall
