#include "app/files/open_scene.h"
#include "app/window/document/autosave.h"
#include "app/window/document/document.h"
#include "app/window/gallery/gallery.h"
#include "tests/app/window/opened_session.h"

#include <algorithm>

namespace tyndall::test::session_programs_slow_test {
namespace fs = std::filesystem;

namespace {

const fs::path header = tests_folder().parent_path() / "assets/examples/book/tracer/rtweekend.h";

/// A program that describes the scene of OpenedSession::write().
void write_program(const std::string& fuzz, const std::string& file = "main.cc") {
  std::ofstream(file + ".new") << "#include \"" << header.string() << "\"\nint main() {\n  hittable_list world;\n"
                               << "  world.add(make_shared<sphere>(point3(0, 0, -2), 1.0, make_shared<metal>(color(1, "
                                  "1, 1), "
                               << fuzz << ")));\n  camera cam;\n  cam.image_width = 8;\n  cam.samples_per_pixel = 4;\n"
                               << "  cam.background = color(1, 1, 1);\n  cam.render(world);\n}\n";
  fs::rename(file + ".new", file);
}

/// A session over a program, in the folder of another one's.
struct OpenedProgram : OpenedSession {
  explicit OpenedProgram(const std::string& name) : OpenedSession(name) {
    write_program("0.25");
    open_program();
  }
  void open_program() {
    open([](WindowOptions& options) {
      SceneRequest request;
      request.what = "main.cc";
      request.program.allowed = request.program.trusted = true;
      options.scene = open_scene(request);
      options.reload = [request](const std::function<bool()>& go_on) mutable {
        request.program.go_on = go_on;
        return open_scene(request);
      };
    });
  }
};

/// While this lives, every compilation fails, and says so.
class FailingCompiler {
 public:
  FailingCompiler() {
    write_text("compiler", "#!/bin/sh\necho \"$PWD: error: the failing compiler\" >&2\nexit 1\n");
    fs::permissions("compiler", fs::perms::owner_all);
    const char* now = std::getenv("CXX");
    before_ = now ? now : "";
    setenv("CXX", fs::absolute("compiler").c_str(), 1);
  }
  ~FailingCompiler() { before_.empty() ? unsetenv("CXX") : setenv("CXX", before_.c_str(), 1); }
  FailingCompiler(const FailingCompiler&) = delete;
  FailingCompiler& operator=(const FailingCompiler&) = delete;

 private:
  std::string before_;
};

}  // namespace

TEST_CASE("a program is compiled again when it is saved; an error leaves the last good scene, and is told") {
  OpenedProgram opened("program");
  CHECK(opened.fuzz() == 0.25);
  write_program("0.5");
  REQUIRE(opened.becomes(0.5));
  write_program("nonsense");
  REQUIRE(opened.complains());
  CHECK(opened.message().starts_with("main.cc:4:"));
  CHECK(opened.message().find("'nonsense'") != std::string::npos);
  CHECK(opened.fuzz() == 0.5);
  write_program("0.75");
  REQUIRE(opened.becomes(0.75));
  CHECK_FALSE(opened.session->messages.current().error);
}

TEST_CASE("a window that closes does not wait for a program that has no end") {
  OpenedProgram opened("program_endless");
  write_program("0.5); for (volatile int i = 0;;) i = (1");
  opened.session->collect();
  REQUIRE(opened.comes_true([&] { return !opened.session->at_rest(); }));
  const auto begin = std::chrono::steady_clock::now();
  opened.session.reset();
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(10));
}

TEST_CASE("saving never replaces a program: it asks for the name of a scene file, which is watched from then on") {
  OpenedProgram opened("program_saved");
  const Document before = opened.editor().document();
  CHECK(before.origin->file.empty());
  const std::vector<fs::path> watched = watched_files(before);  // with the headers that it includes
  CHECK(watched.front() == fs::absolute("main.cc"));
  CHECK(std::find(watched.begin(), watched.end(), header) != watched.end());
  opened.set_fuzz(0.5);
  REQUIRE(opened.editor().save("main.json"));
  CHECK(watched_files(opened.editor().document()) == std::vector<fs::path>{"main.json"});
  CHECK(load_scene("main.json").scene == opened.editor().scene());
  write_program("0.75");
  opened.session->collect();
  CHECK(opened.fuzz() == 0.5);
}

TEST_CASE("edits of a program's scene are kept as a scene, and come back without compiling") {
  OpenedProgram opened("program_kept");
  opened.set_fuzz(0.5);
  const Document edited = opened.editor().document();
  write_text("kept.json", kept_text(edited.scene, *edited.origin, "."));
  CHECK(load_scene("kept.json").scene == edited.scene);
  opened.session->keep_edits();
  opened.open_program();  // as "tyndall main.cc" does
  CHECK(opened.fuzz() == 0.5);
  opened.editor().undo();
  CHECK(opened.fuzz() == 0.25);
  const FailingCompiler compiler;
  const Kept kept = read_kept("kept.json", [](const std::string& what) { return load_scene(what); });
  CHECK(kept.document.scene == edited.scene);
  CHECK(kept.document.origin->file.empty());
}

TEST_CASE("no other program is compiled: dropped, from the list of recent files, or for its small picture") {
  OpenedProgram opened("program_other");
  const FailingCompiler compiler;
  write_program("0.5", "other.cc");
  const std::string other = fs::absolute("other.cc").string();
  opened.session->references.open_dropped(other);
  const std::string refused =
      "other.cc is a program, which is compiled and run only where it is named on the command line: tyndall other.cc";
  REQUIRE(opened.comes_true([&] { return opened.message() == refused; }));
  opened.session->messages.dismiss();
  add_recent_file("recent.txt", other);
  for (const fs::path& file : read_recent_files("recent.txt")) opened.editor().open(file.string());
  CHECK(opened.message() == refused);
  CHECK_THROWS_AS(load_scene(other), SceneError);  // what small pictures and references are made by
  CHECK(opened.fuzz() == 0.25);

  opened.editor().open(fs::absolute("main.cc").string());  // the one that was named
  REQUIRE(opened.comes_true([&] { return opened.message().find("the failing compiler") != std::string::npos; }));
}

}  // namespace tyndall::test::session_programs_slow_test
