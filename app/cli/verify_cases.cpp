#include "app/cli/verify.h"

#include "app/text/values.h"
#include "core/scene/json_values.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

namespace tyndall {
namespace {

const std::string& text_at(const JsonObject& object, const Place& at, const char* key, const char* what) {
  return string_at(member_at(object, at, key, what), {at, key}, what);
}

const JsonArray& list_at(const JsonObject& object, const Place& at, const char* key, const char* what) {
  return array_at(member_at(object, at, key, what), {at, key}, what);
}

/// A switch that is off where it is not given.
bool flag_of(const JsonObject& object, const Place& at, const char* key, const char* what) {
  const JsonValue* json = find(object, key);
  if (json && !std::holds_alternative<bool>(json->value)) fail({at, key}, describe(*json), what);
  return json && std::get<bool>(json->value);
}

/// Appends what is under "set".
void read_overrides(const JsonObject& object, const Place& at, std::vector<Override>& out) {
  const JsonValue* json = find(object, "set");
  if (!json) return;
  const Place here{at, "set"};
  const char* expected = "overrides of the scene, such as { \"/camera/vfov\": 20 }";
  for (const JsonMember& member : object_at(*json, here, expected)) {
    if (!member.key.starts_with('/')) fail({here, member.key}, "no JSON pointer", expected);
    out.push_back({member.key, print_json(member.value)});
  }
}

/// One case of a group, which is given as a case without its own values.
VerifyCase read_case(const JsonValue& json, const Place& at, const VerifyCase& group) {
  const JsonObject& object = object_at(json, at, "a case: { \"name\", \"set\", \"expected\" }");
  allow_keys(object, at, {"name", "set", "expected", "source"});
  VerifyCase out = group;
  out.name += "/" + text_at(object, at, "name", "the case's name");
  read_overrides(object, at, out.overrides);
  const Field expected{"expected", &VerifyCase::expected, any_number(), Slider{}, "", "mean radiance", true};
  read_field(object, at, expected, out);
  if (find(object, "source")) out.source = text_at(object, at, "source", "where the expected number is from");
  return out;
}

void read_group(const JsonValue& json, const Place& at, const std::filesystem::path& folder,
                std::vector<VerifyCase>& out) {
  const JsonObject& object = object_at(json, at, "a group of cases");
  allow_keys(object, at, {"name", "scene", "source", "set", "light_sampling", "chains", "cases"});
  VerifyCase group;
  group.name = text_at(object, at, "name", "the group's name");
  group.scene = folder / text_at(object, at, "scene", "the name of a scene file beside this one");
  group.source = text_at(object, at, "source", "where the expected numbers are from");
  group.requires_light_sampling =
      flag_of(object, at, "light_sampling", "true if chance alone does not find the lights, else false");
  group.requires_specular_paths =
      flag_of(object, at, "chains", "true if exact chains alone find the light, else false");
  read_overrides(object, at, group.overrides);
  const JsonArray& list = list_at(object, at, "cases", "the group's cases");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Place cases{at, "cases"};
    out.push_back(read_case(list[i], {cases, i}, group));
    const auto same_name = [&](const VerifyCase& other) { return other.name == out.back().name; };
    if (std::find_if(out.begin(), out.end() - 1, same_name) != out.end() - 1)
      fail({cases, i}, in_quotes(out.back().name) + " twice", "each name once");
  }
}

std::vector<VerifyCase> read_table(std::string_view text, const std::filesystem::path& folder) {
  const JsonDocument json = parse_json(text);
  const Place top;
  const JsonObject& object = object_at(json.root, top, "{ \"groups\": [ … ] }");
  allow_keys(object, top, {"groups"});
  const JsonArray& groups = list_at(object, top, "groups", "the groups of cases");
  std::vector<VerifyCase> cases;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const Place place{top, "groups"};
    read_group(groups[i], {place, i}, folder, cases);
  }
  return cases;
}

/// Groups and cases, for suggestions.
std::vector<std::string> all_names(const std::vector<VerifyCase>& cases) {
  std::set<std::string> names;
  for (const VerifyCase& c : cases) {
    names.insert(c.name);
    names.insert(c.name.substr(0, c.name.find('/')));
  }
  return {names.begin(), names.end()};
}

}  // namespace

std::vector<VerifyCase> read_verify_cases(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream)
    throw SceneError(file.string(), "a file that cannot be read",
                     "the table of cases (TYNDALL_ASSETS names the folder that has verify/)");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  try {
    return read_table(text, file.parent_path());
  } catch (const ParseError& error) {
    throw SceneError(file.string(), error.where, error.found, error.expected);
  }
}

std::vector<VerifyCase> chosen_cases(const std::vector<VerifyCase>& cases, const std::vector<std::string>& names) {
  const auto begins = [](const VerifyCase& c, const std::string& name) { return c.name.starts_with(name); };
  for (const std::string& name : names)
    if (std::none_of(cases.begin(), cases.end(), [&](const VerifyCase& c) { return begins(c, name); })) {
      const std::string hint = suggestion(name, all_names(cases));
      throw UsageError("found no case " + in_quotes(name) + hint + ", expected the beginning of a case's name");
    }
  std::vector<VerifyCase> chosen;
  for (const VerifyCase& c : cases)
    if (names.empty() || std::any_of(names.begin(), names.end(), [&](const auto& name) { return begins(c, name); }))
      chosen.push_back(c);
  return chosen;
}

}  // namespace tyndall
