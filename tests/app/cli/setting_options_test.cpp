#include "app/cli/setting_options.h"

#include <doctest/doctest.h>

namespace tyndall::test::setting_options_test {

namespace {

/// Settings of every type that there is; those of the program are looked at in options_test.cpp.
struct Example {
  int whole_number = 3;
  double number = 0.5;
  bool off_by_default = false, on_by_default = true;
  SamplerKind choice = SamplerKind::sobol;
  std::optional<int> open{};
};

constexpr auto fields(const Example*) {
  return std::tuple{Field{"whole_number", &Example::whole_number, at_least(0), no_slider(), "", "how many"},
                    Field{"number", &Example::number, between(-1, 1), no_slider(), "EV", "how much"},
                    Field{"off_by_default", &Example::off_by_default, "a switch"},
                    Field{"on_by_default", &Example::on_by_default, "another switch"},
                    Field{"choice", &Example::choice, "one of several"},
                    Field{"open", &Example::open, between(1, 9), no_slider(), "", "may be absent"}};
}

Changes<Example> parsed(const std::vector<std::string>& arguments) {
  Changes<Example> changes;
  const auto app = new_command("example", "");
  add_settings(*app, changes);
  parse(*app, arguments);
  return changes;
}

std::string refusal(const std::vector<std::string>& arguments) {
  try {
    parsed(arguments);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("setting options: each type of value arrives, and what is not given stays") {
  const Changes<Example> changes = parsed({"--whole-number", "7", "--number", "-.25", "--off-by-default",
                                           "--on-by-default", "off", "--choice", "random", "--open=4"});
  CHECK(changes.given.size() == 6);
  Example example;
  apply(changes, example);
  CHECK(example.whole_number == 7);
  CHECK(example.number == -0.25);
  CHECK(example.off_by_default);
  CHECK_FALSE(example.on_by_default);
  CHECK(example.choice == SamplerKind::random);
  CHECK(example.open == 4);
  Example other{9, 1, true, false, SamplerKind::random, 2};
  apply(parsed({"--on-by-default", "on"}), other);
  CHECK(other.on_by_default);
  CHECK(other.whole_number == 9);
  CHECK(other.off_by_default);
  CHECK(other.open == 2);
}

TEST_CASE("setting options: wrong values are refused with the range and the meaning of the field") {
  CHECK(refusal({"--whole-number", "-1"}) ==
        "--whole-number: found \"-1\", expected a whole number in [0, 2147483647] (how many)");
  CHECK(refusal({"--number", "2"}) == "--number: found \"2\", expected a number in [-1, 1] in EV (how much)");
  CHECK(refusal({"--choice", "sobl"}) ==
        "--choice: found \"sobl\", expected one of \"random\", \"sobol\" (did you mean \"sobol\"?)");
  CHECK(refusal({"--on-by-default", "yes"}) == "--on-by-default: found \"yes\", expected one of \"off\", \"on\"");
  CHECK(refusal({"--on-by-default"}) == "--on-by-default: a value is missing (see tyndall example --help)");
}

TEST_CASE("setting options: the help says what to give, what it means and what it is without") {
  const auto app = new_command("example", "");
  Changes<Example> changes;
  add_settings(*app, changes, {"open"});
  const std::string help = parse(*app, {"--help"}).value().text;
  CHECK(help.find("--number EV") != std::string::npos);
  CHECK(help.find("how much [from the scene, else 0.5]") != std::string::npos);
  CHECK(help.find("--on-by-default on|off") != std::string::npos);
  CHECK(help.find("--off-by-default ") != std::string::npos);
  CHECK(help.find("random (independent numbers)") != std::string::npos);
  CHECK(help.find("[from the scene, else sobol]") != std::string::npos);
  CHECK(help.find("--open") == std::string::npos);
}

}  // namespace tyndall::test::setting_options_test
