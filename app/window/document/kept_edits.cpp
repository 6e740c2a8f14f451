#include "app/window/document/autosave.h"

#include "core/base/error.h"
#include "core/system/files.h"

#include <fmt/core.h>

#include <cerrno>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

constexpr int max_windows = 1000;  // that keep edits at the same time

/// The number in a file's name; 0: it is not one of the place.
int number_of(const KeepingPlace& place, const fs::path& file) {
  const std::string name = file.filename().string();
  if (!name.starts_with(place.before)) return 0;
  const int number = std::atoi(name.c_str() + place.before.size());
  return number > 0 && place.file(number) == file ? number : 0;
}

constexpr std::string_view first_line = "// Edits that were not saved, of ";
constexpr std::string_view second_line = "// The FNV-1a hash of that file's text when they were made: ";

/// On one line, as a comment needs it: what would end the line is written as %0A and the like.
std::string in_a_comment(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    out += byte >= 0x20 && c != '%' ? std::string(1, c) : fmt::format("%{:02X}", byte);
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

std::vector<KeepingPlace> keeping_places(const fs::path& state, const std::string& what) {
  std::vector<KeepingPlace> places;
  if (!state.empty()) places.push_back({state, "unsaved-", ".json", false});
  const fs::path scene(what);
  if (scene.is_absolute())
    places.push_back({scene.parent_path(), "." + scene.filename().string() + ".unsaved-", "", true});
  return places;
}

KeptSlot::KeptSlot(KeepingPlace place, int number) : place_(std::move(place)), number_(number) {
  const fs::path file = place_.lock(number_);
  for (int attempt = 0; attempt < 100; ++attempt) {
    OpenFile lock(file, OpenFor::changing, 0600);
    error_ = lock.error();
    if (error_ == EROFS || error_ == EACCES) lock = OpenFile(file, OpenFor::reading);
    if (!lock) return;
    const int problem = lock.lock();
    error_ = problem == EWOULDBLOCK ? 0 : problem;
    if (problem != 0) return;
    if (!lock.has_name()) continue;  // another window has removed it in between: the next attempt makes a new one
    const auto free = [file, removes = place_.beside_the_scene](OpenFile* held) {
      if (removes) remove_file(file);
      delete held;
    };
    lock_ = {new OpenFile(std::move(lock)), free};
    return;
  }
}

bool KeptSlot::used() const {
  std::error_code ignored;
  return held() && fs::exists(file(), ignored);
}

KeptSlot free_slot(const KeepingPlace& place) {
  for (int number = 1; number <= max_windows; ++number) {
    KeptSlot slot(place, number);
    if (slot.error() != 0) throw IoError(place.folder.string() + ": cannot write: " + error_text(slot.error()));
    if (slot.held() && !slot.used()) return slot;
  }
  throw IoError(place.folder.string() + ": cannot write: too many windows keep edits there");
}

std::vector<fs::path> kept_files(const KeepingPlace& place) {
  std::vector<fs::path> files;
  std::error_code gone;
  for (const auto& entry : fs::directory_iterator(place.folder, gone))
    if (number_of(place, entry.path()) > 0) files.push_back(entry.path());
  return files;
}

void for_free_files(const KeepingPlace& place, const std::function<void(KeptSlot&&)>& see) {
  for (const fs::path& file : kept_files(place))
    if (KeptSlot slot(place, number_of(place, file)); slot.held()) see(std::move(slot));
}

std::string kept_text(const Scene& scene, const Origin& origin, const fs::path& folder) {
  const Scene moved = move_textures(scene, fs::absolute(origin.folder), fs::absolute(folder));
  std::string text = std::string(first_line) + in_a_comment(origin.what) + "\n";
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
