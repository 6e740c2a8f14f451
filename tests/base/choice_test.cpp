#include "core/base/choice.h"

#include <doctest/doctest.h>

namespace {

enum class Fruit { apple, pear, quince };

constexpr tyndall::Label label(Fruit fruit) {
  switch (fruit) {
    case Fruit::apple:
      return {"apple", "round"};
    case Fruit::pear:
      return {"pear"};
    case Fruit::quince:
      return {"quince", "to be cooked", true};
  }
  return {};
}

}  // namespace

namespace tyndall::test::choice_test {

TEST_CASE("choices: values and names go back and forth") {
  static_assert(count_of<Fruit>() == 3);
  CHECK(names_of<Fruit>() == std::vector<std::string_view>{"apple", "pear", "quince"});
  for (int i = 0; i < 3; ++i) CHECK(value_named<Fruit>(name_of(static_cast<Fruit>(i))) == static_cast<Fruit>(i));
  CHECK_FALSE(value_named<Fruit>("plum"));
  CHECK_FALSE(value_named<Fruit>(""));
  CHECK(label(Fruit::quince).approximation);
  CHECK_FALSE(label(Fruit::apple).approximation);
}

}  // namespace tyndall::test::choice_test
