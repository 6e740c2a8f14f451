#include "app/book/inside/inside.h"

#include <cxxabi.h>
#include <dlfcn.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <sstream>

/// The files that the reader's program opens. It runs in his folder, where it cannot change anything: what it writes
/// lands in a temporary folder. What it reads is found as if it ran elsewhere in his project, too.
namespace tyndall_book {
namespace {

namespace fs = std::filesystem;

struct OpenedFiles {
  std::vector<std::string> read;                  ///< those that were opened to be read, last ones last
  std::vector<std::string> missing;               ///< names that were not found
  std::map<std::string, std::string> written;     ///< where a file of that name lies that was written
  std::map<const void*, std::string> of_objects;  ///< the last file that was read before a texture was made
};
OpenedFiles& files() {
  static OpenedFiles opened;
  return opened;
}

std::string from_environment(const char* name) {
  const char* text = std::getenv(name);
  return text ? text : "";
}

FILE* open_file(const char* function, const char* name, const char* mode) {
  return reinterpret_cast<FILE* (*)(const char*, const char*)>(dlsym(RTLD_NEXT, function))(name, mode);
}

FILE* open_to_read(const char* function, const std::string& name, const char* mode) {
  const auto own = files().written.find(name);
  if (own != files().written.end()) return open_file(function, own->second.c_str(), mode);
  std::string tried = name;
  FILE* file = open_file(function, name.c_str(), mode);
  std::istringstream folders(from_environment("TYNDALL_BOOK_FOLDERS"));  // each with a line end
  for (std::string folder; !file && name[0] != '/' && std::getline(folders, folder);) {
    tried = folder.append("/").append(name);
    file = open_file(function, tried.c_str(), mode);
  }
  std::erase_if(files().missing, [&](const fs::path& other) { return other.filename() == fs::path(name).filename(); });
  if (!file) {
    files().missing.push_back(name);
    errno = ENOENT;
    return nullptr;
  }
  std::error_code error;
  const fs::path whole = fs::canonical(tried, error);
  if (!tried.starts_with("/proc/")) files().read.push_back(error ? tried : whole.string());
  return file;
}

/// Where a file lies that is written; "": where it wants to.
std::string place_of(const std::string& name) {
  const std::string folder = from_environment("TYNDALL_BOOK_WRITES");
  if (folder.empty() || name.starts_with("/dev/")) return "";
  auto& written = files().written;
  return written.try_emplace(name, folder + "/" + std::to_string(written.size())).first->second;
}

FILE* open_in_place(const char* function, const char* name, const char* mode) {
  if (mode[0] == 'r') return open_to_read(function, name, mode);
  const std::string place = place_of(name);
  return open_file(function, place.empty() ? name : place.c_str(), mode);
}

const FILE* const standard_output = std::freopen(place_of("standard output").c_str(), "w", stdout);

int channel() {
  static const int descriptor = std::stoi(from_environment("TYNDALL_BOOK_CHANNEL"));
  return descriptor;
}
/// Moves all bytes by the system's read() or write(); without the house the program has nothing to do.
template <class Move, class Byte>
void move_all(const Move& move, Byte* at, std::size_t size) {
  while (size > 0) {
    const auto moved = move(channel(), at, size);
    if (moved <= 0) std::_Exit(0);
    at += moved, size -= static_cast<std::size_t>(moved);
  }
}

}  // namespace

void texture_made(const void* texture) {
  if (!files().read.empty()) files().of_objects[texture] = files().read.back();
}
std::string file_of(const void* texture) { return files().of_objects[texture]; }
std::vector<std::string> missing_files() { return files().missing; }

std::string class_name(const char* mangled) {
  int failed = 0;
  char* name = abi::__cxa_demangle(mangled, nullptr, nullptr, &failed);
  std::string text = name ? name : mangled;
  std::free(name);
  return text;
}

bool read_head(picture_told& picture) {
  std::fflush(nullptr);
  for (const auto& [name, place] : files().written) {
    char text[4096] = {};  // other words may come first
    FILE* in = open_file("fopen", place.c_str(), "r");
    if (!in) continue;
    const bool has_text = std::fread(text, 1, sizeof text - 1, in) > 0;
    std::fclose(in);
    const char *plain = std::strstr(text, "P3"), *at = plain ? plain : std::strstr(text, "P6");
    if (!has_text || !at) continue;
    at += 2 + std::strspn(at + 2, " \r\n");
    while (*at == '#') at += std::strcspn(at, "\n"), at += std::strspn(at, " \r\n");
    int width = 0, height = 0;
    if (std::sscanf(at, "%d %d", &width, &height) == 2)
      return picture.width = width, picture.height = height, width > 1 && height > 1;
  }
  return false;
}

void tell(char letter, const void* bytes, std::size_t size) {
  const message_head head{double(letter), static_cast<double>(size)};
  move_all(write, reinterpret_cast<const char*>(&head), sizeof head);
  move_all(write, static_cast<const char*>(bytes), size);
}
void give_up(const std::string& why) {
  tell('E', why);
  std::_Exit(0);
}
std::string next_message() {
  message_head head;
  move_all(read, reinterpret_cast<char*>(&head), sizeof head);
  std::string bytes(static_cast<std::size_t>(head.size), '\0');
  move_all(read, bytes.data(), bytes.size());
  return bytes;
}

}  // namespace tyndall_book

#pragma GCC visibility push(default)
extern "C" {
FILE* fopen(const char* name, const char* mode) { return tyndall_book::open_in_place("fopen", name, mode); }
FILE* fopen64(const char* name, const char* mode) { return tyndall_book::open_in_place("fopen64", name, mode); }
}
#pragma GCC visibility pop
