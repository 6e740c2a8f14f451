#include "app/book/compile_program.h"

#include "app/book/own_names.h"
#include "app/book/scratch_folder.h"
#include "app/book/source_text.h"
#include "app/text/values.h"
#include "core/base/error.h"
#include "core/base/text.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <system_error>

namespace tyndall {

namespace fs = std::filesystem;

namespace {

constexpr double max_seconds = 120;
constexpr std::size_t max_output = std::size_t(1) << 20;
constexpr std::size_t longest_error = 240;  // letters of one message

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// "FILE:3:7" at the beginning of a message, if that file is the reader's; else empty.
std::string reader_place(const std::string& line, const ProgramLayout& layout) {
  for (const std::string& name : layout.shown_names) {
    if (line.rfind(name + ":", 0) != 0) continue;
    const std::size_t end = line.find_first_not_of("0123456789:", name.size());
    std::string place = line.substr(0, std::min(end, line.size()));
    while (!place.empty() && place.back() == ':') place.pop_back();
    return place;
  }
  return "";
}

/// "triangle: Tyndall has no such shape (triangle.h)"; empty: the class is none of those that Tyndall would have to
/// know.
std::string no_such_class(const std::string& name, const ProgramLayout& layout) {
  const auto own = layout.own_classes.find(name);
  if (own == layout.own_classes.end()) return "";
  const char* ours = kind_of_book_class(own->second.base);
  if (!ours) return "";
  const std::string kind = std::string(ours) == "hittable" ? "shape" : ours;
  return name + ": Tyndall has no such " + kind + " (a class of your own in " + own->second.file + ")";
}

/// The class of the reader's own that the file defines, if it is a shape, a material or a texture: what a message from
/// such a file is about.
std::string own_class_in(const std::string& place, const ProgramLayout& layout) {
  for (const auto& [name, own] : layout.own_classes)
    if (place.rfind(own.file + ":", 0) == 0 && own.file != layout.shown_names.front()) {
      std::string sentence = no_such_class(name, layout);
      if (!sentence.empty()) return sentence;
    }
  return "";
}

/// Whether a message is about something that the reader's own headers may have and ours have not.
bool is_about_ours(const std::string& message, const ProgramLayout& layout) {
  for (const OwnHeader& header : layout.replaced)
    for (const Definition& one : header.definitions)
      if (one.name == quoted_name(message)) return true;
  for (const char* phrase : {"no member named", "no matching"})
    if (!layout.replaced.empty() && message.find(phrase) != std::string::npos) return true;
  return false;
}

/// Whether an error is at a place in the reader's files.
bool has_reader_place(const std::string& output, const ProgramLayout& layout) {
  for (const std::string& line : lines_of(output))
    if (line.find("error: ") != std::string::npos && !reader_place(line, layout).empty()) return true;
  return output.find("undefined reference") != std::string::npos;
}

std::string undefined_reference(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    const std::size_t at = line.find("undefined reference to ");
    if (at != std::string::npos)
      return line.substr(at) +
             " (if it is in another source file, name that, too: tyndall main.cc other.cc; libraries are not linked)";
  }
  return "";
}

/// Compilers by their names, each with arguments that the user gave.
std::vector<std::vector<std::string>> compilers(const std::string& wanted) {
  if (!wanted.empty()) return {{wanted}};
  const char* chosen = std::getenv("CXX");
  std::istringstream chosen_words(chosen ? chosen : "");
  std::vector<std::string> command;
  for (std::string word; chosen_words >> word;) command.push_back(word);
  if (!command.empty()) return {command};
  return {{"c++"}, {"g++"}, {"clang++"}};
}

[[noreturn]] void fail_without_compiler() {
  const char* chosen = std::getenv("CXX");
  if (chosen && *chosen)
    throw IoError("CXX: found " + in_quotes(chosen) + ", which cannot be run, expected a C++ compiler");
  throw IoError(
      "no C++ compiler was found (c++, g++, clang++), which is needed for programs; to install one: apt install g++");
}

/// Throws for what has nothing to do with the reader's code.
void check_end(const ProgramTask& task, const std::string& compiler, const ChildEnd& end) {
  const std::string& name = task.name;
  if (end.timed_out) throw IoError(compiler + " took more than 120 s to compile " + name + ", and was ended");
  if (end.errors.find("No space left on device") != std::string::npos)
    throw IoError(task.folder.parent_path().string() + ": temporary folder: No space left on device");
  const std::size_t killed = end.errors.find("Killed signal terminated program");
  if (end.signal != 0 || killed != std::string::npos)
    throw IoError(compiler + " was ended by " + signal_name(end.signal != 0 ? end.signal : SIGKILL) +
                  " while it compiled " + name);
}

/// Compiles by the first compiler that can be started.
ChildEnd compile(const ProgramTask& task, const std::vector<std::string>& arguments) {
  for (const std::vector<std::string>& compiler : compilers(task.compiler)) {
    ChildPlan plan;
    plan.command = compiler;
    plan.command.insert(plan.command.end(), arguments.begin(), arguments.end());
    plan.folder = task.folder / "code";
    plan.environment = {"LC_ALL=C", "TMPDIR=" + task.folder.string(), "CCACHE_DISABLE=1"};
    plan.seconds = max_seconds;
    plan.max_errors = max_output;
    ChildEnd end = run_guarded(task, plan, "it was compiled");
    if (end.start_error == ENOENT || end.start_error == EACCES) continue;
    if (end.start_error != 0)
      throw IoError(compiler[0] + " cannot be started: " + std::generic_category().message(end.start_error));
    check_end(task, compiler[0], end);
    return end;
  }
  fail_without_compiler();
}

}  // namespace

