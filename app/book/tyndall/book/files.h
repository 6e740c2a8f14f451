#pragma once
#include <dlfcn.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

/// The files that the reader's program opens. It runs in his folder, where it cannot change anything: what it writes
/// lands in a temporary folder. What it reads is found as if it ran elsewhere in his project, too.
namespace tyndall_book {

struct opened_files {
  std::vector<std::string> read;                 ///< those that were opened to be read, last ones last
  std::map<std::string, std::string> missing;    ///< names that were not found, by their last part
  std::map<std::string, std::string> written;    ///< where a file lies that was written, by its name
  std::map<const void*, std::string> of_object;  ///< the last file that was read before a texture was made
  static opened_files& get() {
    static opened_files files;
    return files;
  }
};

/// Inserted into the constructors of textures.
inline void texture_made(const void* texture) {
  const std::vector<std::string>& read = opened_files::get().read;
  if (!read.empty()) opened_files::get().of_object[texture] = read.back();
}

using open_function = FILE* (*)(const char*, const char*);

inline FILE* open_to_read(open_function open, const std::string& name, const char* mode) {
  opened_files& files = opened_files::get();
  const auto own = files.written.find(name);
  if (own != files.written.end()) return open(own->second.c_str(), mode);
  std::string tried = name;
  FILE* file = open(name.c_str(), mode);
  const char* more = std::getenv("TYNDALL_BOOK_FOLDERS");  // each with a line end
  for (const char* at = more ? more : ""; !file && *at && name[0] != '/';) {
    const std::string folders = at, folder = folders.substr(0, folders.find('\n'));
    tried = folder + "/" + name;
    file = open(tried.c_str(), mode);
    at += folder.size() + 1;
  }
  const std::string last = name.substr(name.rfind('/') + 1);
  if (!file) {
    files.missing[last] = name;
    errno = ENOENT;
    return nullptr;
  }
  files.missing.erase(last);
  char* whole = realpath(tried.c_str(), nullptr);
  if (tried.rfind("/proc/", 0) != 0) files.read.push_back(whole ? whole : tried);
  std::free(whole);
  return file;
}

inline FILE* open_file(const char* function, const char* name, const char* mode) {
  const auto open = reinterpret_cast<open_function>(dlsym(RTLD_NEXT, function));
  const char* folder = std::getenv("TYNDALL_BOOK_WRITES");
  const std::string wanted = name;
  if (!folder || wanted.rfind("/dev/", 0) == 0) return open(name, mode);
  if (mode[0] == 'r') return open_to_read(open, wanted, mode);
  std::string& place = opened_files::get().written[wanted];
  if (place.empty()) place = std::string(folder) + "/" + std::to_string(opened_files::get().written.size());
  return open(place.c_str(), mode);
}

}  // namespace tyndall_book

extern "C" {
FILE* fopen(const char* name, const char* mode) { return tyndall_book::open_file("fopen", name, mode); }
FILE* fopen64(const char* name, const char* mode) { return tyndall_book::open_file("fopen64", name, mode); }
}
