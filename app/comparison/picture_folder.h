#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// Which pictures a folder holds, the folders within it included.
namespace tyndall {

struct PictureFolder {
  /// By their names from the folder on, with "/" between them: "box.png", "fog/thin.exr".
  std::map<std::string, std::filesystem::path> pictures;
  std::vector<std::string> others;  ///< files that are no pictures by their names; those that begin with "." go untold
  std::vector<std::string> loops;   ///< links that lead back to a folder around them; all other links are followed
};

/// The endings of pictures' names, for messages.
inline constexpr const char* picture_endings = ".png .exr .pfm .hdr .ppm .pgm .jpg .jpeg .bmp .tga";

/// without: folders that are not gone into. Throws IoError for a folder that cannot be read.
PictureFolder pictures_in(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& without);

}  // namespace tyndall
