#include "app/book/compile_program.h"

#include "app/book/program_outline.h"
#include "app/text/values.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/system/files.h"
#include "core/system/open_file.h"
#include "core/system/signals.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <system_error>
#include <utility>

namespace tyndall {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t longest_error = 240;  // letters of one message
constexpr char library_name[] = "libtyndall-book.so";

void write_text(const fs::path& file, const std::string& text) {
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  if (!(out << text << std::flush))
    throw IoError(printable(file.parent_path().string()) + ": cannot write temporary files: " + error_text(errno));
}
std::string read_text(const fs::path& file) {
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  if (!in.is_open() || in.bad()) throw IoError(printable(file.string()) + ": cannot be read: " + error_text(errno));
  return text;
}

/// The folder of our headers, and of the library that is linked to readers' programs: lib/tyndall/book of the
/// installation, or beside the program.
fs::path book_folder() {
  std::error_code error;
  const fs::path program = own_file().parent_path();
  for (const fs::path& place : {program.parent_path(), program})
    if (const fs::path folder = place / "lib/tyndall/book"; fs::is_regular_file(folder / library_name, error))
      return fs::canonical(folder);
  throw IoError((program / "lib/tyndall/book").string() + ": " + library_name +
                ", which readers' programs are linked to, was found neither there nor in the installation");
}

/// What the user names as the compiler, with arguments; "": nothing.
std::string chosen_compiler() {
  const char* chosen = std::getenv("CXX");
  return chosen ? chosen : "";
}
/// Compilers by their names, each with arguments that the user gave.
std::vector<std::vector<std::string>> compilers(const std::string& wanted) {
  if (!wanted.empty()) return {{wanted}};
  std::istringstream parts(chosen_compiler());
  const std::vector<std::string> command{std::istream_iterator<std::string>(parts), {}};
  if (!command.empty()) return {command};
  return {{"c++"}, {"g++"}, {"clang++"}};
}

/// Throws for what has nothing to do with the reader's code.
void check_end(const ProgramTask& task, const std::string& compiler, const ChildEnd& end) {
  const std::string& name = task.name;
  if (end.timed_out) throw IoError(compiler + " took more than 120 s to compile " + name + ", and was ended");
  if (end.errors.find("No space left on device") != std::string::npos)
    throw IoError(task.folder.parent_path().string() + ": temporary folder: No space left on device");
  const std::size_t killed = end.errors.find("Killed signal terminated program");
  if (end.signal != 0 || killed != std::string::npos)
    throw IoError(compiler + " was ended by " + signal_name(end.signal != 0 ? end.signal : signal_kill) +
                  " while it compiled " + name);
}

/// A file as the user names it: from the folder of main as he named that.
std::string shown(const std::string& file, const fs::path& main) {
  const fs::path below = fs::path(file).lexically_relative(fs::absolute(main).lexically_normal().parent_path());
  return below.empty() ? file : (main.parent_path() / below).lexically_normal().string();
}

/// The source file beside a header, or in a folder src beside its own, that defines what it announces; empty: none.
fs::path source_beside(const fs::path& header) {
  const fs::path folder = header.parent_path();
  std::error_code error;
  for (const fs::path& place : {folder, folder.parent_path() / "src", folder.parent_path() / "source"})
    for (const char* ending : {".cpp", ".cc", ".cxx"}) {
      fs::path file = place / header.stem().concat(ending);
      if (fs::is_regular_file(file, error)) return file;
    }
  return {};
}

/// The header that no folder has, from what a compiler says; empty: it says something else.
std::string missing_header(const std::string& errors) {
  static const std::regex gcc("fatal error: ([^\\s]+): No such file"), clang("fatal error: '([^']+)' file not found");
  std::smatch found;
  return std::regex_search(errors, found, gcc) || std::regex_search(errors, found, clang) ? found[1].str() : "";
}

/// The folder in the program's own, or in the one or two above it, that holds a header, such as ../common; empty: none.
/// It does not look beyond the program's repository.
fs::path folder_with(const std::string& header, const fs::path& program) {
  std::error_code error;
  fs::path above = program.parent_path(), first;
  for (int up = 0; up < 3 && !header.empty() && first.empty(); ++up, above = above.parent_path()) {
    for (const fs::directory_entry& entry : fs::directory_iterator(above, error))
      if (fs::is_regular_file(entry.path() / header, error) && (first.empty() || entry.path() < first))
        first = entry.path();
    if (fs::exists(above / ".git", error)) break;
  }
  return first;
}

template <class T>
bool holds(const std::vector<T>& all, const T& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// Of the reader's code.
struct CompilerError {
  std::string text;
};

class Compilation {
 public:
  explicit Compilation(const ProgramTask& task)
      : task_(task), main_(task.sources.files.front()), headers_(book_folder()) {
    for (const fs::path& file : task.sources.files) sources_.push_back(fs::absolute(file).lexically_normal());
    for (const fs::path& folder : task.sources.include_folders)
      options_.insert(options_.end(), {"-I", fs::absolute(folder).string()});
  }

  CompiledProgram run() {
    std::vector<std::string> errors;
    for (const char* standard : {"-std=c++17", "-std=c++20"}) try {
        standard_ = standard;
        preprocess();
        for (const bool reads_world : {true, false}) {
          const InsertedCalls calls = insert_calls(text_, outline_, reads_world);
          if (!calls.problem.empty()) throw UsageError(task_.name + ": " + calls.problem);
          if (compile(calls.text, reads_world)) return {task_.folder / "program", outline_.files};
        }
      } catch (const CompilerError& error) {
        errors.push_back(all_printable(error.text));
      }
    // What is wrong at the same place for both is told in the words of the older one, which are plainer. Else the code
    // is C++20, and the older one's error means nothing.
    const auto place = [](const std::string& error) { return error.substr(0, error.find(": ")); };
    throw UsageError(place(errors.front()) == place(errors.back()) ? errors.front() : errors.back());
  }

 private:
  /// Makes the text of the program and its outline.
  void preprocess() {
    for (std::size_t known = 0; known != sources_.size();) {
      known = sources_.size();
      std::string all = "#include \"" + (headers_ / "take.h").string() + "\"\n";
      for (const fs::path& source : sources_) all += "#include \"" + source.string() + "\"\n";
      const fs::path file = task_.folder / "all.cc";
      write_text(file, all);
      const ChildEnd end = call({"-E", file.string(), "-o", "all.ii"});
      if (!end.succeeded()) {
        const fs::path folder = folder_with(missing_header(end.errors), sources_.front());
        if (folder.empty() || holds(options_, folder.string())) throw CompilerError{first_error(end.errors, main_)};
        options_.insert(options_.end(), {"-I", folder.string()});
        known = 0;
        continue;
      }
      text_ = read_text(task_.folder / "all.ii");
      outline_ = outline_of(text_, {headers_, task_.folder});
      add_sources();
    }
  }
  void add_sources() {
    for (const fs::path& file : outline_.files)
      if (const fs::path source = source_beside(file);
          !source.empty() && !holds(sources_, source) && !holds(outline_.files, source))
        sources_.push_back(source);
  }
  /// False: it fails in our headers, where his world is read.
  bool compile(const std::string& text, bool reads_world) {
    write_text(task_.folder / "program.ii", text);
    const ChildEnd end = call({"-O1", "-fno-access-control", "-fpermissive", "program.ii",
                               (headers_ / library_name).string(), "-o", "program"});
    std::error_code ignored;  // what is no program cannot be started
    if (end.succeeded())      // a guard may refuse linkers that
      return fs::permissions(task_.folder / "program", fs::perms::owner_exec, fs::perm_options::add, ignored), true;
    const std::size_t first = end.errors.rfind('\n', end.errors.find("error: "));
    const std::string place = end.errors.substr(first == std::string::npos ? 0 : first + 1);
    if (reads_world && (place.rfind(headers_.string(), 0) == 0 || place.rfind("tyndall/book/", 0) == 0)) return false;
    throw CompilerError{first_error(end.errors, main_)};
  }
  /// Calls the first compiler that can be started.
  ChildEnd call(const std::vector<std::string>& more) const {
    for (const std::vector<std::string>& compiler : compilers(task_.compiler)) {
      ChildPlan plan;
      plan.command = compiler;
      for (const auto& part :
           {std::vector<std::string>{standard_, "-w", "-pthread", "-fmax-errors=20", "-fdiagnostics-color=never"},
            options_, more})
        plan.command.insert(plan.command.end(), part.begin(), part.end());
      plan.folder = task_.folder;
      plan.environment = {"LC_ALL=C", "TMPDIR=" + task_.folder.string(), "CCACHE_DISABLE=1"};
      plan.seconds = 120;
      plan.max_errors = std::size_t(1) << 20;
      ChildEnd end = run_guarded(task_, plan, "it was compiled");
      if (end.start_error == ENOENT || end.start_error == EACCES) continue;
      if (end.start_error != 0) throw IoError(compiler[0] + " cannot be started: " + error_text(end.start_error));
      check_end(task_, compiler[0], end);
      return end;
    }
    if (const std::string chosen = chosen_compiler(); !chosen.empty())
      throw IoError("CXX: found " + in_quotes(chosen) + ", which cannot be run, expected a C++ compiler");
    throw IoError(
        "no C++ compiler was found (c++, g++, clang++), which is needed for programs; to install one: apt install g++");
  }

  const ProgramTask& task_;
  fs::path main_, headers_;
  std::vector<fs::path> sources_;
  std::vector<std::string> options_;
  std::string standard_, text_;
  ProgramOutline outline_;
};

}  // namespace

ChildPlan guarded(const ProgramTask& task, ChildPlan plan) {
  plan.guard = available_guard();
  plan.own_folder = task.folder;
  if (!plan.guard.any() && !task.trusted)
    throw UsageError(
        task.name +
        ": is not run: this system has nothing that keeps a program from changing your files (neither user "
        "namespaces nor Landlock); --trust runs it as it is");
  return plan;
}

ChildEnd run_guarded(const ProgramTask& task, ChildPlan plan, const std::string& doing) {
  plan = guarded(task, std::move(plan));
  const SignalWatch signals(task.watch_signals ? WatchedSignals::end : WatchedSignals::none);
  plan.go_on = [&] { return signals.received() == 0 && (!task.go_on || task.go_on()); };
  ChildEnd end = run_child(plan);
  if (signals.received() != 0) throw ProgramInterrupted(task.name + ": interrupted while " + doing, signals.received());
  if (end.given_up) throw ProgramInterrupted(task.name + ": given up while " + doing, signal_terminate);
  return end;
}

std::string first_error(const std::string& output, const fs::path& main) {
  std::istringstream lines(output);
  std::string first, undefined;
  for (std::string line; std::getline(lines, line);) {
    if (first.empty()) first = line;
    const std::size_t fatal = line.find("fatal error: "), at = std::min(fatal, line.find("error: "));
    const std::size_t place = line.find(':'), reference = line.find("undefined reference to ");
    if (reference != std::string::npos && undefined.empty())
      undefined =
          line.substr(reference) +
          " (if it is in another source file, name that, too: tyndall main.cc other.cc; libraries are not linked)";
    if (at == std::string::npos || place >= at || reference != std::string::npos || line.rfind("collect2", 0) == 0)
      continue;
    return shown(line.substr(0, place), main) + line.substr(place, at - place) +
           shortened(line.substr(at + (at == fatal ? 13 : 7)), longest_error);
  }
  if (!undefined.empty()) return main.string() + ": " + shortened(undefined, longest_error);
  if (first.empty()) first = "the compiler does not say why";
  return main.string() + ": cannot be compiled: " + shortened(first, longest_error);
}

CompiledProgram compile_program(const ProgramTask& task) { return Compilation(task).run(); }

}  // namespace tyndall
