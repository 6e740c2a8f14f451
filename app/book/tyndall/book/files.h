#pragma once
#include "values.h"

#include <dlfcn.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <sstream>
#include <string>
#include <vector>

/// The files that the reader's program opens. It runs in his folder, where it cannot change anything: what it writes
/// lands in a temporary folder. What it reads is found as if it ran elsewhere in his project, too.
namespace tyndall_book {

struct opened_files {
  std::vector<std::string> read;                  ///< those that were opened to be read, last ones last
  std::vector<std::string> missing;               ///< names that were not found
  std::map<std::string, std::string> written;     ///< where a file of that name lies that was written
  std::map<const void*, std::string> of_objects;  ///< the last file that was read before a texture was made
  static opened_files& get() {
    static opened_files files;
    return files;
  }
};
inline std::string last_part(const std::string& name) { return name.substr(name.rfind('/') + 1); }

/// Inserted into the constructors of textures.
inline void texture_made(const void* texture) {
  opened_files& files = opened_files::get();
  if (!files.read.empty()) files.of_objects[texture] = files.read.back();
}

using open_function = FILE* (*)(const char*, const char*);

inline FILE* open_to_read(open_function open, const std::string& name, const char* mode) {
  opened_files& files = opened_files::get();
  if (const auto own = files.written.find(name); own != files.written.end()) return open(own->second.c_str(), mode);
  std::string tried = name;
  FILE* file = open(name.c_str(), mode);
  const char* more = std::getenv("TYNDALL_BOOK_FOLDERS");  // each with a line end
  std::istringstream folders(more ? more : "");
  for (std::string folder; !file && name[0] != '/' && std::getline(folders, folder);) {
    tried = folder + "/" + name;
    file = open(tried.c_str(), mode);
  }
  for (std::string& other : files.missing)
    if (last_part(other) == last_part(name)) other.clear();
  if (!file) {
    files.missing.push_back(name);
    errno = ENOENT;
    return nullptr;
  }
  char* whole = realpath(tried.c_str(), nullptr);
  if (tried.rfind("/proc/", 0) != 0) files.read.push_back(whole ? whole : tried);
  std::free(whole);
  return file;
}

/// Where a file lies that is written; "": where it wants to.
inline std::string place_of(const std::string& name) {
  const char* folder = std::getenv("TYNDALL_BOOK_WRITES");
  if (!folder || name.rfind("/dev/", 0) == 0) return "";
  std::map<std::string, std::string>& written = opened_files::get().written;
  return written.try_emplace(name, folder + ("/" + std::to_string(written.size()))).first->second;
}
inline FILE* open_file(const char* function, const char* name, const char* mode) {
  const auto open = reinterpret_cast<open_function>(dlsym(RTLD_NEXT, function));
  if (mode[0] == 'r') return open_to_read(open, name, mode);
  const std::string place = place_of(name);
  return open(place.empty() ? name : place.c_str(), mode);
}
inline const FILE* const standard_output = std::freopen(place_of("standard output").c_str(), "w", stdout);

/// Reads the size at the head of the picture that the program has begun to write; false: it has not yet.
inline bool read_head(picture_told& picture) {
  std::fflush(nullptr);
  for (const auto& [name, place] : opened_files::get().written) {
    char text[4096] = {};  // other words may come first
    FILE* in = reinterpret_cast<open_function>(dlsym(RTLD_NEXT, "fopen"))(place.c_str(), "r");
    if (!in) continue;
    std::fread(text, 1, sizeof text - 1, in);
    std::fclose(in);
    const char *plain = std::strstr(text, "P3"), *at = plain ? plain : std::strstr(text, "P6");
    if (!at) continue;
    at += 2 + std::strspn(at + 2, " \r\n");
    while (*at == '#') at += std::strcspn(at, "\n"), at += std::strspn(at, " \r\n");
    int sides[2] = {};
    if (std::sscanf(at, "%d %d", sides, sides + 1) == 2)
      return picture.width = sides[0], picture.height = sides[1], sides[0] > 1 && sides[1] > 1;
  }
  return false;
}

}  // namespace tyndall_book

extern "C" {
FILE* fopen(const char* name, const char* mode) { return tyndall_book::open_file("fopen", name, mode); }
FILE* fopen64(const char* name, const char* mode) { return tyndall_book::open_file("fopen64", name, mode); }
}
