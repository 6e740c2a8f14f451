#include "app/book/source_text.h"

#include "core/base/text.h"

#include <algorithm>
#include <cctype>
#include <regex>

namespace tyndall {
namespace {

bool is_name_char(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

bool is_access(const std::string& name) {
  return name == "public" || name == "protected" || name == "private" || name == "virtual";
}

/// "1.0,0.7,1" as JSON's [1,0.7,1]; nothing if these are not three plain numbers.
std::optional<std::string> colour_json(const std::string& list) {
  std::string json;
  int count = 0;
  for (std::size_t at = 0; at <= list.size(); ++count) {
    const std::size_t end = std::min(list.find(',', at), list.size());
    std::string name = list.substr(at, end - at);
    std::erase_if(name, [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; });
    if (!name.empty() && name.back() == 'f') name.pop_back();
    double value = 0;
    if (!number_from_text(name, value) || !(value >= 0)) return {};
    json += (count > 0 ? "," : "") + number_text(value);
    at = end + 1;
  }
  return count == 3 ? std::optional("[" + json + "]") : std::nullopt;
}

/// The text with its constants `color white = color(1, 1, 1);` written out where they are used.
std::string with_colours_written_out(std::string text) {
  static const std::regex constant(
      R"((?:color|vec3|Color|Vec3|auto)\s+(\w+)\s*(?:=\s*(?:color|vec3|Color|Vec3)\s*)?[({]([^(){}]*)[)}]\s*;)");
  std::map<std::string, std::string> values;
  for (std::sregex_iterator at(text.begin(), text.end(), constant), end; at != end; ++at)
    if (colour_json((*at)[2].str())) values[(*at)[1].str()] = "color(" + (*at)[2].str() + ")";
  for (const auto& [name, value] : values) text = std::regex_replace(text, std::regex("\\b" + name + "\\b"), value);
  return text;
}

/// Whether the text computes the weight as the books do, 0.5 * (y + 1), if it does so under that name.
bool is_usual_weight(const std::string& dense, const std::string& name) {
  if (!std::regex_search(dense, std::regex("(?:double|auto|float|const)" + name + "="))) return true;
  static const std::string sum = R"(\((?:\w|\(|\)|\.|->|::)*(?:y\(\)|y|\[1\])\+1(?:\.0*)?f?\))";
  const std::regex usual("(?:double|auto|float|const)" + name + "=(?:0?\\.50?f?\\*" + sum + "|" + sum +
                         "(?:\\*0?\\.50?f?|/2(?:\\.0*)?f?));");
  return std::regex_search(dense, usual);
}

/// The gradient that the text blends from bottom to top, as JSON; nothing: it does not, or in another way.
std::optional<std::string> gradient_of(const std::string& text) {
  std::string dense;
  for (const char c : with_colours_written_out(text))
    if (std::isspace(static_cast<unsigned char>(c)) == 0) dense += c;
  static const std::string colour = R"((?:color|vec3|Color|Vec3)\(([^()]*)\))";
  static const std::regex sum(R"(\(1(?:\.0*)?f?-(\w+)\)\*)" + colour + R"(\+\1\*)" + colour);
  static const std::regex call(R"((?:lerp|mix)\()" + colour + "," + colour + R"(,(\w+)\))");
  std::smatch found;
  std::string weight, at_bottom, at_top;
  if (std::regex_search(dense, found, sum))
    weight = found[1], at_bottom = found[2], at_top = found[3];
  else if (std::regex_search(dense, found, call))
    weight = found[3], at_bottom = found[1], at_top = found[2];
  const auto bottom = colour_json(at_bottom), top = colour_json(at_top);
  if (!bottom || !top || !is_usual_weight(dense, weight)) return {};
  return R"({"type":"gradient","bottom":)" + *bottom + R"(,"top":)" + *top + "}";
}

/// The books' classes. A header that defines one takes the place of ours.
constexpr std::string_view book_classes[] = {"aabb",
                                             "box",
                                             "bvh_node",
                                             "camera",
                                             "checker_texture",
                                             "color",
                                             "constant_medium",
                                             "constant_texture",
                                             "cosine_pdf",
                                             "dielectric",
                                             "diffuse_light",
                                             "flip_face",
                                             "flip_normals",
                                             "hitable",
                                             "hitable_list",
                                             "hit_record",
                                             "hittable",
                                             "hittable_list",
                                             "hittable_pdf",
                                             "image_texture",
                                             "interval",
                                             "isotropic",
                                             "lambertian",
                                             "material",
                                             "metal",
                                             "mixture_pdf",
                                             "moving_sphere",
                                             "noise_texture",
                                             "onb",
                                             "pdf",
                                             "perlin",
                                             "point3",
                                             "quad",
                                             "ray",
                                             "rotate_y",
                                             "rtw_image",
                                             "scatter_record",
                                             "solid_color",
                                             "sphere",
                                             "sphere_pdf",
                                             "texture",
                                             "translate",
                                             "vec3",
                                             "xy_rect",
                                             "xz_rect",
                                             "yz_rect"};

}  // namespace

std::vector<Include> includes_of(std::string_view text) {
  std::vector<Include> found;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::size_t at = begin;
    const auto skip_blanks = [&] {
      while (at < end && is_blank(text[at])) ++at;
    };
    const auto skip = [&](std::string_view name) {
      skip_blanks();
      const bool there = text.substr(at, std::min(name.size(), end - at)) == name;
      if (there) at += name.size();
      return there;
    };
    if (skip("#") && skip("include")) {
      skip_blanks();
      const bool quoted = at < end && text[at] == '"', angled = at < end && text[at] == '<';
      const std::size_t close = quoted || angled ? text.find(quoted ? '"' : '>', at + 1) : std::string_view::npos;
      if (close < end) found.push_back({begin, end, std::string(text.substr(at + 1, close - at - 1)), quoted});
    }
    begin = end + 1;
  }
  return found;
}

std::string without_comments(std::string_view text) {
  std::string out(text);
  char inside = 0;  // '/': to the end of the line; '*': to the closing sign; '"' or '\'': a string
  for (std::size_t at = 0; at < out.size(); ++at) {
    const char c = out[at], next = at + 1 < out.size() ? out[at + 1] : '\0';
    const bool in_comment = inside == '/' || inside == '*';
    const bool closes = (c == '\n' && inside != '*') || (!in_comment && inside != 0 && c == inside);
    if (inside == 0 && c == '/' && (next == '/' || next == '*')) {
      inside = next;
      out[at] = out[at + 1] = ' ';
      ++at;
    } else if (inside == '*' && c == '*' && next == '/') {
      out[at] = out[at + 1] = ' ';
      ++at;
      inside = 0;
    } else if (closes) {
      inside = 0;
    } else if (in_comment) {
      if (c != '\n') out[at] = ' ';
    } else if (inside != 0 && c == '\\') {
      ++at;
    } else if (inside == 0 && (c == '"' || (c == '\'' && (at == 0 || !is_name_char(out[at - 1]))))) {
      inside = c;
    }
  }
  return out;
}

std::string key_of(std::string_view name) {
  name.remove_prefix(std::min(name.find_last_of("/\\") + 1, name.size()));
  name = name.substr(0, name.find_last_of('.'));
  std::string key;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)))
      key += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return key;
}

