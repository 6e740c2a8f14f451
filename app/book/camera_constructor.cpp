#include "app/book/camera_constructor.h"

#include "app/book/source_text.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>
#include <vector>

namespace tyndall {
namespace {

/// A member of our camera, and a name of a parameter for it, as key_of() has it.
struct Member {
  std::string_view key, type, name;
};
constexpr Member members[] = {{"aspectratio", "double", "aspect_ratio"},
                              {"aspect", "double", "aspect_ratio"},
                              {"imagewidth", "int", "image_width"},
                              {"width", "int", "image_width"},
                              {"imageheight", "int", "image_height"},
                              {"height", "int", "image_height"},
                              {"samplesperpixel", "int", "samples_per_pixel"},
                              {"samples", "int", "samples_per_pixel"},
                              {"spp", "int", "samples_per_pixel"},
                              {"numsamples", "int", "samples_per_pixel"},
                              {"maxdepth", "int", "max_depth"},
                              {"maxbounces", "int", "max_depth"},
                              {"bounces", "int", "max_depth"},
                              {"depth", "int", "max_depth"},
                              {"vfov", "double", "vfov"},
                              {"fov", "double", "vfov"},
                              {"verticalfov", "double", "vfov"},
                              {"fieldofview", "double", "vfov"},
                              {"lookfrom", "point3", "lookfrom"},
                              {"lookingfrom", "point3", "lookfrom"},
                              {"eye", "point3", "lookfrom"},
                              {"position", "point3", "lookfrom"},
                              {"lookat", "point3", "lookat"},
                              {"lookto", "point3", "lookat"},
                              {"lookingat", "point3", "lookat"},
                              {"target", "point3", "lookat"},
                              {"vup", "vec3", "vup"},
                              {"up", "vec3", "vup"},
                              {"viewup", "vec3", "vup"},
                              {"worldup", "vec3", "vup"},
                              {"defocusangle", "double", "defocus_angle"},
                              {"focusdist", "double", "focus_dist"},
                              {"focusdistance", "double", "focus_dist"},
                              {"background", "color", "background"},
                              {"backgroundcolor", "color", "background"}};

const Member* member_of(const std::string& parameter) {
  for (const Member& one : members)
    if (one.key == key_of(parameter)) return &one;
  return nullptr;
}

const Member* member_meant_by(const std::string& name) {
  return member_of(name.starts_with("m_") ? name.substr(2) : name);
}

/// How many letters must be put in, left out or changed to make one text of the other.
std::size_t letters_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t k = 0; k <= b.size(); ++k) row[k] = k;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t k = 1; k <= b.size(); ++k) {
      const std::size_t change = diagonal + (a[i - 1] == b[k - 1] ? 0 : 1);
      diagonal = std::exchange(row[k], std::min({change, row[k] + 1, row[k - 1] + 1}));
    }
  }
  return row[b.size()];
}

/// The member that is meant by a misspelt or longer name: ascpect_ratio, sample_per_pix, max_ray_depth; null: none.
const Member* member_like(const std::string& name) {
  constexpr std::size_t shortest = 6, letters_for_a_mistake = 5;
  const std::string key = key_of(name);
  const auto has = [&key](const char* word) { return key.find(word) != std::string::npos; };
  if (key.starts_with("sample") && has("pix")) return member_of("samples_per_pixel");
  if (key.starts_with("max") && key.ends_with("depth")) return member_of("max_depth");
  for (const Member& one : members) {
    if (key.size() < shortest || key[0] != one.key[0]) continue;
    if (letters_between(key, one.key) <= key.size() / letters_for_a_mistake) return &one;
  }
  return nullptr;
}

/// The names of the parameters in the list that opens at that token.
std::vector<std::string> parameters_at(const std::vector<std::string>& tokens, std::size_t open) {
  std::vector<std::string> names{""};
  int depth = 0;
  bool in_default = false;
  for (std::size_t at = open; at < tokens.size(); ++at) {
    const std::string& token = tokens[at];
    if (token == "(" || token == "{") ++depth;
    if ((token == ")" || token == "}") && --depth == 0) break;
    if (token == "=" || token == "{") in_default = true;
    if (token == "," && depth == 1) {
      names.emplace_back();
      in_default = false;
    } else if (!in_default && token != "(" && token != "&") {
      names.back() = token;
    }
  }
  return names;
}

/// The token behind the body of the constructor whose parameters begin at `open`; the end of all for one that has no
/// body here.
std::size_t end_of_constructor(const std::vector<std::string>& tokens, std::size_t open) {
  int depth = 0;
  for (std::size_t at = open; at < tokens.size(); ++at) {
    if (tokens[at] == ";" && depth == 0) break;
    if (tokens[at] == "(" || tokens[at] == "{") ++depth;
    const bool closes = (tokens[at] == ")" || tokens[at] == "}") && --depth == 0;
    const bool ends = at + 1 >= tokens.size() || (tokens[at + 1] != "," && tokens[at + 1] != "{");
    if (closes && tokens[at] == "}" && ends) return at + 1;
  }
  return tokens.size();
}

