#include "app/window/document/kept_text.h"

#include "app/window/document/open_document.h"

#include <fmt/core.h>

#include <cstdlib>
#include <exception>
#include <fstream>
#include <string_view>
#include <utility>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view first_line = "// Edits that were not saved, of ";
constexpr std::string_view second_line = "// The FNV-1a hash of that file's text when they were made: ";

/// On one line, as a comment needs it: what would end the line is written as %0A and the like.
std::string escaped(const std::string& text) {
  constexpr const char* digits = "0123456789ABCDEF";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && c != '%')
      out += c;
    else
      out += std::string("%") + digits[byte / 16] + digits[byte % 16];
  }
  return out;
}

std::string unescaped(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool code = text[i] == '%' && i + 2 < text.size();
    out += code ? static_cast<char>(std::strtol(text.substr(i + 1, 2).c_str(), nullptr, 16)) : text[i];
    if (code) i += 2;
  }
  return out;
}

/// What follows `start` in the line of the file's first two that begins with it; empty: none does.
std::string rest_of_line(const fs::path& file, std::string_view start) {
  std::ifstream in(file);
  std::string line;
  for (int k = 0; k < 2 && std::getline(in, line); ++k)
    if (line.starts_with(start)) return line.substr(start.size());
  return "";
}

/// The document as it is without edits; one that holds nothing where its scene cannot be read any more.
Document unedited(const std::string& what) {
  try {
    return document_of(load_scene(what));
  } catch (const std::exception&) {
    auto origin = std::make_shared<Origin>();
    origin->what = what;
    const fs::path file(what);
    origin->title = what.empty() ? "scene" : title_of(file);
    if (file.extension() == ".json") origin->file = file;
    origin->folder = file.parent_path();
    return {{}, std::move(origin)};
  }
}

}  // namespace

std::string kept_text(const Scene& scene, const Origin& origin, const fs::path& folder) {
  const Scene moved = move_textures(scene, fs::absolute(origin.folder), fs::absolute(folder));
  std::string text = std::string(first_line) + escaped(origin.what) + "\n";
  if (origin.text_hash != 0) text += fmt::format("{}{:016x}\n", second_line, origin.text_hash);
  return text + write_scene(moved);
}

Kept read_kept(const fs::path& file, const std::function<LoadedScene(const std::string& what)>& read) {
  const LoadedScene kept = read(fs::absolute(file).string());
  const std::string hash = rest_of_line(file, second_line);
  Document document = unedited(kept_what(file));
  document.scene = move_textures(kept.scene, kept.folder, fs::absolute(document.origin->folder));
  const std::uint64_t now = document.origin->text_hash;
  return {std::move(document), !hash.empty() && now != 0 && fmt::format("{:016x}", now) != hash};
}

std::string kept_what(const fs::path& file) { return unescaped(rest_of_line(file, first_line)); }

}  // namespace tyndall
