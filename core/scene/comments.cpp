#include "core/base/text.h"
#include "core/scene/json.h"

namespace tyndall {
namespace {

constexpr std::string_view blanks = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

}  // namespace

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