std::vector<std::string> tokens_of(std::string_view text) {
  std::vector<std::string> tokens;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = at;
    if (is_name_char(text[at])) {
      while (at < text.size() && (is_name_char(text[at]) || text[at] == '.')) ++at;
      tokens.emplace_back(text.substr(begin, at - begin));
    } else if (text[at] == '"') {
      for (++at; at < text.size() && text[at] != '"' && text[at] != '\n'; ++at)
        if (text[at] == '\\') ++at;
      ++at;
    } else {
      if (std::isspace(static_cast<unsigned char>(text[at])) == 0) tokens.emplace_back(1, text[at]);
      ++at;
    }
  }
  return tokens;
}

std::map<std::string, std::string> classes_of(std::string_view text) {
  std::map<std::string, std::string> classes;
  const std::vector<std::string> tokens = tokens_of(text);
  for (std::size_t k = 0; k + 2 < tokens.size(); ++k) {
    if ((tokens[k] != "class" && tokens[k] != "struct") || (k > 0 && tokens[k - 1] == "enum")) continue;
    std::size_t at = k + 2;
    if (tokens[at] == "final") ++at;
    std::string base;
    for (bool bases = at < tokens.size() && tokens[at] == ":"; bases && ++at < tokens.size() && tokens[at] != "{";)
      if (base.empty() && !is_access(tokens[at]) && is_name_char(tokens[at][0])) base = tokens[at];
    if (at < tokens.size() && tokens[at] == "{") classes[tokens[k + 1]] = base;
  }
  return classes;
}

