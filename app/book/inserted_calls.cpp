#include "app/book/inserted_calls.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>

namespace tyndall {
namespace {

bool begins_with(const std::string& text, const char* with) { return text.rfind(with, 0) == 0; }
bool is_number(const Parameter& parameter) {
  return parameter.identifiers.size() == 1 && !parameter.pointer &&
         std::find_if(parameter.type.begin(), parameter.type.end(), [](char c) { return c == '<' || c == '*'; }) ==
             parameter.type.end();
}
bool is_integer(const Parameter& parameter) {
  const std::string& last = parameter.identifiers.empty() ? parameter.type : parameter.identifiers.back();
  return last == "int" || last == "long" || last == "unsigned" || last == "short" || last == "size_t" ||
         last.find("int") != std::string::npos;
}
bool is_real(const Parameter& parameter) {
  const std::string& last = parameter.identifiers.empty() ? parameter.type : parameter.identifiers.back();
  return last == "double" || last == "float" || last == "real" || last == "Real" || last == "Float";
}

/// The roles that the reader's classes and functions play, whatever their names are.
struct Roles {
  std::string shape, ray, record, material, texture;  ///< names of classes; "": there is none
  const Function *hit = nullptr, *scatter = nullptr, *emitted = nullptr, *value = nullptr;
};

class Inserter {
 public:
  Inserter(const std::string& text, const ProgramOutline& outline) : text_(text), outline_(outline) {}

  InsertedCalls run(bool reads_world) {
    find_roles();
    if (roles_.ray.empty()) return {"", "has no function hit() of a class of shapes, which rays could be asked for"};
    for (const Function& function : outline_.functions)
      if (!function.body.empty() && is_camera(function)) hook_camera(function);
    for (const Function& function : outline_.functions)
      if (!function.body.empty()) hook(function);
    if (!has_colour_)
      for (const Function& function : outline_.functions)
        if (!function.body.empty()) hook_without_world(function);
    if (!has_colour_) return {"", "has no function that computes the colour of a ray in a world"};
    for (const PictureHead& head : outline_.heads) hook_head(head);
    return {
        with_insertions() +
            (reads_world ? tail() : "\nnamespace tyndall_book {\nvoid take_over(session& s) { take_samples(s); }\n}\n"),
        ""};
  }

 private:
  void insert(const char* at, const std::string& call) { insertions_.emplace(at - text_.data(), call); }
  std::string with_insertions() const {
    std::string made;
    std::size_t from = 0;
    for (const auto& [at, call] : insertions_) {
      const auto end = static_cast<std::size_t>(at);
      made += text_.substr(from, end - from) + call;
      from = end;
    }
    return made + text_.substr(from);
  }
  const OutlinedClass* class_named(const std::string& name) const {
    for (const OutlinedClass& one : outline_.classes)
      if (one.name == name) return &one;
    return nullptr;
  }
  std::string qualified(const std::string& name) const {
    const OutlinedClass* known = class_named(name);
    return known ? known->qualified() : name;
  }
  std::string owner_of(const Function& function) const {
    return function.owner < 0 ? "" : outline_.classes[static_cast<std::size_t>(function.owner)].name;
  }
  bool is_root(const Function& function) const {
    return function.owner >= 0 && function.is_virtual &&
           outline_.classes[static_cast<std::size_t>(function.owner)].bases.empty();
  }

  void find_roles() {
    for (const Function& function : outline_.functions) {
      const std::string key = key_of(function.name);
      if (!is_root(function)) continue;
      if ((begins_with(key, "hit") || begins_with(key, "intersect")) && function.result == "bool" &&
          roles_.shape.empty())
        take_hit(function);
      if (begins_with(key, "scatter") && function.result == "bool" && roles_.material.empty())
        roles_.material = owner_of(function), roles_.scatter = &function;
    }
    for (const Function& function : outline_.functions) {
      if (!is_root(function)) continue;
      const std::string key = key_of(function.name);
      if (owner_of(function) == roles_.material && begins_with(key, "emit") && !roles_.emitted)
        roles_.emitted = &function;
      if (key_of(owner_of(function)).find("texture") != std::string::npos && function.parameters.size() >= 2 &&
          !roles_.value)
        roles_.texture = owner_of(function), roles_.value = &function;
    }
  }
  void take_hit(const Function& function) {
    std::string ray, record;
    for (const Parameter& parameter : function.parameters) {
      if (parameter.identifiers.empty() || !class_named(parameter.identifiers.back())) continue;
      if (key_of(parameter.identifiers.back()).find("ray") != std::string::npos && ray.empty())
        ray = parameter.identifiers.back();
      else if (!parameter.constant && parameter.reference)
        record = parameter.identifiers.back();
    }
    if (ray.empty() || record.empty()) return;
    roles_.shape = owner_of(function), roles_.ray = ray, roles_.record = record, roles_.hit = &function;
  }

