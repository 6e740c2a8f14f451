#include "core/base/text.h"
#include "core/scene/json_syntax.h"
#include "core/scene/json_tree.h"
#include "core/scene/place.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace tyndall {
namespace {

/// Most values of a document. A real scene of 256 MiB has fewer; as a tree, this many take about 2 GB of memory.
constexpr std::size_t max_values = std::size_t(1) << 25;

/// Members of most objects, such as spheres, and values of most arrays, which are points and colours. Room for just so
/// many is made at first, because scenes of a million objects consist of little else.
constexpr std::size_t usual_members = 4, usual_values = 3;

/// Receives the parser's events, builds the tree and refuses what the format refuses, before it is built.
class TreeBuilder {
 public:
  using Json = nlohmann::json;

  TreeBuilder(std::string_view text, std::pmr::memory_resource* memory) : text_(text), memory_(memory) {}

  JsonValue root;
  std::optional<ParseError> failure;

  bool null() { return put(nullptr); }
  bool boolean(bool value) { return put(value); }
  bool number_integer(Json::number_integer_t value) { return put(static_cast<double>(value)); }
  bool number_unsigned(Json::number_unsigned_t value) { return put(static_cast<double>(value)); }
  bool number_float(double value, const std::string&) { return put(value); }
  bool string(std::string& value) { return put(std::move(value)); }
  bool binary(Json::binary_t&) { return false; }  // never called: JSON text has no binary values
  bool start_object(std::size_t) { return open(JsonObject(memory_)); }
  bool start_array(std::size_t) { return open(JsonArray(memory_)); }
  bool end_array() { return close(); }

  bool key(std::string& value) {
    auto& object = std::get<JsonObject>(open_.back()->value);
    if (object.empty()) object.reserve(usual_members);
    object.push_back({std::move(value), {}});
    return true;
  }

  bool end_object() {
    const auto& object = std::get<JsonObject>(open_.back()->value);
    std::vector<std::string_view> keys;
    keys.reserve(object.size());
    for (const JsonMember& member : object) keys.push_back(member.key);
    std::sort(keys.begin(), keys.end());
    const auto twice = std::adjacent_find(keys.begin(), keys.end());
    if (twice == keys.end()) return close();
    const std::string holder = where(open_.size() - 1);
    return refuse({holder + "/" + pointer_step(*twice), "this key twice", "each key once"});
  }

  bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception& error) {
    if (error.id == 406)
      return refuse({open_.empty() ? "/" : where(open_.size()), token, "a number within the range of a double"});
    return refuse(syntax_error(text_, position, error.what()));
  }

 private:
  std::string_view text_;
  std::pmr::memory_resource* memory_;
  std::vector<JsonValue*> open_;  ///< arrays and objects around the next value, from the outermost to the innermost
  std::size_t values_ = 0;

  bool refuse(ParseError why) {
    failure = std::move(why);
    return false;
  }

  /// Where the next value goes.
  JsonValue& slot() {
    if (open_.empty()) return root;
    if (auto* array = std::get_if<JsonArray>(&open_.back()->value)) {
      if (array->empty()) array->reserve(usual_values);
      return array->emplace_back();
    }
    return std::get<JsonObject>(open_.back()->value).back().value;
  }

  template <class T>
  bool put(T value) {
    slot().value = std::move(value);
    return count();
  }

  template <class T>
  bool open(T container) {
    if (open_.size() >= max_nesting)
      return refuse({where(3) + "/…", "brackets nested more than " + std::to_string(max_nesting) + " deep",
                     "at most " + std::to_string(max_nesting) + " levels"});
    JsonValue& at = slot();
    at.value = std::move(container);
    open_.push_back(&at);
    return count();
  }

  bool count() {
    if (++values_ <= max_values) return true;
    return refuse({"/", "more than " + std::to_string(max_values) + " values", "a smaller scene"});
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  /// JSON pointer of the value that is being read, counting only the first `levels` open containers.
  std::string where(std::size_t levels) const {
    std::string out;
    for (std::size_t i = 0; i < std::min(levels, open_.size()); ++i) {
      const JsonValue& holder = *open_[i];
      if (const auto* array = std::get_if<JsonArray>(&holder.value)) {
        const bool innermost = i + 1 == open_.size();  // its next element is not there yet
        out += "/" + std::to_string(innermost ? array->size() : array->size() - 1);
      } else {
        out += "/" + pointer_step(std::get<JsonObject>(holder.value).back().key);
      }
    }
    return out;
  }
};

bool is_blank(std::string_view text) { return text.find_first_not_of(" \t\r\n") == text.npos; }

}  // namespace

JsonDocument parse_json(std::string_view text) {
  if (text.size() > max_scene_bytes) throw ParseError{"/", "more than 256 MiB of text", "a scene of at most 256 MiB"};
  if (is_blank(text)) throw ParseError{"/", "an empty file", "a scene: { \"tyndall\": 1, … }"};
  // The parser would take it for the end of the text, and what follows would not be looked at.
  if (const std::size_t zero = text.find('\0'); zero != text.npos) throw syntax_error(text, zero + 1, "zero byte");
  auto memory = std::make_unique<JsonMemory>();
  TreeBuilder builder(text, memory.get());
  if (!TreeBuilder::Json::sax_parse(text.begin(), text.end(), &builder, TreeBuilder::Json::input_format_t::json, true,
                                    true))
    throw builder.failure.value_or(ParseError{"/", "text that is not JSON", "JSON"});
  return {std::move(memory), std::move(builder.root)};
}

}  // namespace tyndall
