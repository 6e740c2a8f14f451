#include "core/system/process.h"
#include "tests/api/builders_text.h"
#include "tests/scene/files.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <fstream>

namespace tyndall::test::builders_test {

TEST_CASE("builders: the library's structs are what the lists of fields say") {
  const std::filesystem::path file = tests_folder().parent_path() / "core/api/tyndall/builders.h";
  const std::string made = test::builders_text();
  if (is_set("TYNDALL_WRITE_BUILDERS")) std::ofstream(file, std::ios::binary) << made;
  CHECK_MESSAGE(test::read_text(file) == made, "tests/api/builders_text.h says how to write it anew");
}

}  // namespace tyndall::test::builders_test