  // The calls -------------------------------------------------------------------------------------------------------

  void hook(const Function& function) {
    const std::string owner = owner_of(function);
    if (function.result.empty() && outline_.is_derived(owner, roles_.texture) && !function.parameters.empty())
      insert(function.body.data() + 1, " ::tyndall_book::texture_made(this);");
    if (is_of_things(function) || function.result.empty()) return;
    if (is_camera(function)) return;
    const Parameter* world = world_of(function);
    if (world) hook_colour(function, world->name, world->name, true);
  }
  bool is_of_things(const Function& function) const {
    const std::string owner = owner_of(function);
    return outline_.is_derived(owner, roles_.shape) || outline_.is_derived(owner, roles_.material) ||
           owner == roles_.ray;
  }
  bool is_camera(const Function& function) const {
    if (is_of_things(function)) return false;
    if (key_of(function.name).find("ray") == std::string::npos || function.parameters.size() < 2) return false;
    const std::string result = function.result.substr(function.result.rfind(' ') + 1);
    if (result != roles_.ray && !result.ends_with(":" + roles_.ray)) return false;
    for (const Parameter& parameter : function.parameters)
      if (parameter.name.empty()) return false;
    return is_number(function.parameters[0]) && is_number(function.parameters[1]) &&
           !class_named(function.parameters[0].identifiers.back());
  }
  void hook_camera(const Function& function) {
    has_camera_ = true;
    const auto& parameters = function.parameters;
    std::string call = function.name + "(tyndall_a, tyndall_b";
    for (std::size_t k = 2; k < parameters.size(); ++k) call += ", " + parameters[k].name;
    const bool member = function.owner >= 0 && !function.is_static;
    insert(function.body.data() + 1, std::string(" if (::tyndall_book::is_watching()) ::tyndall_book::ray_wanted(") +
                                         (member ? "*this" : "0") + ", [=](auto tyndall_a, auto tyndall_b) { return " +
                                         call + "); }, " + parameters[0].name + ", " + parameters[1].name + ");");
  }
  const Parameter* world_of(const Function& function) const {
    const Parameter* world = nullptr;
    bool has_ray = false;
    for (const Parameter& parameter : function.parameters) {
      if (parameter.name.empty() || parameter.names(roles_.record)) return nullptr;
      has_ray = has_ray || parameter.names(roles_.ray);
      for (const std::string& name : parameter.identifiers)
        if (!world && outline_.is_derived(name, roles_.shape)) world = &parameter;
    }
    return has_ray && is_colour(function) ? world : nullptr;
  }
  static bool is_colour(const Function& function) {
    for (const char* other : {"bool", "void", "double", "float", "int", "auto"})
      if (function.result == other) return false;
    return !function.result.empty();
  }
  /// given: the parameter that is the world, else "".
  void hook_colour(const Function& function, const std::string& world, const std::string& given, bool is_given) {
    has_colour_ = true;
    std::string call = function.name + "(", ray, depth = "0";
    for (const Parameter& parameter : function.parameters) {
      std::string argument = parameter.name;
      if (parameter.names(roles_.ray) && ray.empty())
        ray = argument, argument = "tyndall_ray";
      else if (parameter.name == given)
        argument = "tyndall_world";
      else if (is_number(parameter) && is_integer(parameter) && depth == "0")
        depth = argument;
      call += (call.back() == '(' ? "" : ", ") + argument;
    }
    insert(function.body.data() + 1, " if (::tyndall_book::is_watching()) return ::tyndall_book::colour_wanted<" +
                                         qualified(roles_.shape) + ", " + (is_given ? "true, " : "false, ") +
                                         (has_camera_ ? "true" : "false") +
                                         ">([&](const auto& tyndall_ray, auto& tyndall_world, int) -> " +
                                         function.result + " { (void)tyndall_world; return " + call + "); }, " + ray +
                                         ", " + world + ", static_cast<int>(" + depth + "));");
  }
  /// A function of a ray alone, whose world is a member or a global object that it asks for hits.
  void hook_without_world(const Function& function) {
    bool has_ray = false;
    for (const Parameter& parameter : function.parameters) {
      if (parameter.name.empty() || parameter.names(roles_.record)) return;
      has_ray = has_ray || parameter.names(roles_.ray);
    }
    if (!has_ray || !is_colour(function) || is_of_things(function)) return;
    for (const std::string dot : {".", "->"}) {
      const std::string call = dot + roles_.hit->name;
      const std::size_t at = function.body.find(call + "(");
      if (at == std::string_view::npos) continue;
      std::size_t from = at;
      while (from > 0 && (std::isalnum(static_cast<unsigned char>(function.body[from - 1])) ||
                          std::string("_.>-").find(function.body[from - 1]) != std::string::npos))
        --from;
      if (from < at) return hook_colour(function, std::string(function.body.substr(from, at - from)), "", false);
    }
  }
  void hook_head(const PictureHead& head) {
    if (head.is_streamed) {
      insert(head.literal.data(), "::tyndall_book::head_text{");
      insert(head.literal.data() + head.literal.size(), "}");
      return;
    }
    for (const std::string_view size : head.sizes) {
      insert(size.data(), "::tyndall_book::head_size(");
      insert(size.data() + size.size(), ")");
    }
  }

