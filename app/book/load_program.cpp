#include "app/book/load_program.h"

#include "app/book/scratch_folder.h"
#include "app/text/values.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/system/child.h"
#include "core/system/open_file.h"
#include "core/system/processors.h"
#include "core/system/signals.h"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <sstream>
#include <system_error>

namespace tyndall {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t max_file = std::size_t(1) << 30;
constexpr const char* crashed = "it crashes while its world is looked at";

/// The last line of text, for a message; "": there is none.
std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
  return text.substr(text.find_last_of("\n\r") + 1);
}

/// Why the program has ended before its first ray.
[[noreturn]] void fail(const ProgramRequest& request, const ProgramTask& task, const ChildEnd& end) {
  const std::string& name = task.name;
  if (end.start_error == EACCES)
    throw IoError(printable(task.folder.parent_path().string()) +
                  ": programs cannot be run in this temporary folder (is it mounted noexec?); TMPDIR names another");
  if (end.start_error != 0) throw IoError(name + ": cannot be started: " + error_text(end.start_error));
  if (end.given_up)
    throw UsageError(name + ": did not come to the colour of its first ray within " + number_text(request.seconds) +
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

ChildPlan plan_of(const ProgramTask& task, const CompiledProgram& program, const fs::path& main,
                  const char* only_samples) {
  ChildPlan plan;
  plan.command = {program.file.string()};
  plan.folder = fs::absolute(main).parent_path();
  const fs::path written = task.folder / "written";
  std::error_code ignored;  // what it writes then fails
  fs::create_directories(written, ignored);
  plan.environment = {"TYNDALL_BOOK_FOLDERS=" + folders_of(plan.folder), "TYNDALL_BOOK_WRITES=" + written.string(),
                      "TMPDIR=" + written.string()};
  if (only_samples) plan.environment.push_back(std::string("TYNDALL_BOOK_ONLY_SAMPLES=") + only_samples);
  plan.keep_last_errors = true;
  plan.max_file = max_file;
  plan.max_memory = free_memory().bytes / 2;
  return guarded(task, plan);
}

/// Reads what the program tells; false: it has ended before it told all.
bool read_messages(OwnProgram& own, const ProgramTask& task, ProgramScene& scene) {
  while (const auto message = own.next_message()) {
    const std::string text = printable(message->text);
    if (message->kind == 'P') std::istringstream(text) >> scene.width >> scene.height >> scene.samples;
    if (message->kind == 'F') scene.notes.push_back(task.name + ": cannot open " + in_quotes(text));
    if (message->kind == 'N') scene.notes.push_back(task.name + ": " + text);
    if (message->kind == 'R') {
      scene.fuzz_on_sphere = text.find("sphere") != std::string::npos;
      scene.matt_in_sphere = text.find("filled") != std::string::npos;
      scene.short_frame = text.find("frame") != std::string::npos;
      scene.has_images = text.find("image") != std::string::npos;
      scene.draws_by_pdf = text.find("pdf") != std::string::npos;
      scene.has_noise = text.find("noise") != std::string::npos;
    }
    if (message->kind == 'E') throw UsageError(task.name + ": " + text);
    if (message->kind == 'O') scene.reason = text;
    if (message->kind == 'S') scene.json = message->text;
    if (message->kind == 'O' || message->kind == 'S') return true;
  }
  return false;
}

}  // namespace

bool is_program(const std::string& name) {
  const std::string ending = fs::path(name).extension().string();
  return ending == ".cc" || ending == ".cpp" || ending == ".cxx";
}

ProgramScene load_program(const ProgramRequest& request) {
  const fs::path& main = request.sources.files.front();
  if (!runs_children())
    throw UsageError(printable(main.string()) +
                     ": is not run: builds for Windows run no programs, which need a compiler");
  const auto scratch = std::make_shared<ScratchFolder>();
  const ProgramTask task{printable(main.string()), scratch->path(), request.go_on,
                         request.watch_signals,    request.trusted, request.compiler};
  const CompiledProgram program = compile_program(task, request.sources);
  const SignalWatch signals(request.watch_signals ? WatchedSignals::end : WatchedSignals::none);
  const auto go_on = [&] { return signals.received() == 0 && (!request.go_on || request.go_on()); };
  ProgramScene scene;
  for (const char* only_samples : {static_cast<const char*>(nullptr), crashed}) {
    scene = ProgramScene{};
    scene.files = program.sources;
    const ChildPlan plan = plan_of(task, program, main, only_samples);
    const auto remove = [scratch](OwnProgram* own) { delete own; };  // the folder lives as long as the program
    scene.own = {new OwnProgram(task.name, plan, request.seconds, go_on), remove};
    if (read_messages(*scene.own, task, scene)) break;
    const ChildEnd& end = scene.own->end();
    if (signals.received() != 0) throw ProgramInterrupted(task.name + ": interrupted while it ran", signals.received());
    if (!go_on()) throw ProgramInterrupted(task.name + ": given up while it ran", signal_terminate);
    if (scene.width == 0 || only_samples) fail(request, task, end);
  }
  scene.own->set_lasting();
  return scene;
}

}  // namespace tyndall
