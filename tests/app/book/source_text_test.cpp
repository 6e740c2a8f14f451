#include "app/book/source_text.h"

#include <doctest/doctest.h>

namespace tyndall::test::source_text_test {

namespace {

using Words = std::vector<std::string>;

}  // namespace

TEST_CASE("includes: quoted and in angles, with blanks, and where their lines are") {
  const std::string text =
      "#include \"a.h\"\n  #  include <b/c.hpp>  // why\nint x; // #include \"no.h\"\n#include NAME\n";
  const std::vector<Include> found = includes_of(text);
  REQUIRE(found.size() == 2);
  CHECK(found[0].name == "a.h");
  CHECK(found[0].quoted);
  CHECK(text.substr(found[0].line_begin, found[0].line_end - found[0].line_begin) == "#include \"a.h\"");
  CHECK(found[1].name == "b/c.hpp");
  CHECK_FALSE(found[1].quoted);
  CHECK(text.substr(found[1].line_end, 4) == "\nint");
}

TEST_CASE("includes: an end that is missing is no include, also at the end of the text") {
  CHECK(includes_of("#include \"a.h\n#include <b").empty());
  CHECK(includes_of("#include \"a.h\"").size() == 1);
  CHECK(includes_of("#").empty());
}

TEST_CASE("comments become blanks, lines stay, strings stay") {
  CHECK(without_comments("a/*b\nc*/d//e\nf") == "a   \n   d   \nf");
  CHECK(without_comments("\"/*\" // x\n'\"' /* \" */ 1'000'000 // y") == "\"/*\"     \n'\"'         1'000'000     ");
  CHECK(without_comments("\"a\\\"//b\"") == "\"a\\\"//b\"");
  CHECK(without_comments("/* open").find("open") == std::string::npos);
}

TEST_CASE("keys of headers ignore folders, case, underscores and endings") {
  CHECK(key_of("../src/Hittable_List.hpp") == "hittablelist");
  CHECK(key_of("hittable-list") == "hittablelist");
  CHECK(key_of("C:\\rt\\Vec3.H") == "vec3");
  CHECK(key_of("") == "");
}

TEST_CASE("classes: what they are derived from; declarations are none") {
  const auto classes = classes_of(
      "class later; struct plain { int x; };\nclass triangle final : public virtual hittable, private other {\n};\n"
      "template <class T> struct holder { }; enum class choice { one };");
  CHECK(classes.size() == 3);
  CHECK(classes.at("plain") == "");
  CHECK(classes.at("triangle") == "hittable");
  CHECK(classes.count("holder") == 1);
  CHECK(classes.count("later") == 0);
}

TEST_CASE("constants: only those outside of braces") {
  CHECK(constants_of("const double pi = 3.14; constexpr float infinity{1}; void f() { double pi = 3; }") ==
        Words{"pi", "infinity"});
}

TEST_CASE("random numbers: the generator that can be repeated, with its seed") {
  CHECK(random_options("return rand() / (RAND_MAX + 1.0);").empty());
  CHECK(random_options("static std::mt19937 g;") == Words{"-DTYNDALL_BOOK_ENGINE=std::mt19937"});
  CHECK(random_options("std::mt19937_64 engine { 7u };") ==
        Words{"-DTYNDALL_BOOK_ENGINE=std::mt19937_64", "-DTYNDALL_BOOK_SEED=7"});
  CHECK(random_options("std::random_device d; std::mt19937 g(d());").empty());
  CHECK(random_options("return drand48();") == Words{"-DTYNDALL_BOOK_DRAND48"});
  CHECK(random_options("rand(); drand48();").empty());
}

TEST_CASE("sky: the blend of two colours, black where the camera has a background, else unknown") {
  const std::string blend = "return (1.0 - t) * color(1.0, 1.0, 1.0) +\n t * color(.5, 0.7f, 1);";
  CHECK(sky_of(blend) == R"({"type":"gradient","bottom":[1,1,1],"top":[0.5,0.7,1]})");
  CHECK(sky_of("color background;") == "[0,0,0]");
  CHECK_FALSE(sky_of("(1.0 - t) * color(a, b, c) + t * color(1, 1, 1)"));
  CHECK_FALSE(sky_of("(1.0 - t) * color(1, 1, 1) + u * color(1, 1, 1)"));
  CHECK_FALSE(sky_of(""));
  const std::string books = R"({"type":"gradient","bottom":[1,1,1],"top":[0.5,0.7,1]})",
                    weight = "auto a = 0.5 * (d.y() + 1.0); ";
  CHECK(sky_of("color white = color(1, 1, 1); const vec3 blue(0.5, 0.7, 1.0);" + weight +
               "(1 - a) * white + a * blue") == books);
  CHECK(sky_of(weight + "return lerp(color(1, 1, 1), color(0.5, 0.7, 1), a);") == books);
}

TEST_CASE("sky: what may be one or the other is unknown") {
  const std::string blend = "(1 - a) * color(1, 1, 1) + a * color(0, 0, 1)";
  CHECK_FALSE(sky_of("double a = 0.5 * d.y() + 1.0; return " + blend));
  CHECK_FALSE(sky_of("color background; return lit ? background : " + blend));
  CHECK_FALSE(sky_of("color background(const ray& r);"));
}

TEST_CASE("strings of one line") { CHECK(strings_of("f(\"a.png\"); \"open\n \"b\"") == Words{"a.png", "b"}); }

}  // namespace tyndall::test::source_text_test