  // The tail --------------------------------------------------------------------------------------------------------

  /// A world of the reader's base class, whose hit() is ours.
  std::string probe() const {
    const OutlinedClass& shape = *class_named(roles_.shape);
    std::string text = (shape.space.empty() ? "" : "namespace " + shape.space + " {\n") +
                       "struct tyndall_probe final : " + shape.name + " {\n";
    for (const Function& function : outline_.functions) {
      if (owner_of(function) != roles_.shape || !function.is_virtual ||
          (!function.is_pure && &function != roles_.hit) || function.name == roles_.shape)
        continue;
      std::string parameters, low = "0", high = "0", ray, record;
      int reals = 0, count = 0;
      for (const Parameter& parameter : function.parameters) {
        const std::string name = "tyndall_" + std::to_string(count++);
        parameters += (parameters.empty() ? "" : ", ") + parameter.type + " " + name;
        if (parameter.names(roles_.ray))
          ray = name;
        else if (parameter.names(roles_.record))
          record = name;
        else if (is_real(parameter))
          (reals++ == 0 ? low : high) = name;
        else
          low = name + ".min", high = name + ".max";
      }
      const std::string body =
          &function != roles_.hit
              ? "throw 0;"
              : fmt::format("return ::tyndall_book::probe_answer()(&{}, {}, {}, &{});", ray, low, high, record);
      const bool overrides = function.suffix.find("override") != std::string::npos;
      text += fmt::format("  {} {}({}){}{} {{ {} }}\n", function.result, function.name, parameters, function.suffix,
                          overrides ? "" : " override", body);
    }
    return text + "};\n" + (shape.space.empty() ? "" : "}\n");
  }
  /// The body of a function of ours that calls one of the reader's, whose parameters tell what they are.
  std::string hit_call() const {
    std::string arguments;
    int reals = 0;
    for (const Parameter& parameter : roles_.hit->parameters) {
      const bool real = is_real(parameter);
      const std::string argument = parameter.names(roles_.ray)      ? "r"
                                   : parameter.names(roles_.record) ? "record"
                                   : real                           ? (reals++ == 0 ? "low" : "high")
                                          : qualified(parameter.identifiers.back()) + "(low, high)";
      arguments += (arguments.empty() ? "" : ", ") + argument;
    }
    return "return const_cast<shape&>(o)." + roles_.hit->name + "(" + arguments + ");";
  }
  /// scatter() answers by a colour and a ray, by a colour and a direction, or by a record of its own.
  std::string scatter_call(bool& has_densities) const {
    if (!roles_.scatter) return "return {};";
    std::vector<std::string> others;  // types of what it sets besides a ray
    std::string arguments, begin, end = "read_record<names>(part, one); ";
    for (const Parameter& parameter : roles_.scatter->parameters) {
      const std::string last = parameter.identifiers.empty() ? parameter.type : qualified(parameter.identifiers.back());
      std::string argument = others.empty() ? "part" : "to";
      if (parameter.names(roles_.record)) {
        argument = "record";
      } else if (parameter.names(roles_.ray) && (parameter.constant || !parameter.reference)) {
        argument = "in";
      } else if (parameter.names(roles_.ray)) {
        argument = "out";
        end =
            "one.part = to_vector(part), one.to = ray_traits<ray>::direction(out), one.time = "
            "ray_traits<ray>::time(out); ";
      } else if (is_real(parameter)) {
        argument = "density", begin += last + " density{}; ", has_densities = true;
      } else {
        begin += fmt::format("{} {}{{}}; ", last, argument);
        others.push_back(last);
      }
      arguments += (arguments.empty() ? "" : ", ") + argument;
    }
    if (others.size() == 2) end = "one.part = to_vector(part), one.to = to_vector(to); ";
    if (end[0] == 'r') has_densities = true;
    return "ray out = in; " + begin + "scattered one; one.does = const_cast<material&>(m)." + roles_.scatter->name +
           "(" + arguments + "); " + end + "return one;";
  }
  std::string value_call(const Function& function, const std::string& object) const {
    std::string arguments;
    int reals = 0;
    for (const Parameter& parameter : function.parameters) {
      const std::string argument = parameter.names(roles_.ray)      ? "in"
                                   : parameter.names(roles_.record) ? "record"
                                   : is_real(parameter)             ? (reals++ == 0 ? "u" : "v")
                                                                    : "p";
      arguments += (arguments.empty() ? "" : ", ") + argument;
    }
    return "return to_vector(const_cast<" + object + "." + function.name + "(" + arguments + "));";
  }
  /// Whether it lets its library decode images.
  bool reads_linear_images() const {
    return std::any_of(outline_.functions.begin(), outline_.functions.end(), [](const Function& function) {
      return !begins_with(function.name, "stbi") && function.body.find("stbi_loadf") != std::string_view::npos;
    });
  }
  std::string with_class(const std::string& root, const char* type) const {
    std::string text =
        std::string("  template <class F> static void with_class(const ") + type + "& o, F&& f) {\n    (void)f;\n";
    for (const OutlinedClass& one : outline_.classes)
      if (one.name != root && !one.is_template && !one.name.empty() && outline_.is_derived(one.name, root))
        text += "    if (typeid(o) == typeid(" + one.qualified() + ")) return f(dynamic_cast<const " + one.qualified() +
                "&>(o));\n";
    return text + "    refuse(o, \"no such class in Tyndall\");\n  }\n";
  }
  std::string tail() const {
    const std::string material =
                          roles_.material.empty() ? "::tyndall_book::absent_material" : qualified(roles_.material),
                      texture = roles_.texture.empty() ? "::tyndall_book::absent_texture" : qualified(roles_.texture);
    bool has_densities = false;
    const std::string scatter = scatter_call(has_densities);
    return "\n# 1 \"tyndall/book/names\"\n" + probe() +
           "namespace tyndall_book {\nstruct names {\n  using shape = " + qualified(roles_.shape) +
           "; using ray = " + qualified(roles_.ray) + "; using record = " + qualified(roles_.record) +
           "; using material = " + material + "; using texture = " + texture + ";\n  using probe = " +
           (class_named(roles_.shape)->space.empty() ? "::" : "::" + class_named(roles_.shape)->space + "::") +
           "tyndall_probe;\n  static constexpr bool reads_linear_images = " +
           (reads_linear_images() ? "true" : "false") +
           ";\n  static constexpr bool has_densities = " + (has_densities ? "true" : "false") +
           ";\n  static bool hit(const shape& o, const ray& r, double low, double high, record& record) { " +
           hit_call() +
           " }\n  static scattered scatter(const material& m, const ray& in, record& record) { (void)m, (void)in, "
           "(void)record; " +
           scatter +
           " }\n  template <class P> static vector emitted(const material& m, const ray& in, record& record, double u, "
           "double v, const P& p) { (void)m, (void)in, (void)record, (void)u, (void)v, (void)p; " +
           (roles_.emitted ? value_call(*roles_.emitted, "material&>(m)") : "return {};") +
           " }\n  template <class P> static vector value(const texture& t, double u, double v, const P& p) { (void)t, "
           "(void)u, (void)v, (void)p; " +
           (roles_.value ? value_call(*roles_.value, "texture&>(t)") : "return {};") + " }\n" +
           with_class(roles_.shape, "shape") + with_class(roles_.material, "material") +
           with_class(roles_.texture, "texture") + "};\nvoid take_over(session& s) { take_over_world<names>(s); }\n}\n";
  }

  const std::string& text_;
  const ProgramOutline& outline_;
  Roles roles_;
  std::multimap<std::ptrdiff_t, std::string> insertions_;
  bool has_camera_ = false, has_colour_ = false;
};

}  // namespace

InsertedCalls insert_calls(const std::string& text, const ProgramOutline& outline, bool reads_world) {
  return Inserter(text, outline).run(reads_world);
}

}  // namespace tyndall
