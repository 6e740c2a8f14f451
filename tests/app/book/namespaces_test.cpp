#include "app/book/namespaces.h"

#include <doctest/doctest.h>

using namespace tyndall;

namespace {

Definition first_of(const char* text) { return definitions_of(text).at(0); }

}  // namespace

TEST_CASE("namespaces: one that holds a class of the books is of the books") {
  CHECK(is_of_the_books(first_of("namespace a { class Sphere { }; }")));
  CHECK(is_of_the_books(first_of("namespace a { namespace b { struct vec3 { }; } }")));
  CHECK_FALSE(is_of_the_books(first_of("namespace a { class window { }; }")));
}

TEST_CASE("namespaces: a reader's namespace is made anew with our names, and without what ours have not") {
  const Definition one =
      first_of("namespace a { class vec3 { }; class HittableList { }; double dot(vec3, vec3); int own(); }");
  CHECK(namespace_of_ours(one) ==
        "namespace a {\nusing ::vec3;\nusing HittableList = ::hittable_list;\nusing ::dot;\n}\n");
  const Definition nested = first_of("namespace a { namespace b { class Ray { }; } }");
  CHECK(namespace_of_ours(nested) == "namespace a {\nnamespace b {\nusing Ray = ::ray;\n}\n}\n");
  CHECK(namespace_of_ours(first_of("namespace a::b { class ray { }; }")) == "namespace a::b {\nusing ::ray;\n}\n");
}