/// Whether the constructor copies the parameter, as it is, to a member that means the same: "vfov_(fov)", "this->vfov =
/// fov;". One that converts it, such as "vfov(radians(fov))", means something else by it.
bool is_copied(const std::vector<std::string>& tokens, std::size_t begin, std::size_t end, const std::string& name,
               const Member& member) {
  for (std::size_t at = begin + 3; at + 1 < end; ++at) {
    if (tokens[at] != name) continue;
    const std::string &before = tokens[at - 1], &to = tokens[at - 2], &lead = tokens[at - 3], &behind = tokens[at + 1];
    const bool initialises =
        (before == "(" || before == "{") && (lead == ":" || lead == ",") && (behind == ")" || behind == "}");
    const bool assigns = before == "=" && behind == ";";
    const Member* meant = member_meant_by(to);
    if ((initialises || assigns) && meant && meant->name == member.name) return true;
  }
  return false;
}

/// Whether the token may stand in an expression of plain numbers.
bool is_plain(const std::string& token) {
  const std::string known = book_class(token);
  if (known == "vec3" || known == "point3" || known == "color") return true;
  const char first = token[0];
  return std::isdigit(static_cast<unsigned char>(first)) != 0 ||
         std::string_view("+-*/(),.{}").find(first) != std::string_view::npos;
}

/// "(0,0,-1)" of "= point3(0, 0, -1)" or of "{0, 0, -1}", which begins at that token; "": it is no plain number or
/// vector.
std::string plain_value(const std::vector<std::string>& tokens, std::size_t at) {
  std::string value;
  if (tokens[at] == "=") ++at;
  for (; at < tokens.size() && tokens[at] != ";"; ++at) {
    if (!is_plain(tokens[at])) return "";
    const char first = tokens[at][0];
    if (std::isalpha(static_cast<unsigned char>(first)) == 0)
      value += first == '{' ? "(" : first == '}' ? ")" : tokens[at];
  }
  return value;
}

}  // namespace

std::string camera_alias(const std::string& camera, const std::string& name) {
  const Member* known = member_meant_by(name);
  const Member* member = known ? known : member_like(name);
  if (!member || member->name == "image_height") return "";
  const std::vector<std::string> tokens = tokens_of(camera);
  bool has_it = false;
  int depth = 0;
  for (std::size_t at = 0; at + 1 < tokens.size(); ++at) {
    if (tokens[at] == "{" || tokens[at] == "(") ++depth;
    if (tokens[at] == "}" || tokens[at] == ")") --depth;
    const bool is_declared = depth == 1 && std::string_view(";,={").find(tokens[at + 1]) != std::string_view::npos;
    if (!is_declared) continue;
    has_it = has_it || tokens[at] == name;
    const Member* other = tokens[at] == name ? nullptr : member_meant_by(tokens[at]);
    if (other && other->name == member->name) return "";  // the member itself, so that this one is another
  }
  if (!has_it) return "";
  const std::string type = member->type == "color" ? "tyndall_book::given_color" : std::string(member->type);
  return type + "& " + name + " = " + std::string(member->name) + ";";
}

std::string camera_defaults(const std::string& code) {
  const std::vector<std::string> tokens = tokens_of(code);
  std::string values;
  int depth = 0;
  bool in_camera = false;
  for (std::size_t at = 1; at + 1 < tokens.size(); ++at) {
    if (depth == 0 && (tokens[at - 1] == "class" || tokens[at - 1] == "struct"))
      in_camera = key_of(tokens[at]) == "camera";
    if (tokens[at] == "{" || tokens[at] == "(") ++depth;
    if (tokens[at] == "}" || tokens[at] == ")") --depth;
    const bool has_value = in_camera && depth == 1 && (tokens[at + 1] == "=" || tokens[at + 1] == "{");
    const Member* member = has_value ? member_meant_by(tokens[at]) : nullptr;
    if (!member || member->name == "image_height") continue;  // the height is computed
    std::string value = plain_value(tokens, at + 1);
    if (value.empty() || (value[0] == '(' && std::count(value.begin(), value.end(), '(') > 1)) continue;
    if (value[0] != '(') value = "(" + value + ")";
    values += std::string(member->name) + " = " + std::string(member->type) + value + "; ";
  }
  return values.empty() ? "" : "#define TYNDALL_BOOK_CAMERA_DEFAULTS " + values + "\n";
}

std::string camera_constructor(const std::string& code) {
  const std::vector<std::string> tokens = tokens_of(code);
  for (std::size_t at = 1; at + 1 < tokens.size(); ++at) {
    if (key_of(tokens[at]) != "camera" || tokens[at + 1] != "(" || tokens[at - 1] == "~") continue;
    std::string parameters, body;
    bool has_width = false, is_known = true;
    const std::size_t end = end_of_constructor(tokens, at + 1);
    for (const std::string& name : parameters_at(tokens, at + 1)) {
      const Member* member = member_of(name);
      is_known = member && is_copied(tokens, at + 1, end, name, *member);
      if (!is_known) break;
      const std::string value = "value_" + std::to_string(body.size());
      has_width = has_width || member->name == "image_width";
      parameters += (parameters.empty() ? "" : ", ") + std::string(member->type) + " " + value;
      body += std::string(member->name) + " = " + value + "; ";
    }
    if (is_known && has_width)
      return "#define TYNDALL_BOOK_CAMERA_PARAMETERS " + parameters + "\n#define TYNDALL_BOOK_CAMERA_BODY " + body +
             "\n";
  }
  return "";
}

}  // namespace tyndall
