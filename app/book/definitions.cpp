#include "app/book/definitions.h"

#include "app/book/source_text.h"

#include <algorithm>
#include <cctype>

namespace tyndall {
namespace {

using Tokens = std::vector<std::string>;

bool is_name(const std::string& token) {
  return std::isalpha(static_cast<unsigned char>(token[0])) != 0 || token[0] == '_';
}
bool is_one_of(const std::string& token, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), token) != words.end();
}
std::size_t find(const Tokens& tokens, std::string_view sign, std::size_t from = 0) {
  return static_cast<std::size_t>(std::find(tokens.begin() + static_cast<long>(from), tokens.end(), sign) -
                                  tokens.begin());
}

/// Where tokens begin that follow `template <...>`.
std::size_t after_template(const Tokens& tokens) {
  std::size_t at = 0;
  while (at + 1 < tokens.size() && tokens[at] == "template" && tokens[at + 1] == "<") {
    int depth = 0;
    for (++at; at < tokens.size(); ++at) {
      if (tokens[at] == "<") ++depth;
      if (tokens[at] == ">" && --depth == 0) break;
    }
    ++at;
  }
  return at;
}

/// The name of a function or variable; empty: it has none that can be found by itself.
std::string name_of_object(const Tokens& tokens, std::size_t begin, bool& is_function) {
  const std::size_t round = find(tokens, "(", begin), curly = find(tokens, "{", begin);
  std::size_t end =
      std::min({round, curly, find(tokens, "=", begin), find(tokens, "[", begin), find(tokens, ";", begin)});
  if (end == tokens.size() || end < begin + 2 || !is_name(tokens[end - 1])) return "";
  const bool qualified = tokens[end - 2] == ":" || tokens[end - 2] == "~";
  if (qualified || find(tokens, "operator", begin) < end) return "";
  const char next = end + 1 < tokens.size() ? tokens[end + 1][0] : ')';
  is_function = end == round && std::isdigit(static_cast<unsigned char>(next)) == 0 && next != '-';
  return tokens[end - 1];
}

/// Names the item that begins at some line; false: it is left out.
bool describe(Definition& item) {
  const Tokens tokens = tokens_of(item.text);
  const std::size_t begin = after_template(tokens);
  if (begin + 1 >= tokens.size()) return false;
  const std::string& first = tokens[begin];
  if (is_one_of(first, {"extern", "friend", "static_assert"})) return false;
  if (first == "using" && tokens[begin + 1] == "namespace") {
    item.name = using_namespace;
    return true;
  }
  if (first == "using") {
    const bool is_alias = begin + 2 < tokens.size() && tokens[begin + 2] == "=";
    item.name = is_alias ? tokens[begin + 1] : tokens[tokens.size() - 2];
    return is_name(item.name);
  }
  if (first == "typedef") {
    item.name = tokens[tokens.size() - 2];
    return is_name(item.name);
  }
  if (first == "namespace") {
    item.is_namespace = true;
    item.name = tokens[begin + 1];
    return is_name(item.name);
  }
  const std::size_t brace = find(tokens, "{", begin);
  if (is_one_of(first, {"class", "struct", "union", "enum"}) && brace < find(tokens, "(", begin)) {
    item.name = tokens[begin + 1];
    if (is_one_of(item.name, {"class", "struct"})) item.name = tokens[begin + 2];
    const auto classes = classes_of(item.text);
    if (const auto own = classes.find(item.name); own != classes.end()) item.base = own->second;
    return is_name(item.name);
  }
  bool is_function = false;
  item.name = name_of_object(tokens, begin, is_function);
  const auto has = [&](std::string_view word) { return find(tokens, word) < std::min(brace, tokens.size()); };
  if (is_function && !has("inline") && !has("static") && begin == 0) item.text = "inline " + item.text;
  return !item.name.empty();
}

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  std::vector<Definition> scan() {
    for (skip_blanks(); at_ < text_.size(); skip_blanks()) {
      if (text_[at_] == '{') {  // the body of a constructor that initialises by braces
        skip_item();
        continue;
      }
      Definition item;
      item.line = line_;
      const std::size_t begin = at_;
      const bool directive = text_[at_] == '#';
      directive ? skip_directive() : skip_item();
      item.text = std::string(text_.substr(begin, at_ - begin));
      if (directive ? is_macro(item) : describe(item)) found_.push_back(std::move(item));
    }
    return std::move(found_);
  }

 private:
  void step() {
    if (text_[at_++] == '\n') ++line_;
  }
  void skip_blanks() {
    while (at_ < text_.size() && (std::isspace(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == ';'))
      step();
  }
  void skip_directive() {
    while (at_ < text_.size() && (text_[at_] != '\n' || text_[at_ - 1] == '\\')) step();
  }
  void skip_string() {
    const char quote = text_[at_];
    for (step(); at_ < text_.size() && text_[at_] != quote; step())
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) step();
    if (at_ < text_.size()) step();
  }
  /// To the semicolon that ends it, or the brace that ends a function's body or a namespace.
  void skip_item() {
    int depth = 0;
    bool ends_at_brace = false;  // of a body: what stands before it is no type and no value
    const std::size_t begin = at_;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      const bool digit_separator = c == '\'' && at_ > begin && std::isalnum(static_cast<unsigned char>(text_[at_ - 1]));
      if (c == '"' || (c == '\'' && !digit_separator)) {
        skip_string();
        continue;
      }
      if (c == '{' && depth == 0) ends_at_brace = at_ == begin || begins_body(text_.substr(begin, at_ - begin));
      if (c == '{' || c == '(') ++depth;
      if (c == '}' || c == ')') --depth;
      step();
      if (depth < 0 || (depth == 0 && (c == ';' || (c == '}' && ends_at_brace)))) return;
    }
  }
  static bool begins_body(std::string_view head) {
    const Tokens tokens = tokens_of(head);
    const std::size_t begin = after_template(tokens);
    if (begin >= tokens.size()) return false;
    const bool is_value = find(tokens, "=", begin) < find(tokens, "(", begin);
    if (is_value && find(tokens, "operator", begin) == tokens.size()) return false;
    return tokens[begin] == "namespace" || find(tokens, ")", begin) < tokens.size();
  }
  static bool is_macro(Definition& item) {
    const Tokens tokens = tokens_of(item.text);
    if (tokens.size() < 3 || tokens[1] != "define") return false;
    item.name = tokens[2];
    item.text += "\n";
    return true;
  }

  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
  std::vector<Definition> found_;
};

}  // namespace

std::vector<Definition> definitions_of(std::string_view text) { return Scanner(text).scan(); }

std::vector<Definition> members_of(std::string_view text) {
  const std::size_t begin = text.find('{'), end = text.rfind('}');
  if (begin >= end || end == std::string_view::npos) return {};
  std::string body(text.substr(begin + 1, end - begin - 1));
  for (const std::string_view label : {"public", "private", "protected"})
    for (std::size_t at = body.find(label); at != std::string::npos; at = body.find(label, at + 1)) {
      const std::size_t colon = body.find_first_not_of(" \t", at + label.size());
      if (colon != std::string::npos && body[colon] == ':') body.replace(at, colon + 1 - at, colon + 1 - at, ' ');
    }
  return definitions_of(body);
}

}  // namespace tyndall
