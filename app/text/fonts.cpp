#include "app/text/fonts.h"

#include "core/scene/load.h"

#include <filesystem>
#include <system_error>

namespace tyndall {

std::string find_font(const std::string& file) {
  static constexpr const char* folders[] = {"/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/",
                                            "/usr/share/fonts/truetype/jetbrains-mono/",
                                            "/usr/share/fonts/truetype/dejavu/",
                                            "/usr/share/fonts/TTF/",
                                            "/usr/share/fonts/google-roboto/",
                                            "/usr/share/fonts/jetbrains-mono-fonts/",
                                            "/usr/local/share/fonts/",
                                            "/Library/Fonts/",
                                            "C:/Windows/Fonts/"};
  std::error_code ignored;
  const std::filesystem::path packed = assets_folder() / "fonts" / file;  // where the system has none of them
  if (std::filesystem::is_regular_file(packed, ignored)) return packed.string();
  for (const std::string folder : folders)
    if (std::filesystem::is_regular_file(folder + file, ignored)) return folder + file;
  return "";
}

unsigned next_character(const std::string& text, std::size_t& at) {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
  const unsigned first = byte(at++);
  if (first < 0x80) return first;
  const int more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
  unsigned code = more == 3 ? first & 0x07 : more == 2 ? first & 0x0f : first & 0x1f;
  for (int k = 0; k < more; ++k) {
    if ((byte(at) & 0xc0) != 0x80) return 0xfffd;
    code = (code << 6) | (byte(at++) & 0x3f);
  }
  return more == 0 ? 0xfffd : code;
}

}  // namespace tyndall
