#include "app/book/program_outline.h"

#include "core/base/text.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace tyndall {

namespace fs = std::filesystem;

namespace {

using TokenList = std::vector<std::string_view>;

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }
bool is_identifier(std::string_view token) {
  return !token.empty() && is_letter(token[0]) && !std::isdigit(static_cast<unsigned char>(token[0]));
}
/// The end of a string or character that begins at `at`.
std::size_t end_of_literal(const std::string& text, std::size_t at) {
  if (text[at] == '"' && at > 0 && text[at - 1] == 'R') {
    const std::size_t open = text.find('(', at);
    const std::string close = ")" + text.substr(at + 1, open - at - 1) + "\"";
    return std::min(text.find(close, open) + close.size(), text.size());
  }
  for (std::size_t end = at + 1; end < text.size(); ++end) {
    if (text[end] == '\\')
      ++end;
    else if (text[end] == text[at])
      return end + 1;
  }
  return text.size();
}

/// Follows a line marker, # 12 "file.h" 3: whether the lines behind it are the reader's.
bool enters_own_file(const std::string& line, const std::vector<fs::path>& ours, std::vector<fs::path>& files) {
  const std::size_t open = line.find('"'), close = line.rfind('"');
  if (open == close) return false;
  const fs::path file = fs::path(line.substr(open + 1, close - open - 1)).lexically_normal();
  if (line.find(" 3", close) != std::string::npos || file.string()[0] == '<') return false;  // the system's
  for (const fs::path& folder : ours)
    if (file.string().rfind(folder.string(), 0) == 0) return false;
  if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  return true;
}

/// The tokens of the reader's lines.
TokenList tokens_of(const std::string& text, const std::vector<fs::path>& ours, std::vector<fs::path>& files) {
  TokenList tokens;
  bool own = false;
  for (std::size_t at = 0; at < text.size();) {
    const bool is_marker = text[at] == '#' && (at == 0 || text[at - 1] == '\n');
    const std::size_t line_end = std::min(text.find('\n', at), text.size());
    if (is_marker && text.compare(at, 2, "# ") == 0) own = enters_own_file(text.substr(at, line_end - at), ours, files);
    if (is_marker || !own) {
      at = line_end + 1;
    } else if (std::isspace(static_cast<unsigned char>(text[at]))) {
      ++at;
    } else {
      std::size_t end = at + 1;
      const bool two = is_one_of(std::string_view(text).substr(at, 2), {"::", "->", "<<", "&&"});
      if (text[at] == '"' || text[at] == '\'')
        end = end_of_literal(text, at);
      else if (is_letter(text[at]))
        while (end < text.size() &&
               (is_letter(text[end]) || (text[end] == '\'' && std::isdigit(static_cast<unsigned char>(text[at])))))
          ++end;
      else if (two)
        end = at + 2;
      tokens.push_back(std::string_view(text).substr(at, end - at));
      at = end;
    }
  }
  return tokens;
}

/// Where the brackets that open are closed; all other tokens are closed where they are. Angles are brackets behind
/// names, where no end of a declaration is within.
std::vector<std::size_t> ends_of(const TokenList& tokens) {
  std::vector<std::size_t> ends(tokens.size()), open;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    ends[i] = i;
    const bool opens_angle = tokens[i] == "<" && i > 0 && is_identifier(tokens[i - 1]) && tokens[i - 1] != "operator";
    const bool closes = is_one_of(tokens[i], {")", "]", "}"});
    while ((closes || tokens[i] == ";") && !open.empty() && tokens[open.back()] == "<") open.pop_back();
    if (!open.empty() && (closes || (tokens[i] == ">" && tokens[open.back()] == "<")))
      ends[open.back()] = i, open.pop_back();
    if (opens_angle || is_one_of(tokens[i], {"(", "[", "{"})) open.push_back(i);
  }
  return ends;
}

