#include "core/base/text.h"
#include "core/scene/json_tree.h"
#include "core/scene/load.h"
#include "core/scene/place.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace tyndall {
namespace {

/// "line 3, column 5" of a byte offset; columns count letters.
std::string line_and_column(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::string_view row = before.substr(before.rfind('\n') + 1);  // npos + 1 is 0
  const auto column =
      1 + std::count_if(row.begin(), row.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

bool is_word(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '.' ||
         c == '+' || c == '-';
}

/// Where the word, text or letter that holds the byte at `last` begins, and what follows it.
struct Span {
  std::size_t begin, end;
};
Span token_at(std::string_view text, std::size_t last) {
  Span span{last, last + 1};
  if (text[last] == '"' && last > 0) {  // the parser reads a whole string before it finds that it is misplaced
    const std::size_t opening = text.rfind('"', last - 1);
    if (opening != text.npos && text.substr(opening, last - opening).find('\n') == text.npos) span.begin = opening;
  } else if (is_word(text[last])) {
    while (span.begin > 0 && is_word(text[span.begin - 1])) --span.begin;
    while (span.end < text.size() && is_word(text[span.end])) ++span.end;
  } else {
    while (span.begin > 0 && (static_cast<unsigned char>(text[span.begin]) & 0xc0) == 0x80) --span.begin;
    while (span.end < text.size() && (static_cast<unsigned char>(text[span.end]) & 0xc0) == 0x80) ++span.end;
  }
  return span;
}

/// What the parser's message ends with or holds, and how a person says what is found and what should be there instead.
struct Fault {
  std::string_view reason, found, expected;
};
/// What the parser waited for.
constexpr Fault waits[] = {{"expected string literal", "", "a key in double quotes"},
                           {"expected ':'", "", "':'"},
                           {"expected ']'", "", "',' or ']'"},
                           {"expected '}'", "", "',' or '}'"},
                           {"expected end of input", "", "the end of the file"},
                           {"", "", "a value: a number, a text in double quotes, a list or an object"}};
/// Faults inside a text, a number or a comment.
constexpr Fault faults[] = {
    {"invalid comment", "a comment that is not closed", "*/ at its end"},
    {"missing closing quote", "a text that is not closed", "\" at its end"},
    {"control character", "a line break or control character in a text", "\" at the end of the text, or \\n"},
    {"forbidden character after backslash", "a backslash before a letter that it cannot escape",
     "\\\\ for a backslash"},
    {"surrogate", "half of a \\u pair", "both halves of it"},
    {"'\\u' must be followed by 4 hex digits", "\\u without 4 hexadecimal digits", "\\u and 4 hexadecimal digits"},
    {"zero byte", "a zero byte", "text in UTF-8"},
    {"UTF-8", "bytes that are not UTF-8", "text in UTF-8"},
    {"invalid BOM", "a broken byte order mark", "text in UTF-8"}};

/// Says what is wrong with a text that is not JSON as a person would, at "line L, column C".
/// end: bytes that the parser had read when it gave up, the offending one included; above the text's size at its end.
/// reason: the parser's own message.
ParseError syntax_error(std::string_view text, std::size_t end, std::string_view reason) {
  const bool at_end = end > text.size() || text.empty();
  const std::size_t last = at_end ? text.size() : std::max<std::size_t>(end, 1) - 1;
  for (const Fault& fault : faults)
    if (reason.find(fault.reason) != reason.npos)
      return {line_and_column(text, last), std::string(fault.found), std::string(fault.expected)};
  const auto ends_reason = [&](const Fault& wait) { return reason.ends_with(wait.reason); };
  const std::string expected(std::find_if(std::begin(waits), std::end(waits), ends_reason)->expected);
  if (at_end) return {line_and_column(text, last), "the end of the file", expected};
  const Span token = token_at(text, last);
  const std::string_view found = text.substr(token.begin, token.end - token.begin);
  return {line_and_column(text, token.begin), found[0] == '"' ? shortened(found, 80) : "'" + shortened(found, 80) + "'",
          expected};
}

/// Most values of a document. A real scene of 256 MiB has fewer; as a tree, this many take about 2 GB of memory.
constexpr std::size_t max_values = std::size_t(1) << 25;

/// Members of most objects, such as spheres, and values of most arrays, which are points and colours. Room for just so
/// many is made at first, because scenes of a million objects consist of little else.
constexpr std::size_t usual_members = 4, usual_values = 3;

/// Receives the parser's events, builds the tree and refuses what the format refuses, before it is built.
class TreeBuilder {
 public:
  using Json = nlohmann::json;

  TreeBuilder(std::string_view text, JsonMemory* memory) : text_(text), memory_(memory) {}

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
  JsonMemory* memory_;
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

constexpr std::string_view blanks = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

}  // namespace

JsonDocument parse_json(std::string_view text) {
  if (text.size() > max_scene_bytes) throw ParseError{"/", "more than 256 MiB of text", "a scene of at most 256 MiB"};
  if (trimmed(text).empty()) throw ParseError{"/", "an empty file", "a scene: { \"tyndall\": 1, … }"};
  // The parser would take it for the end of the text, and what follows would not be looked at.
  if (const std::size_t zero = text.find('\0'); zero != text.npos) throw syntax_error(text, zero + 1, "zero byte");
  auto memory = std::make_unique<JsonMemory>();
  TreeBuilder builder(text, memory.get());
  if (!TreeBuilder::Json::sax_parse(text.begin(), text.end(), &builder, TreeBuilder::Json::input_format_t::json, true,
                                    true))
    throw builder.failure.value_or(ParseError{"/", "text that is not JSON", "JSON"});
  return {std::move(memory), std::move(builder.root)};
}

std::vector<std::string> leading_comments(std::string_view text) {
  std::vector<std::string> lines;
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // byte order mark
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    const bool block = text.starts_with("/*");
    if (!block && !text.starts_with("//")) return lines;
    const std::size_t end = std::min(text.find(block ? "*/" : "\n", 2), text.size());
    std::string_view comment = text.substr(2, end - 2);
    text.remove_prefix(std::min(end + (block ? 2 : 1), text.size()));
    while (!comment.empty()) {
      const std::size_t line_end = std::min(comment.find('\n'), comment.size());
      lines.push_back(printable(trimmed(comment.substr(0, line_end))));
      comment.remove_prefix(std::min(line_end + 1, comment.size()));
    }
  }
}

}  // namespace tyndall
