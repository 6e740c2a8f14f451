#include "app/book/inside/inside.h"

#include <fmt/core.h>

#include <sys/wait.h>
#include <cxxabi.h>
#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
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
  std::map<const void*, std::string> of_objects;  ///< the last file that was read when a texture was made
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

using Clock = std::chrono::steady_clock;
pid_t alone = -1;  ///< the process that goes on alone; -1: there is none
Clock::time_point alone_since;

/// The pictures that were written, each from its head on; other words may come before.
std::vector<std::string> written_pictures() {
  constexpr std::size_t largest = std::size_t(1) << 26;  // bytes of a file that are looked at
  std::vector<std::string> pictures;
  for (const auto& [name, place] : files().written) {
    std::string text;
    char bytes[65536];
    FILE* in = open_file("fopen", place.c_str(), "r");
    for (std::size_t size = 1; in && size > 0 && text.size() < largest; text.append(bytes, size))
      size = std::fread(bytes, 1, sizeof bytes, in);
    if (in) std::fclose(in);
    const std::string head = text.find("P3") != std::string::npos ? "P3" : "P6";
    for (std::size_t at = text.find(head), next = 0; at != std::string::npos; at = next)
      next = text.find(head, at + 2), pictures.push_back(text.substr(at, next - at));
  }
  return pictures;
}

}  // namespace

texture_made::~texture_made() {
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
  for (const std::string& one : written_pictures()) {
    const char* at = one.c_str() + 2;
    at += std::strspn(at, " \r\n");
    while (*at == '#') at += std::strcspn(at, "\n"), at += std::strspn(at, " \r\n");
    int width = 0, height = 0;
    if (std::sscanf(at, "%d %d", &width, &height) == 2)
      return picture.width = width, picture.height = height, width > 1 && height > 1;
  }
  return false;
}

bool goes_on_alone() {
  std::fflush(nullptr);
  alone = fork(), alone_since = Clock::now();
  loop().alone = alone == 0;
  if (loop().alone) alarm(2), close(channel());
  return loop().alone;
}

std::vector<std::string> seen_alone() {
  const Clock::time_point latest = alone_since + std::chrono::milliseconds(200);
  bool runs = alone > 0;
  while (runs && (runs = waitpid(alone, nullptr, WNOHANG) == 0) && Clock::now() < latest) usleep(5000);
  if (runs && kill(alone, SIGKILL) == 0) waitpid(alone, nullptr, 0);  // where that is refused it ends by itself
  std::vector<std::string> seen;
  const std::vector<std::string> pictures = written_pictures();
  if (pictures.size() > 1) seen.push_back("it makes more pictures than one; this is the first");
  std::istringstream numbers(pictures.empty() ? "" : pictures[0].substr(2));
  int width = 0, height = 0, white = 0, pixel[3] = {}, last[3] = {};
  numbers >> width >> height >> white;
  const bool has_bytes = !pictures.empty() && pictures[0][1] == '6' && numbers.get() != EOF;
  const auto read = [&](int& value) {
    return has_bytes ? (value = numbers.get()) != EOF : static_cast<bool>(numbers >> value);
  };
  while (read(pixel[0]) && read(pixel[1]) && read(pixel[2]))  // the first ones were black
    if (pixel[0] + pixel[1] + pixel[2] > 0) std::copy(pixel, pixel + 3, last);
  // By the square root, a power of 2.2 or sRGB's curve, rounded in any way. Programs that never have light above white
  // need not end there.
  const auto is_shown = [&](int channel, double low, double high) {
    return last[channel] > (low - 0.012) * white && last[channel] < (high + 0.012) * white;
  };
  if (last[2] > 0 && !(is_shown(0, 0.5, 0.54) && is_shown(1, 0.8, 0.83) && is_shown(2, 1, 9)))
    seen.push_back(fmt::format(
        "it writes light of (0.25, 0.64, 4) as ({}, {}, {}), the books' programs as (128, 204, 255); Tyndall "
        "shows it by sRGB's curve",
        last[0], last[1], last[2]));
  return seen;
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