class Outliner {
 public:
  Outliner(TokenList tokens, ProgramOutline& outline)
      : tokens_(std::move(tokens)), ends_(ends_of(tokens_)), outline_(outline) {}
  void run() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      const std::string_view token = tokens_[i];
      if (token == "{") {
        i = open_brace(i);
      } else if (token == "}") {
        if (!scopes_.empty()) scopes_.pop_back();
        start_ = i + 1;
      } else if (token == ";") {
        if (const std::size_t open = parameters_at(start_, i); open < i)
          add_function(start_, open, {});
        else if (!scopes_.empty() && scopes_.back().owner != none)
          add_members(outline_.classes[scopes_.back().owner], i);
        start_ = i + 1;
      } else if (token == ":" && i == start_ + 1 && is_one_of(tokens_[start_], {"public", "private", "protected"})) {
        start_ = i + 1;
      } else {
        i = ends_[i];
      }
    }
  }

 private:
  struct Scope {
    std::string name;
    std::size_t owner = none;  ///< the class; none: a namespace
  };
  static constexpr std::size_t none = std::string::npos;

  bool has(std::string_view word, std::size_t begin, std::size_t end) const {
    return std::find(tokens_.data() + begin, tokens_.data() + end, word) != tokens_.data() + end;
  }
  /// Behind a token, or behind the bracket that closes what it opens.
  std::size_t next(std::size_t at) const { return ends_[at] + 1; }
  std::size_t behind_template(std::size_t at) const { return tokens_[at] == "template" ? next(at + 1) : at; }
  /// Where the parameters of a function's declaration begin; `end`: it is none.
  std::size_t parameters_at(std::size_t begin, std::size_t end) const {
    for (std::size_t i = behind_template(begin); i < end; i = next(i)) {
      if (is_one_of(tokens_[i], {"=", "using", "typedef", "friend"})) return end;
      if (tokens_[i] == "(") return i > begin && is_identifier(tokens_[i - 1]) ? i : end;
    }
    return end;
  }
  std::size_t open_brace(std::size_t at) {
    const bool of_language = at > start_ && tokens_[start_] == "extern" && tokens_[at - 1][0] == '"';
    if (of_language || (at > start_ && has("namespace", start_, std::min(start_ + 2, at)))) {
      std::string name;
      for (std::size_t i = start_; i < at && !of_language; ++i)
        if (!is_one_of(tokens_[i], {"namespace", "inline"})) name += tokens_[i];
      scopes_.push_back({name});
      start_ = at + 1;
      return at;
    }
    const std::size_t open = parameters_at(start_, at), end = ends_[at];
    if (open < at) {
      if (has(":", ends_[open], at) && (is_identifier(tokens_[at - 1]) || tokens_[at - 1] == ">"))
        return end;  // a member of a constructor's list
      const char* from = tokens_[at].data();
      add_function(start_, open, std::string_view(from, static_cast<std::size_t>(tokens_[end].data() + 1 - from)));
      start_ = end + 1;
      return end;
    }
    const bool is_class = has("class", start_, at) || has("struct", start_, at);
    if (is_class && !has("enum", start_, at) && !has("=", start_, at)) {
      add_class(at);
      start_ = at + 1;
      return at;
    }
    if (has("operator", start_, at)) start_ = end + 1;
    return end;
  }
  /// The parts between commas that are in no brackets, by their begin and end.
  std::vector<std::pair<std::size_t, std::size_t>> parts(std::size_t begin, std::size_t end) const {
    std::vector<std::pair<std::size_t, std::size_t>> all;
    for (std::size_t i = begin; i < end; i = next(i))
      if (tokens_[i] == ",") all.emplace_back(std::exchange(begin, i + 1), i);
    if (begin < end) all.emplace_back(begin, end);
    return all;
  }
  /// The last name up to what it is set to, or an end.
  std::string name_in(std::size_t begin, std::size_t end) const {
    std::string name;
    for (std::size_t i = begin; i < end && !is_one_of(tokens_[i], {"=", "{", "[", ":", "("}); i = next(i))
      if (is_identifier(tokens_[i]) && tokens_[i] != "final") name = tokens_[i];
    return name;
  }
  std::vector<std::string> words(std::size_t begin, std::size_t end,
                                 std::initializer_list<std::string_view> without = {}) const {
    std::vector<std::string> all;
    for (std::size_t i = begin; i < end; ++i)
      if (!is_one_of(tokens_[i], without)) all.emplace_back(tokens_[i]);
    return all;
  }

  void add_class(std::size_t end) {
    OutlinedClass one;
    std::size_t i = behind_template(start_);
    while (i < end && !is_one_of(tokens_[i], {"class", "struct"})) ++i;
    one.name = name_in(i + 1, end);
    one.can_be_named = tokens_[start_] != "template" && !one.name.empty();
    for (const Scope& scope : scopes_) {
      if (!scope.name.empty()) one.qualified += "::" + scope.name;
      one.can_be_named = one.can_be_named && (scope.owner == none || outline_.classes[scope.owner].can_be_named);
    }
    one.qualified += "::" + one.name;
    while (i < end && tokens_[i] != ":") ++i;
    for (const auto& [from, to] : parts(i + 1, end)) one.bases.push_back(name_in(from, to));
    scopes_.push_back({one.name, outline_.classes.size()});
    outline_.classes.push_back(one);
  }
  /// The names in a declaration like "double radius = 1, weights[3];".
  void add_members(OutlinedClass& owner, std::size_t end) {
    if (end < start_ + 2 || has("operator", start_, end) ||
        is_one_of(tokens_[start_], {"using", "typedef", "friend", "static", "enum", "template", "class", "struct",
                                    "union", "inline", "constexpr"}))
      return;
    for (const auto& [from, to] : parts(start_, end))
      if (const std::string name = name_in(from, to); !name.empty()) owner.members.push_back(name);
  }
  Parameter parameter_of(std::size_t begin, std::size_t end) const {
    Parameter one;
    end = static_cast<std::size_t>(std::find(&tokens_[begin], tokens_.data() + end, "=") - tokens_.data());
    if (begin >= end) return one;
    const std::string_view last = tokens_[end - 1], before = end - begin > 1 ? tokens_[end - 2] : "const";
    const bool has_type = is_one_of(before, {"&", "*", ">", "&&"}) ||
                          (is_identifier(before) && !is_one_of(before, {"const", "struct", "class"}));
    const bool is_type = is_one_of(last, {"int", "double", "float", "bool", "char", "unsigned", "signed", "long",
                                          "short", "void", "auto", "const"});
    if (is_identifier(last) && has_type && !is_type) one.name = last, --end;
    one.type = words(begin, end);
    for (const std::string& token : one.type)
      if (is_identifier(token) && token != "const") one.identifiers.push_back(token);
    return one;
  }
  void add_function(std::size_t begin, std::size_t open, std::string_view body) {
    if (open >= 2 && tokens_[open - 2] == "~") return;
    Function one;
    one.body = body;
    one.name = tokens_[open - 1];
    if (!scopes_.empty() && scopes_.back().owner != none) one.owner = scopes_.back().name;
    std::size_t name = open - 1;
    for (; name >= begin + 2 && tokens_[name - 1] == "::"; name -= 2)  // defined outside of its class
      if (outline_.class_named(std::string(tokens_[name - 2]))) one.owner = tokens_[name - 2];
    begin = behind_template(begin);
    one.is_virtual = has("virtual", begin, name), one.is_static = has("static", begin, name);
    one.result = joined(
        words(begin, name, {"virtual", "static", "inline", "constexpr", "explicit", "[", "]", "nodiscard"}), " ");
    for (const auto& [from, to] : parts(open + 1, ends_[open])) one.parameters.push_back(parameter_of(from, to));
    outline_.functions.push_back(one);
  }

  TokenList tokens_;
  std::vector<std::size_t> ends_;
  ProgramOutline& outline_;
  std::vector<Scope> scopes_;
  std::size_t start_ = 0;  ///< of the declaration
};

}  // namespace

const OutlinedClass* ProgramOutline::class_named(const std::string& name) const {
  const auto known =
      std::find_if(classes.begin(), classes.end(), [&](const OutlinedClass& one) { return one.name == name; });
  return known == classes.end() ? nullptr : &*known;
}

bool ProgramOutline::is_derived(const std::string& name, const std::string& root) const {
  std::vector<std::string> found{name};
  for (std::size_t k = 0; k < found.size(); ++k)
    for (const OutlinedClass& known : classes)
      if (known.name == found[k])
        for (const std::string& base : known.bases)
          if (std::find(found.begin(), found.end(), base) == found.end()) found.push_back(base);
  return !root.empty() && std::find(found.begin(), found.end(), root) != found.end();
}

std::string key_of(const std::string& name) {
  std::string key;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)))
      key += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return key;
}

ProgramOutline outline_of(const std::string& text, const std::vector<fs::path>& ours) {
  ProgramOutline outline;
  TokenList tokens = tokens_of(text, ours, outline.files);
  Outliner(std::move(tokens), outline).run();
  return outline;
}

}  // namespace tyndall
