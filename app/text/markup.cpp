#include "app/text/markup.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/scene/load.h"

#include <fstream>
#include <iterator>

namespace tyndall {
/// The printable text with references in place of the letters that are among `special`.
static std::string with_references(std::string_view text, std::string_view special) {
  static constexpr std::string_view all = "<>&\"'";
  static constexpr const char* references[] = {"&lt;", "&gt;", "&amp;", "&quot;", "&#39;"};
  std::string out;
  for (const char c : all_printable(text)) {
    const bool plain = special.find(c) == special.npos;
    out += plain ? std::string(1, c) : references[all.find(c)];
  }
  return out;
}

std::string in_xml(std::string_view text) { return with_references(text, "<>&\"'"); }

std::string in_html(std::string_view text) { return with_references(text, "<&\"'"); }

std::string in_csv(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

std::string in_shell(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string from_template(const std::string& file, const std::vector<std::pair<std::string, std::string>>& texts) {
  const std::filesystem::path place = assets_folder() / "templates" / file;
  std::ifstream in(place, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  std::size_t at = 0;
  for (const auto& [name, replacement] : texts) {
    const std::string mark = "{{" + name + "}}";
    at = text.find(mark, at);
    if (at == std::string::npos)
      throw IoError(place.string() + ": found no " + mark + ", expected the template that belongs to this program");
    text.replace(at, mark.size(), replacement);
    at += replacement.size();
  }
  return text;
}

}  // namespace tyndall