const char* kind_of_base(const std::string& base) {
  const std::string key = key_of(base);
  if (key == "hittable" || key == "hitable" || key == "hittablelist" || key == "hitablelist") return "hittable";
  return key == "material" ? "material" : key == "texture" ? "texture" : nullptr;
}

const char* kind_of_book_class(const std::string& base) {
  const auto is_one_of = [name = book_class(base)](std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (is_one_of({"sphere", "moving_sphere", "quad", "box", "xy_rect", "xz_rect", "yz_rect", "bvh_node", "translate",
                 "rotate_y", "flip_face", "flip_normals", "constant_medium"}))
    return "hittable";
  if (is_one_of({"lambertian", "metal", "dielectric", "diffuse_light", "isotropic"})) return "material";
  if (is_one_of({"solid_color", "constant_texture", "checker_texture", "image_texture", "noise_texture"}))
    return "texture";
  return kind_of_base(base);
}

std::string quoted_name(const std::string& message) {
  const std::size_t begin = message.find('\'');
  const std::size_t end = begin == std::string::npos ? begin : message.find('\'', begin + 1);
  return end == std::string::npos ? "" : message.substr(begin + 1, end - begin - 1);
}

std::string first_error(const std::string& output, const ProgramLayout& layout) {
  const std::vector<std::string> lines = lines_of(output);
  const std::string required = "required from", requested = "requested here";
  const std::string remark = "; Tyndall's headers stand in the place of yours";
  std::string caller;  // the reader's line that a template was needed for
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::string place = reader_place(lines[k], layout);
    if (!place.empty() && lines[k].find(required) != std::string::npos) caller = place;
    const std::size_t fatal = lines[k].find("fatal error: "), at = std::min(fatal, lines[k].find("error: "));
    if (at == std::string::npos || lines[k].find("undefined reference") != std::string::npos) continue;
    std::string text = lines[k].substr(at + (at == fatal ? 13 : 7));
    for (std::size_t next = k + 1; place.empty() && caller.empty() && next < lines.size(); ++next)
      if (lines[next].find(requested) != std::string::npos) caller = reader_place(lines[next], layout);
    std::string sentence = place.empty() ? caller : place;
    if (sentence.empty()) continue;
    const std::string own = no_such_class(quoted_name(text), layout), about = own_class_in(sentence, layout);
    if (!own.empty()) return sentence + ": " + own;
    if (!about.empty()) return layout.shown_names.front() + ": " + about;
    return sentence + ": " + shortened(text, longest_error) + (is_about_ours(text, layout) ? remark : "");
  }
  const std::string undefined = undefined_reference(lines);
  if (!undefined.empty()) return layout.shown_names.front() + ": " + shortened(undefined, longest_error);
  return layout.shown_names.front() + ": cannot be compiled: " +
         shortened(lines.empty() ? "the compiler does not say why" : lines.front(), longest_error);
}

namespace {

/// Compiles, and again with what is missing of the reader's own, until nothing of that is. Returns the error that
/// remains, or "".
std::string compile_with_own_names(const ProgramTask& task, const ProgramLayout& layout,
                                   std::vector<std::string> arguments) {
  constexpr int max_rounds = 8;
  OwnNames own(layout);
  std::string remaining;
  bool has_further = false;
  for (int round = 0; round < max_rounds; ++round) {
    for (const auto& [name, text] : layout.texts) write_text(task.folder / "code" / name, text);
    for (const auto& [name, text] : own.texts()) write_text(task.folder / "code" / name, text);
    const ChildEnd end = compile(task, arguments);
    if (end.succeeded()) return "";
    const std::string error = first_error(end.errors, layout);
    const bool is_missing_file = remaining.ends_with("No such file or directory");
    const bool is_unlinked = !has_further && end.errors.find("undefined reference") != std::string::npos;
    if (is_unlinked && !layout.further_files.empty()) {
      arguments.insert(arguments.end(), layout.further_files.begin(), layout.further_files.end());
      has_further = true;
      continue;
    }
    if (remaining.empty() || (!is_missing_file && has_reader_place(end.errors, layout))) remaining = error;
    if (!own.mend(end.errors)) break;
  }
  return remaining;
}

}  // namespace

void compile_program(const ProgramTask& task, const ProgramLayout& layout, const std::vector<fs::path>& include_folders,
                     const fs::path& program) {
  std::vector<std::string> errors;
  for (const char* standard : {"-std=c++17", "-std=c++20"}) {
    std::vector<std::string> arguments{
        standard, "-O0", "-w", "-pthread", "-fmax-errors=20", "-fdiagnostics-color=never"};
    arguments.insert(arguments.end(), layout.options.begin(), layout.options.end());
    for (const fs::path& folder : include_folders) arguments.insert(arguments.end(), {"-I", folder.string()});
    arguments.insert(arguments.end(), layout.compiled_files.begin(), layout.compiled_files.end());
    arguments.insert(arguments.end(), {"-o", program.string()});
    const std::string error = compile_with_own_names(task, layout, arguments);
    if (error.empty()) {
      std::error_code ignored;  // what is no program cannot be started
      fs::permissions(program, fs::perms::owner_exec, fs::perm_options::add,
                      ignored);  // a guard may refuse linkers that
      return;
    }
    errors.push_back(all_printable(error));
  }
  // What is wrong at the same place for both is told in the words of the older one, which are plainer. Else the code is
  // C++20, and the older one's error means nothing.
  const auto place = [](const std::string& error) { return error.substr(0, error.find(": ")); };
  throw UsageError(place(errors[0]) == place(errors[1]) ? errors[0] : errors[1]);
}

}  // namespace tyndall
