#include "core/base/text.h"
#include "core/scene/json_tree.h"

namespace tyndall {
namespace {

constexpr std::size_t width = 150;

/// Whether a member is a list of textures, materials or objects: these get a line each, however short they are.
bool stays_open(const JsonMember& member) {
  const auto* array = std::get_if<JsonArray>(&member.value.value);
  const auto* object = std::get_if<JsonObject>(&member.value.value);
  const bool listed = member.key == "textures" || member.key == "materials" || member.key == "objects";
  return listed && ((array && !array->empty()) || (object && !object->empty()));
}

/// Appends the value in one line; false as soon as the line is full or the value may not be on one.
bool print_line(const JsonValue& json, std::string& line, std::size_t limit) {
  if (line.size() > limit) return false;
  if (const auto* array = std::get_if<JsonArray>(&json.value)) {
    line += '[';
    for (std::size_t i = 0; i < array->size(); ++i) {
      if (i) line += ", ";
      if (!print_line((*array)[i], line, limit)) return false;
    }
    line += ']';
  } else if (const auto* object = std::get_if<JsonObject>(&json.value)) {
    if (object->empty()) line += '{';
    for (const JsonMember& member : *object) {
      line += (&member == object->data() ? "{ " : ", ") + in_quotes(member.key) + ": ";
      if (stays_open(member) || !print_line(member.value, line, limit)) return false;
    }
    line += object->empty() ? "}" : " }";
  } else if (const auto* text = std::get_if<std::string>(&json.value)) {
    line += in_quotes(*text);
  } else if (const auto* number = std::get_if<double>(&json.value)) {
    line += number_text(*number);
  } else {
    line += std::get_if<bool>(&json.value) ? (std::get<bool>(json.value) ? "true" : "false") : "null";
  }
  return line.size() <= limit;
}

/// Appends the value; its first line begins at `column` and its further lines are indented.
void print(const JsonValue& json, std::string& out, std::size_t indent, std::size_t column, bool open) {
  const auto* array = std::get_if<JsonArray>(&json.value);
  const auto* object = std::get_if<JsonObject>(&json.value);
  const bool is_leaf = !array && !object;
  std::string line;
  // The 1 keeps a place for a comma after the value.
  const std::size_t limit = is_leaf ? line.max_size() : width - std::min(width, column + 1);
  if ((is_leaf || !open) && print_line(json, line, limit)) {
    out += line;
    return;
  }
  const std::string begin = "\n" + std::string(indent + 2, ' ');
  const std::size_t count = array ? array->size() : object->size();
  out += array ? '[' : '{';
  for (std::size_t i = 0; i < count; ++i) {
    out += i ? "," + begin : begin;
    if (array) {
      print((*array)[i], out, indent + 2, indent + 2, false);
      continue;
    }
    const JsonMember& member = (*object)[i];
    const std::string key = in_quotes(member.key) + ": ";
    out += key;
    print(member.value, out, indent + 2, indent + 2 + key.size(), stays_open(member));
  }
  out += '\n' + std::string(indent, ' ') + (array ? ']' : '}');
}

}  // namespace

std::string print_json(const JsonValue& root) {
  std::string out;
  print(root, out, 0, 0, true);
  return out + '\n';
}

std::string print_members(const JsonObject& root) {
  std::string out;
  for (const JsonMember& member : root) {
    out += (out.empty() ? "{\n  " : ",\n  ") + in_quotes(member.key) + ": ";
    print_line(member.value, out, out.max_size());
  }
  return out + "\n}\n";
}

}  // namespace tyndall
