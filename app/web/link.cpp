#include "app/web/link.h"

#include "core/base/error.h"

#include <zlib.h>

#include <cstring>

namespace tyndall {
namespace {

constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
constexpr const char* beginning = "z=";

std::string to_base64(const std::string& bytes) {
  std::string text;
  unsigned bits = 0, count = 0;
  for (const char byte : bytes) {
    bits = bits << 8 | static_cast<unsigned char>(byte), count += 8;
    for (; count >= 6; count -= 6) text += digits[bits >> (count - 6) & 63];
  }
  if (count > 0) text += digits[bits << (6 - count) & 63];
  return text;
}

/// Up to the first letter that is none of base64.
std::string from_base64(const std::string& text) {
  std::string bytes;
  unsigned bits = 0, count = 0;
  for (const char letter : text) {
    const char* digit = letter == '\0' ? nullptr : std::strchr(digits, letter);
    if (!digit) break;
    bits = bits << 6 | static_cast<unsigned>(digit - digits), count += 6;
    if (count >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255);
  }
  return bytes;
}

Bytef* bytes_of(std::string& text) { return reinterpret_cast<Bytef*>(text.data()); }

}  // namespace

std::string link_of_scene(const std::string& text) {
  const auto too_long = [](const char* what, std::size_t limit) {
    return IoError(std::string("no link: the scene's ") + what + " would be longer than " +
                   std::to_string(limit >> 10) + " kB; save the scene, and send the file");
  };
  if (text.size() > max_linked_scene) throw too_long("text", max_linked_scene);
  std::string source = text, deflated(compressBound(static_cast<uLong>(text.size())), '\0');
  uLongf size = static_cast<uLongf>(deflated.size());
  compress2(bytes_of(deflated), &size, bytes_of(source), static_cast<uLong>(source.size()), Z_BEST_COMPRESSION);
  deflated.resize(size);
  const std::string link = beginning + to_base64(deflated);
  if (link.size() > max_link) throw too_long("address", max_link);
  return link;
}

std::string scene_of_link(const std::string& link) {
  const char* expected = "a link that Tyndall has copied";
  if (!link.starts_with(beginning)) throw SceneError("the page's address", "another text", expected);
  if (link.size() > max_link)
    throw SceneError("the page's address", std::to_string(link.size()) + " bytes", "at most 64 kB");
  std::string deflated = from_base64(link.substr(std::strlen(beginning))), text(max_linked_scene, '\0');
  uLongf size = static_cast<uLongf>(text.size());
  const int error = uncompress(bytes_of(text), &size, bytes_of(deflated), static_cast<uLong>(deflated.size()));
  if (error == Z_BUF_ERROR && size == text.size())
    throw SceneError("the page's address", "a scene of more than 1 MB", "at most 1 MB");
  if (error != Z_OK) throw SceneError("the page's address", "a part of a link, or a changed one", expected);
  text.resize(size);
  return text;
}

}  // namespace tyndall
