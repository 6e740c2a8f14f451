#pragma once
#include "program.h"

#include <sys/wait.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <string>

/// Renders the scene of a program that was started by hand: as the books' programs do, a picture on standard output, or
/// a file, or the window.
namespace tyndall_book {

inline std::string shell_word(const std::string& text) {
  std::string argument = "'";
  for (const char c : text) argument += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return argument + "'";
}

/// The folder above, by its name alone: a link to a folder is not followed.
inline std::string above(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? "." : path.substr(0, slash);
}

/// The program tyndall: where it was installed with these headers, or beside them in a build; else in PATH. Empty:
/// none.
inline std::string find_tyndall() {
  const std::string folder = above(above(__FILE__));  // .../share/tyndall/book, or .../book beside the program
  std::string candidates = above(above(above(folder))) + "/bin\n" + above(folder) + "\n";
  const char* path = std::getenv("PATH");
  for (const char* c = path ? path : ""; *c; ++c) candidates += *c == ':' ? '\n' : *c;
  candidates += '\n';
  for (std::size_t at = 0; at < candidates.size(); at = candidates.find('\n', at) + 1) {
    const std::string file = candidates.substr(at, candidates.find('\n', at) - at) + "/tyndall";
    if (access(file.c_str(), X_OK) == 0 && std::ifstream(file)) return file;
  }
  return "";
}

/// The file that `-o FILE` on the program's command line, or else TYNDALL_OUTPUT, names; empty: none.
inline std::string output_file() {
  std::ifstream arguments("/proc/self/cmdline", std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(arguments)), std::istreambuf_iterator<char>());
  const std::size_t option = text.find(std::string("\0-o\0", 4));
  if (option != std::string::npos) return text.c_str() + option + 4;
  const char* named = std::getenv("TYNDALL_OUTPUT");
  return named ? named : "";
}

inline bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

[[noreturn]] inline void fail(const std::string& why) {
  std::fflush(nullptr);
  std::fprintf(stderr, "tyndall: %s\n", why.c_str());
  std::_Exit(3);
}

/// Runs tyndall with these arguments, which a shell reads, and the scene as its standard input. Ends the program with
/// tyndall's exit code unless that is 0.
inline void run_tyndall(const std::string& arguments, const std::string& scene) {
  const std::string program = find_tyndall();
  if (program.empty()) fail("the program tyndall is neither beside these headers nor in PATH");
  std::fflush(nullptr);
  void (*before)(int) = std::signal(SIGPIPE, SIG_IGN);
  std::FILE* input = popen((shell_word(program) + " " + arguments).c_str(), "w");
  if (!input) fail(program + " cannot be started");
  std::fwrite(scene.data(), 1, scene.size(), input);
  const int status = pclose(input);
  std::signal(SIGPIPE, before);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  std::fflush(nullptr);
  std::_Exit(WIFEXITED(status) ? WEXITSTATUS(status) : 3);
}

inline bool is_ppm(const std::string& file) { return file.size() > 4 && file.substr(file.size() - 4) == ".ppm"; }

/// Shows or renders the scene, where a picture belongs.
inline void show(const std::string& scene) {
  const std::string file = output_file();
  if (!file.empty())
    return run_tyndall("render - " + std::string(is_ppm(file) ? "--gamma2 " : "") + "-o " + shell_word(file), scene);
  if (!isatty(STDOUT_FILENO)) return run_tyndall("render - --format ppm --gamma2 -o -", scene);
  if (is_set("DISPLAY") || is_set("WAYLAND_DISPLAY")) return run_tyndall("view -", scene);
  fail("there is no display for a window, and standard output is a terminal: use > image.ppm or -o FILE");
}

/// Renders the scene, and writes its pixels as rows of numbers, 0 to 255, as the loops in main() do. The header is
/// there.
inline void write_rows(const std::string& scene, std::ostream& out) {
  const char* folder = std::getenv("TMPDIR");
  std::string file = std::string(folder && *folder ? folder : "/tmp") + "/tyndall-XXXXXX.ppm";
  const int descriptor = mkstemps(&file[0], 4);
  if (descriptor < 0) fail(file + ": cannot be written");
  close(descriptor);
  run_tyndall("render - --gamma2 -o " + shell_word(file), scene);
  std::ifstream picture(file, std::ios::binary);
  std::string kind;
  int width = 0, height = 0, largest = 0;
  picture >> kind >> width >> height >> largest;
  picture.get();
  for (long pixel = 0; pixel < static_cast<long>(width) * height; ++pixel) {
    const int red = picture.get(), green = picture.get(), blue = picture.get();
    out << red << ' ' << green << ' ' << blue << '\n';
  }
  out.flush();
  std::remove(file.c_str());
}

/// Hands the scene to the caller, or shows it.
inline void deliver(const std::string& scene) {
  if (caller() >= 0)
    tell_caller('S', scene);
  else
    show(scene);
}

}  // namespace tyndall_book
