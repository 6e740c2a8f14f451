#include "app/book/load_program.h"

#include "app/text/values.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/system/child.h"
#include "core/system/files.h"
#include "core/system/open_file.h"
#include "core/system/processors.h"
#include "core/system/signals.h"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <system_error>

namespace tyndall {

namespace fs = std::filesystem;

namespace {

constexpr double seconds_for_world = 20;

/// An empty folder among the temporary files ($TMPDIR, else /tmp), only for this user; removed with all that is in it.
std::shared_ptr<const fs::path> scratch_folder() {
  int problem = 0;
  std::error_code error;
  const fs::path made = make_temporary_folder("tyndall-book-", &problem), whole = fs::canonical(made, error);
  if (made.empty())
    throw IoError(printable(temporary_folder().string()) + ": cannot make a temporary folder: " + error_text(problem));
  return {new fs::path(error ? made : whole), [](const fs::path* path) {
            std::error_code failed;
            fs::remove_all(*path, failed);
            for (fs::recursive_directory_iterator at(*path, failed), end; !failed && at != end; at.increment(failed))
              fs::permissions(at->path(), fs::perms::owner_all, fs::perm_options::add, failed);  // what was taken away
            fs::remove_all(*path, failed);
            delete path;
          }};
}

/// The last line of text, for a message; "": there is none.
std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
  return text.substr(text.find_last_of("\n\r") + 1);
}

/// Why the program has ended before its first ray.
[[noreturn]] void fail(const ProgramTask& task, const ChildEnd& end) {
  const std::string& name = task.name;
  if (end.start_error == EACCES)
    throw IoError(printable(task.folder.parent_path().string()) +
                  ": programs cannot be run in this temporary folder (is it mounted noexec?); TMPDIR names another");
  if (end.start_error != 0) throw IoError(name + ": cannot be started: " + error_text(end.start_error));
  if (end.given_up)
    throw UsageError(name + ": did not come to the colour of its first ray within " + number_text(task.seconds) +
                     " s, and was ended");
  if (end.awaited_input) throw UsageError(name + ": main() reads standard input, which tyndall does not pass on");
  const std::string words = last_line(end.errors);
  const std::string said = words.empty() ? "" : "; its last words: " + in_quotes(shortened(words, 120));
  const std::string before = " before the colour of its first ray" + said;
  if (end.signal != 0) throw UsageError(name + ": was ended by " + signal_name(end.signal) + "," + before);
  throw UsageError(name + ": ended with exit code " + std::to_string(end.exit_code) + before);
}

/// Folders that its files are looked for in, beside its own: where the user is, and those above.
std::string folders_of(const fs::path& program) {
  std::string text = fs::current_path().string() + "\n";
  fs::path above = program;
  for (int k = 0; k < 3; ++k) {
    above = above.parent_path();
    text += above.string() + "\n" + (above / "images").string() + "\n";
  }
  return text + (program / "images").string() + "\n";
}

ChildPlan plan_of(const ProgramTask& task, const CompiledProgram& program, const fs::path& main) {
  ChildPlan plan;
  plan.command = {program.file.string()};
  plan.folder = fs::absolute(main).parent_path();
  const fs::path written = task.folder / "written";
  std::error_code ignored;  // what it writes then fails
  fs::create_directories(written, ignored);
  plan.environment = {"TYNDALL_BOOK_FOLDERS=" + folders_of(plan.folder), "TYNDALL_BOOK_WRITES=" + written.string(),
                      "TMPDIR=" + written.string()};
  plan.keep_last_errors = true;
  plan.max_file = std::size_t(1) << 30;
  plan.max_memory = free_memory().bytes / 2;
  return guarded(task, plan);
}

/// Reads what the program tells before it is asked; false: it has ended before it told all, or takes too long.
bool read_messages(const ProgramTask& task, ProgramScene& scene) {
  const auto seconds = [&] { return scene.picture.width == 0 ? task.seconds : seconds_for_world; };
  while (const auto message = scene.own->next_message(seconds())) {
    const std::string& bytes = message->bytes;
    if (message->letter == 'F') scene.notes.push_back(task.name + ": cannot open " + in_quotes(printable(bytes)));
    if (message->letter == 'N') scene.notes.push_back(task.name + ": " + printable(bytes));
    if (message->letter == 'E') throw UsageError(task.name + ": " + printable(bytes));
    if (message->letter == 'I') {
      auto& values = scene.images.emplace_back(bytes.size() / sizeof(tyndall_book::image_value));
      std::memcpy(values.data(), bytes.data(), values.size() * sizeof values[0]);
    }
    if (message->letter == 'P' && bytes.size() == sizeof scene.picture)
      std::memcpy(&scene.picture, bytes.data(), bytes.size());
    if (message->letter == 'S') return (bytes.starts_with('{') ? scene.json : scene.reason) = bytes, true;
  }
  return false;
}

}  // namespace

bool is_program(const std::string& name) {
  const std::string ending = fs::path(name).extension().string();
  return ending == ".cc" || ending == ".cpp" || ending == ".cxx";
}

ProgramScene load_program(const ProgramTask& request) {
  const fs::path& main = request.sources.files.front();
  if (!runs_children())
    throw UsageError(printable(main.string()) +
                     ": is not run: builds for Windows run no programs, which need a compiler");
  const auto scratch = scratch_folder();
  ProgramTask task = request;
  task.name = printable(main.string()), task.folder = *scratch;
  const CompiledProgram program = compile_program(task);
  const SignalWatch signals(request.watch_signals ? WatchedSignals::end : WatchedSignals::none);
  const auto go_on = [&] { return signals.received() == 0 && (!request.go_on || request.go_on()); };
  ProgramScene scene;
  for (std::string failed;;) {
    scene = ProgramScene{};
    scene.files = program.sources;
    const auto remove = [scratch](OwnProgram* own) { delete own; };  // the folder lives as long as the program
    ChildPlan plan = plan_of(task, program, main);
    if (!failed.empty()) plan.environment.push_back("TYNDALL_BOOK_SAMPLES=1");
    scene.own = {new OwnProgram(task.name, plan, go_on), remove};
    const bool told = read_messages(task, scene);
    if (told && !failed.empty()) scene.reason = failed;
    if (told) break;
    const ChildEnd& end = scene.own->end();
    if (signals.received() != 0) throw ProgramInterrupted(task.name + ": interrupted while it ran", signals.received());
    if (!go_on()) throw ProgramInterrupted(task.name + ": given up while it ran", signal_terminate);
    if (scene.picture.width == 0 || !failed.empty()) fail(task, end);
    failed = end.given_up ? "its world takes more than 20 s to be read" : "it crashes while its world is looked at";
  }
  if (scene.picture.has_images && !scene.picture.decodes_images)
    scene.notes.push_back(task.name +
                          ": its program takes the numbers of images as they are, Tyndall takes them as sRGB");
  scene.own->leave_alone();
  return scene;
}

}  // namespace tyndall
