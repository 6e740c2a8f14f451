#include "app/book/load_program.h"

#include "app/book/book_folder.h"
#include "app/book/scratch_folder.h"
#include "app/text/values.h"
#include "core/base/error.h"
#include "core/base/text.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace tyndall {

namespace fs = std::filesystem;

namespace {

/// What the program told by its pipe: see tyndall/book/parts/program.h.
struct Messages {
  std::string scene, refusal;
  std::vector<std::string> notes;
};

Messages read_messages(const std::string& text) {
  Messages all;
  for (std::size_t at = 0; at < text.size();) {
    const char kind = text[at];
    const std::size_t line = text.find('\n', at);
    if (line == std::string::npos) break;
    const auto size = static_cast<std::size_t>(std::strtoull(text.c_str() + at + 1, nullptr, 10));
    if (size > text.size() - line - 1) break;  // it was ended meanwhile
    std::string body = text.substr(line + 1, size);
    if (kind == 'S' && all.scene.empty())
      all.scene = std::move(body);
    else if (kind == 'R')
      all.refusal = std::move(body);
    else if (kind == 'N')
      all.notes.push_back(std::move(body));
    at = line + 1 + size;
  }
  return all;
}

/// The last line of text, for a message; "": there is none.
std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
  return text.substr(text.find_last_of("\n\r") + 1);
}

constexpr const char* goal = "camera::render() or the pixels of a loop";

/// Why there is no scene.
[[noreturn]] void fail(const ProgramRequest& request, const ProgramTask& task, const ChildEnd& end) {
  const std::string& name = task.name;
  if (end.start_error == EACCES)
    throw IoError(printable(task.folder.parent_path().string()) +
                  ": programs cannot be run in this temporary folder (is it mounted noexec?); TMPDIR names another");
  if (end.start_error != 0)
    throw IoError(name + ": cannot be started: " + std::generic_category().message(end.start_error));
  if (end.timed_out)
    throw UsageError(name + ": did not come to " + goal + " within " + number_text(request.seconds) +
                     " s, and was ended");
  if (end.awaited_input) throw UsageError(name + ": main() reads standard input, which tyndall does not pass on");
  const std::string words = last_line(end.errors);
  const std::string said = words.empty() ? "" : "; its last words: " + in_quotes(shortened(words, 120));
  if (end.signal != 0) throw UsageError(name + ": was ended by " + signal_name(end.signal) + ", before " + goal + said);
  throw UsageError(name + ": ended with exit code " + std::to_string(end.exit_code) + " before " + goal + said);
}

/// The folder that the program runs in, with copies of what it may read.
fs::path running_folder(const fs::path& scratch, const ProgramLayout& layout, const fs::path& reader) {
  fs::path folder = scratch / "run" / "here";
  std::error_code error;
  fs::create_directories(folder, error);
  for (const fs::path& file : layout.data) {
    const fs::path copy = folder / file;
    fs::create_directories(copy.parent_path(), error);
    fs::copy_file(reader / file, copy, error);
    fs::permissions(copy, fs::perms::owner_write, fs::perm_options::add, error);
  }
  return folder;
}

ChildEnd run(const ProgramRequest& request, const ProgramTask& task, const ProgramLayout& layout,
             const fs::path& program) {
  const fs::path reader = fs::absolute(request.sources.files.front()).parent_path();
  ChildPlan plan;
  plan.command = {program.string()};
  plan.folder = running_folder(task.folder, layout, request.sources.files.front().parent_path());
  plan.environment = {"TYNDALL_BOOK_FOLDERS=" + reader.string() + "\n" + fs::current_path().string() + "\n",
                      "TMPDIR=" + plan.folder.string()};
  if (!layout.sky.empty()) plan.environment.push_back("TYNDALL_BOOK_SKY=" + layout.sky);
  plan.pipe_variable = "TYNDALL_BOOK_PIPE";
  plan.seconds = request.seconds;
  plan.seconds_after_message = 2;
  plan.keep_last_errors = true;
  return run_guarded(task, plan, "it ran");
}

void choose_generator(ProgramLayout& layout, const std::vector<std::string>& options) {
  std::erase_if(layout.options, [](const std::string& option) {
    return option.starts_with("-DTYNDALL_BOOK_ENGINE") || option.starts_with("-DTYNDALL_BOOK_SEED") ||
           option == "-DTYNDALL_BOOK_DRAND48";
  });
  layout.options.insert(layout.options.end(), options.begin(), options.end());
}

std::vector<fs::path> whole_paths(const std::vector<fs::path>& paths) {
  std::vector<fs::path> whole;
  for (const fs::path& path : paths) whole.push_back(fs::absolute(path));
  return whole;
}

}  // namespace

bool is_program(const std::string& name) {
  const std::string ending = fs::path(name).extension().string();
  return ending == ".cc" || ending == ".cpp" || ending == ".cxx";
}

ProgramScene load_program(const ProgramRequest& request) {
  const fs::path& main = request.sources.files.front();
  const fs::path headers = fs::absolute(book_folder());
  ProgramLayout layout = lay_out(request.sources, headers);
  if (request.build.random) choose_generator(layout, *request.build.random);
  const ScratchFolder scratch;
  for (const auto& [name, text] : layout.texts) scratch.write(fs::path("code") / name, text);
  const ProgramTask task{printable(main.string()), scratch.path(),  request.go_on,
                         request.watch_signals,    request.trusted, request.build.compiler};
  std::vector<fs::path> folders{headers};  // ours first
  for (const fs::path& folder : whole_paths(request.sources.include_folders)) folders.push_back(folder);
  const fs::path program = scratch.path() / "program";
  compile_program(task, layout, folders, program);
  const ChildEnd end = run(request, task, layout, program);
  Messages told = read_messages(end.messages);
  if (told.scene.empty() && !told.refusal.empty()) throw UsageError(task.name + ": " + printable(told.refusal));
  if (told.scene.empty()) fail(request, task, end);
  ProgramScene scene{std::move(told.scene), {}, layout.files};
  for (const std::string& note : told.notes) scene.notes.push_back(task.name + ": " + printable(note));
  const bool from_loop = !told.notes.empty() && told.notes.front().rfind("from the loop", 0) == 0;
  if (layout.unknown_sky && !from_loop)
    scene.notes.push_back(task.name +
                          ": camera.h draws a sky of its own, which Tyndall does not read; here it is the "
                          "first book's, unless main() sets cam.background");
  if (end.signal != 0)
    scene.notes.push_back(task.name + ": was ended by " + signal_name(end.signal) + ", after its scene was taken");
  return scene;
}

}  // namespace tyndall