std::vector<std::string> constants_of(std::string_view text) {
  std::vector<std::string> names;
  const std::vector<std::string> tokens = tokens_of(text);
  int depth = 0;
  for (std::size_t k = 0; k + 1 < tokens.size(); ++k) {
    const bool typed = k > 0 && (tokens[k - 1] == "double" || tokens[k - 1] == "float" || tokens[k - 1] == "auto");
    if (depth == 0 && typed && (tokens[k + 1] == "=" || tokens[k + 1] == "{")) names.push_back(tokens[k]);
    if (tokens[k] == "{") ++depth;
    if (tokens[k] == "}") --depth;
  }
  return names;
}

std::vector<std::string> strings_of(std::string_view text) {
  std::vector<std::string> strings;
  for (std::size_t at = text.find('"'); at < text.size(); at = text.find('"', at + 1)) {
    const std::size_t end = text.find_first_of("\"\n", at + 1);
    if (end == std::string_view::npos) break;
    if (text[end] == '"') strings.emplace_back(text.substr(at + 1, end - at - 1));
    at = end;
  }
  return strings;
}

bool has_name(std::string_view text, std::string_view name) {
  for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || !is_name_char(text[at - 1])) && (end == text.size() || !is_name_char(text[end]))) return true;
  }
  return false;
}

std::vector<std::string> random_options(const std::string& text) {
  if (has_name(text, "random_device")) return {};  // other numbers each time
  for (const char* engine : {"mt19937", "mt19937_64"}) {
    if (!has_name(text, engine)) continue;
    std::vector<std::string> options{"-DTYNDALL_BOOK_ENGINE=std::" + std::string(engine)};
    std::smatch seed;
    if (std::regex_search(text, seed, std::regex(std::string(engine) + R"(\s+\w+\s*[({]\s*(\d+)u?\s*[)}])")))
      options.push_back("-DTYNDALL_BOOK_SEED=" + seed[1].str());
    return options;
  }
  const bool only_drand48 = has_name(text, "drand48") && !has_name(text, "rand");
  return only_drand48 ? std::vector<std::string>{"-DTYNDALL_BOOK_DRAND48"} : std::vector<std::string>{};
}

std::optional<std::string> sky_of(const std::string& text) {
  static const std::regex member(R"((?:color|vec3|Color|Vec3|colour)\s+background(?:_color|Color)?\s*[;={])");
  const bool is_member = std::regex_search(text, member);
  const auto gradient = gradient_of(text);
  if (is_member && gradient) return {};     // either may be what rays see
  return is_member ? "[0,0,0]" : gradient;  // a member is black until main() sets it
}

std::string book_class(const std::string& name) {
  const std::string key = key_of(name);
  for (const std::string_view one : book_classes)
    if (key_of(one) == key) return std::string(one);
  for (const std::string_view other : {"vector3", "vec3d", "vec3f", "vector3d", "vector3f"})
    if (key == other) return "vec3";
  if (key == "point") return "point3";
  if (key == "colour" || key == "rgb") return "color";
  return "";
}

}  // namespace tyndall
