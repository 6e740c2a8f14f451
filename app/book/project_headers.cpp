#include "app/book/project_headers.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <system_error>

namespace tyndall {

namespace fs = std::filesystem;

namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

fs::path ProjectHeaders::find(const std::string& name) {
  if (!listed_) list();
  const std::string wanted = "/" + lower(fs::path(name).lexically_normal().string());
  const std::size_t above = wanted.rfind("../");
  const std::string ending = wanted.substr(above == std::string::npos ? 0 : above + 2);
  for (const fs::path& file : headers_)
    if (("/" + lower(file.string())).ends_with(ending)) return file;
  return {};
}

void ProjectHeaders::list() {
  constexpr int deepest = 4, most = 5000;
  listed_ = true;
  std::error_code error;
  fs::path folder = folder_.empty() ? fs::path(".") : folder_;
  const std::string name = lower(fs::weakly_canonical(folder, error).filename().string());
  if (name == "src" || name == "source" || name == "app" || name == "apps" || name == "bin") folder /= "..";
  int seen = 0;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (++seen > most) break;
    if (at.depth() >= deepest || at->path().filename().string().starts_with(".")) at.disable_recursion_pending();
    const std::string ending = lower(at->path().extension().string());
    if (ending == ".h" || ending == ".hpp" || ending == ".hh") headers_.push_back(at->path().lexically_normal());
  }
  const auto depth = [](const fs::path& file) { return std::distance(file.begin(), file.end()); };
  std::sort(headers_.begin(), headers_.end(),
            [&](const fs::path& a, const fs::path& b) { return depth(a) != depth(b) ? depth(a) < depth(b) : a < b; });
}

}  // namespace tyndall
