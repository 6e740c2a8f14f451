#pragma once
#include "core/image/image_io.h"
#include "tests/support/scratch.h"

#include <unistd.h>

#include <string>

/// Picture files that tests write byte by byte, and what comes of reading them.
namespace tyndall::test {

/// The file that holds these bytes, until the next one is written. Tests that run at the same time have one each.
inline std::filesystem::path picture_file(const std::string& bytes) {
  static const struct Folder {
    std::filesystem::path path = scratch_folder("picture-" + std::to_string(getpid()));
    ~Folder() { std::filesystem::remove_all(path); }
  } folder;
  const std::filesystem::path file = folder.path / "a.picture";
  write_text(file, bytes);
  return file;
}

inline PictureFile picture_of(const std::string& bytes) { return read_picture(picture_file(bytes)); }
inline std::vector<float> light_of(const std::string& bytes) { return picture_of(bytes).image.rgb; }

/// The 8-bit numbers of a picture that is read.
inline std::vector<std::uint8_t> numbers_of(const std::string& bytes) {
  return tone_map(light_of(bytes), 0, ToneMap::srgb);
}

/// Why the picture is not read, without the file's name; "" if it is.
inline std::string message_for(const std::string& bytes) {
  try {
    picture_of(bytes);
  } catch (const ImageFileError& error) {
    const std::string text = error.what(), start = ": cannot read: ";
    return text.substr(text.find(start) + start.size());
  }
  return "";
}

}  // namespace tyndall::test
