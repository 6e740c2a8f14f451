#include "app/book/program_outline.h"

#include <doctest/doctest.h>

namespace tyndall::test::program_outline_test {

namespace {

/// As a compiler makes it of a reader's file; the first line is one of the system's.
const std::string program = R"(# 1 "/usr/include/x.h" 1 3
class hidden { };
# 1 "/home/me/main.cc"
namespace rt {
class Ray { public: Ray(int a) : b{a}, c(a) { } int b, c; };
struct Hit { double t; };
class Shape { public: virtual ~Shape() = default; virtual bool hit(const Ray& r, double low, double high, Hit& h) const = 0; };
template <class T> class Many : public Shape { };
class Ball final : public Shape {
  bool hit(const Ray& a, double low, double high, Hit& b) const override { return true; } };
inline std::ostream& operator<<(std::ostream& out, const Ray& r) { return out; }
struct Camera { Ray get_ray(double u, double v) const { return Ray(int(u)); } };
}
rt::Colour shade(const rt::Ray& r, const rt::Shape& world, int depth = 5) { return { }; }
int rt::Camera::lines() const { return 3; }
int main() { std::cout << "P3\n" << 3 << ' ' << 4; }
)";

}  // namespace

TEST_CASE("classes and functions of the reader's lines, with namespaces, constructors and operators between them") {
  const ProgramOutline outline = outline_of(program, {"/ours"});
  std::vector<std::string> classes, functions;
  for (const OutlinedClass& one : outline.classes) classes.push_back(one.qualified + (one.can_be_named ? "" : "<>"));
  for (const Function& one : outline.functions) functions.push_back(one.name);
  CHECK(classes == std::vector<std::string>{"::rt::Ray", "::rt::Hit", "::rt::Shape", "::rt::Many<>", "::rt::Ball",
                                            "::rt::Camera"});
  CHECK(functions == std::vector<std::string>{"Ray", "hit", "hit", "get_ray", "shade", "lines", "main"});
  CHECK(outline.functions[5].owner == "Camera");
  CHECK(outline.is_derived("Ball", "Shape"));
  CHECK_FALSE(outline.is_derived("Camera", "Shape"));
  CHECK(outline.files == std::vector<std::filesystem::path>{"/home/me/main.cc"});
  CHECK(outline_of(program, {"/home/me"}).classes.empty());
  const Function& shade = outline.functions[4];
  CHECK(shade.result == "rt :: Colour");
  REQUIRE(shade.parameters.size() == 3);
  CHECK(shade.parameters[1].name == "world");
  CHECK(shade.parameters[1].has("Shape"));
  CHECK(outline.classes[0].members == std::vector<std::string>{"b", "c"});
  CHECK(outline.classes[1].members == std::vector<std::string>{"t"});
}

TEST_CASE("calls are inserted where rays are made and where their colours are computed; the rest stays") {
  const InsertedCalls made = insert_calls(program, outline_of(program, {"/ours"}), true);
  CHECK(made.problem.empty());
  CHECK(made.text.find("get_ray(double u, double v) const { if (!::tyndall_book::is_ours)") != std::string::npos);
  CHECK(made.text.find("return shade(tyndall_ray, world, depth); }, r, world, ::tyndall_book::first_whole(r,") !=
        std::string::npos);
  CHECK(made.text.find("std::cout << ::std::unitbuf << \"P3\\n\" <<") != std::string::npos);
  CHECK(made.text.find("return ::tyndall_book::answer_of_world(&a, low, high, &b); return true; }") !=
        std::string::npos);
  CHECK(made.text.find("struct members<::rt::Hit>") != std::string::npos);
  CHECK(made.text.find("typeid(o) == typeid(::rt::Ball)") != std::string::npos);
  CHECK(made.text.find("typeid(::rt::Many)") == std::string::npos);
  const std::string other = "# 1 \"/home/me/main.cc\"\nint main() { }\n";  // which has no rays: nothing to be asked
  CHECK_FALSE(insert_calls(other, outline_of(other, {"/ours"}), true).problem.empty());
}

}  // namespace tyndall::test::program_outline_test
