#include "app/book/camera_constructor.h"

#include "app/book/source_text.h"

#include <string_view>
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
                              {"maxdepth", "int", "max_depth"},
                              {"depth", "int", "max_depth"},
                              {"vfov", "double", "vfov"},
                              {"fov", "double", "vfov"},
                              {"verticalfov", "double", "vfov"},
                              {"lookfrom", "point3", "lookfrom"},
                              {"lookat", "point3", "lookat"},
                              {"vup", "vec3", "vup"},
                              {"up", "vec3", "vup"},
                              {"viewup", "vec3", "vup"},
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
    const Member* meant = member_of(to.starts_with("m_") ? to.substr(2) : to);
    if ((initialises || assigns) && meant && meant->name == member.name) return true;
  }
  return false;
}

}  // namespace

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
