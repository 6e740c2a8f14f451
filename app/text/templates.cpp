#include "app/text/templates.h"

#include "core/base/error.h"
#include "core/scene/load.h"

#include <fstream>
#include <iterator>

namespace tyndall {

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
