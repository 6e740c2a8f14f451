#include "app/book/program_outline.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace tyndall {

namespace fs = std::filesystem;

namespace {

using TokenList = std::vector<std::string_view>;

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }
bool is_identifier(std::string_view token) {
  return !token.empty() && is_letter(token[0]) && !std::isdigit(static_cast<unsigned char>(token[0]));
}
bool is_one_of(std::string_view token, std::initializer_list<std::string_view> all) {
  return std::find(all.begin(), all.end(), token) != all.end();
}
bool is_built_in(std::string_view token) {
  return is_one_of(token,
                   {"int", "double", "float", "bool", "char", "unsigned", "signed", "long", "short", "void", "auto"});
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
  const bool of_system = line.find(" 3", close) != std::string::npos || file.string()[0] == '<';
  if (of_system) return false;
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
    const bool begins_line = at == 0 || text[at - 1] == '\n';
    const std::size_t line_end = std::min(text.find('\n', at), text.size());
    if (begins_line && text[at] == '#') {
      if (text.compare(at, 2, "# ") == 0) own = enters_own_file(text.substr(at, line_end - at), ours, files);
      at = line_end + 1;
    } else if (!own) {
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

class Outliner {
 public:
  Outliner(TokenList tokens, ProgramOutline& outline) : tokens_(std::move(tokens)), outline_(outline) {}
  void run() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      const std::string_view token = tokens_[i];
      if (token == "(" || token == "[") {
        i = closing(i);
      } else if (token == "{") {
        i = open_brace(i);
      } else if (token == "}") {
        if (!scopes_.empty()) scopes_.pop_back();
        start_ = i + 1;
      } else if (token == ";") {
        if (const std::size_t open = parameters_at(start_, i); open < i) add_function(start_, open, i, {});
        start_ = i + 1;
      } else if (token == ":" && i == start_ + 1 && is_one_of(tokens_[start_], {"public", "private", "protected"})) {
        start_ = i + 1;
      }
    }
    find_heads();
  }

 private:
  struct Scope {
    std::string name;
    int owner = -1;  ///< the class; -1: a namespace
  };

  std::size_t closing(std::size_t open) const {
    int depth = 0;
    for (std::size_t i = open; i < tokens_.size(); ++i) {
      if (is_one_of(tokens_[i], {"(", "[", "{"})) ++depth;
      if (is_one_of(tokens_[i], {")", "]", "}"}) && --depth == 0) return i;
    }
    return tokens_.size() - 1;
  }
  /// Behind the < ... > that begins at `at`, else `at`.
  std::size_t behind_angles(std::size_t at, std::size_t end) const {
    if (at >= end || tokens_[at] != "<") return at;
    int depth = 0;
    for (std::size_t i = at; i < end; ++i) {
      if (tokens_[i] == "<") ++depth;
      if (tokens_[i] == ">" && --depth == 0) return i + 1;
      if (is_one_of(tokens_[i], {";", "{", "}"})) return at;
    }
    return at;
  }
  /// Where the parameters of a function's declaration begin; `end`: it is none.
  std::size_t parameters_at(std::size_t begin, std::size_t end) const {
    if (begin < end && tokens_[begin] == "template") begin = behind_angles(begin + 1, end);
    for (std::size_t i = begin; i < end; ++i) {
      if (i > begin && is_identifier(tokens_[i - 1]) && tokens_[i - 1] != "operator")
        i = std::max(i, behind_angles(i, end));
      if (i >= end || tokens_[i] == "=" || tokens_[i] == "using" || tokens_[i] == "typedef" || tokens_[i] == "friend")
        return end;
      if (tokens_[i] == "(") return i > begin && is_identifier(tokens_[i - 1]) ? i : end;
    }
    return end;
  }
  std::size_t open_brace(std::size_t at) {
    const auto has = [&](std::string_view word) {
      return std::find(tokens_.begin() + static_cast<std::ptrdiff_t>(start_),
                       tokens_.begin() + static_cast<std::ptrdiff_t>(at),
                       word) != tokens_.begin() + static_cast<std::ptrdiff_t>(at);
    };
    if (at > start_ &&
        (tokens_[start_] == "namespace" || (tokens_[start_] == "inline" && tokens_[start_ + 1] == "namespace"))) {
      std::string name;
      for (std::size_t i = start_; i < at; ++i)
        if (!is_one_of(tokens_[i], {"namespace", "inline"})) name += tokens_[i];
      scopes_.push_back({name, -1});
      start_ = at + 1;
      return at;
    }
    if (at > start_ && tokens_[start_] == "extern" && tokens_[at - 1][0] == '"') {
      scopes_.push_back({"", -1});
      start_ = at + 1;
      return at;
    }
    const std::size_t open = parameters_at(start_, at), end = closing(at);
    if (open < at) {
      const bool initialises = std::find(tokens_.begin() + static_cast<std::ptrdiff_t>(closing(open)),
                                         tokens_.begin() + static_cast<std::ptrdiff_t>(at),
                                         ":") != tokens_.begin() + static_cast<std::ptrdiff_t>(at);
      if (initialises && (is_identifier(tokens_[at - 1]) || tokens_[at - 1] == ">"))
        return end;  // a member of a constructor's list
      const char* from = tokens_[at].data();
      add_function(start_, open, at, std::string_view(from, static_cast<std::size_t>(tokens_[end].data() + 1 - from)));
      start_ = end + 1;
      return end;
    }
    if ((has("class") || has("struct")) && !has("enum") && !has("=")) {
      add_class(at);
      start_ = at + 1;
      return at;
    }
    if (has("operator")) start_ = end + 1;
    return end;
  }
  std::string space() const {
    std::string name;
    for (const Scope& scope : scopes_)
      if (!scope.name.empty()) name += (name.empty() ? "" : "::") + scope.name;
    return name;
  }
  void add_class(std::size_t end) {
    OutlinedClass one;
    one.space = space();
    one.is_template = tokens_[start_] == "template";
    std::size_t i = one.is_template ? behind_angles(start_ + 1, end) : start_;
    while (i < end && !is_one_of(tokens_[i], {"class", "struct"})) ++i;
    for (++i; i < end && tokens_[i] != ":"; ++i)
      if (is_identifier(tokens_[i]) && tokens_[i] != "final") one.name = tokens_[i];
    std::string base;
    for (++i; i <= end; ++i) {
      const bool ends = i == end || tokens_[i] == ",";
      if (ends && !base.empty()) one.bases.push_back(base);
      if (!ends && is_identifier(tokens_[i]) && !is_one_of(tokens_[i], {"public", "private", "protected", "virtual"}))
        base = tokens_[i];
      i = ends ? i : std::max(i + 1, behind_angles(i + 1, end)) - 1;
    }
    scopes_.push_back({one.name, static_cast<int>(outline_.classes.size())});
    outline_.classes.push_back(one);
  }
  Parameter parameter_of(std::size_t begin, std::size_t end) const {
    Parameter one;
    for (std::size_t i = begin; i < end; ++i)
      if (tokens_[i] == "=") end = i;
    if (begin >= end) return one;
    const std::string_view last = tokens_[end - 1];
    const bool has_type_before =
        end - begin > 1 &&
        (tokens_[end - 2] == "&" || tokens_[end - 2] == "*" || tokens_[end - 2] == ">" || tokens_[end - 2] == "&&" ||
         (is_identifier(tokens_[end - 2]) && !is_one_of(tokens_[end - 2], {"const", "struct", "class"})));
    if (is_identifier(last) && has_type_before && !is_built_in(last) && last != "const") one.name = last, --end;
    for (std::size_t i = begin; i < end; ++i) {
      one.type += (one.type.empty() ? "" : " ") + std::string(tokens_[i]);
      one.constant = one.constant || tokens_[i] == "const";
      if (is_identifier(tokens_[i]) && tokens_[i] != "const") one.identifiers.emplace_back(tokens_[i]);
    }
    one.reference = tokens_[end - 1] == "&";
    one.pointer = tokens_[end - 1] == "*";
    return one;
  }
  void add_function(std::size_t begin, std::size_t open, std::size_t end, std::string_view body) {
    Function one;
    one.body = body;
    one.name = tokens_[open - 1];
    if (open >= 2 && tokens_[open - 2] == "~") return;
    one.owner = scopes_.empty() ? -1 : scopes_.back().owner;
    std::size_t name = open - 1;
    while (name >= begin + 2 && tokens_[name - 1] == "::") {  // defined outside of its class
      for (std::size_t k = 0; k < outline_.classes.size(); ++k)
        if (outline_.classes[k].name == tokens_[name - 2]) one.owner = static_cast<int>(k);
      name -= 2;
    }
    if (tokens_[begin] == "template") begin = behind_angles(begin + 1, end);
    for (std::size_t i = begin; i < name; ++i) {
      one.is_virtual = one.is_virtual || tokens_[i] == "virtual";
      one.is_static = one.is_static || tokens_[i] == "static";
      if (!is_one_of(tokens_[i], {"virtual", "static", "inline", "constexpr", "explicit", "[", "]", "nodiscard"}))
        one.result += (one.result.empty() ? "" : " ") + std::string(tokens_[i]);
    }
    const std::size_t close = closing(open);
    std::size_t from = open + 1;
    for (std::size_t i = open + 1; i <= close; ++i) {
      if (i > open + 1 && is_identifier(tokens_[i - 1])) i = std::min(close, std::max(i, behind_angles(i, close)));
      if (is_one_of(tokens_[i], {"(", "[", "{"})) i = closing(i);
      if (i != close && tokens_[i] != ",") continue;
      if (from < i) one.parameters.push_back(parameter_of(from, i));
      from = i + 1;
    }
    for (std::size_t i = close + 1; i < end && tokens_[i] != ":"; ++i) {
      one.is_pure = one.is_pure || (tokens_[i] == "=" && i + 1 < end && tokens_[i + 1] == "0");
      if (tokens_[i] != "=" && tokens_[i] != "0") one.suffix += " " + std::string(tokens_[i]);
    }
    outline_.functions.push_back(one);
  }
  void find_heads() {
    for (std::size_t i = 1; i + 1 < tokens_.size(); ++i) {
      if (tokens_[i].rfind("\"P3", 0) != 0 && tokens_[i].rfind("\"P6", 0) != 0) continue;
      PictureHead head{tokens_[i], tokens_[i - 1] == "<<", {}};
      if (tokens_[i + 1] == ",")
        for (std::size_t from = i + 2, k = from; k < tokens_.size() && head.sizes.size() < 2; ++k) {
          if (tokens_[k] != "," && tokens_[k] != ")") {
            if (tokens_[k] == "(") k = closing(k);
            continue;
          }
          const char *begin = tokens_[from].data(), *end = tokens_[k - 1].data() + tokens_[k - 1].size();
          head.sizes.emplace_back(begin, static_cast<std::size_t>(end - begin));
          if (tokens_[k] == ")") break;
          from = k + 1;
        }
      if (head.is_streamed || head.sizes.size() == 2) outline_.heads.push_back(head);
    }
  }

  TokenList tokens_;
  ProgramOutline& outline_;
  std::vector<Scope> scopes_;
  std::size_t start_ = 0;  ///< of the declaration
};

}  // namespace

bool Parameter::names(const std::string& identifier) const {
  return std::find(identifiers.begin(), identifiers.end(), identifier) != identifiers.end();
}

bool ProgramOutline::is_derived(const std::string& name, const std::string& root) const {
  std::set<std::string> seen;
  std::vector<std::string> open{name};
  while (!open.empty()) {
    const std::string one = open.back();
    open.pop_back();
    if (one == root) return !root.empty();
    if (!seen.insert(one).second) continue;
    for (const OutlinedClass& known : classes)
      if (known.name == one) open.insert(open.end(), known.bases.begin(), known.bases.end());
  }
  return false;
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
