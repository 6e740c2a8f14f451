#pragma once
#include "app/cli/verify.h"

#include <stdexcept>

/// The scenes of `tyndall verify`, whose pictures have a known mean: assets/verify/cases.json with the sources.
namespace tyndall::test {

inline const std::vector<VerifyCase>& known_answers() {
  static const std::vector<VerifyCase> all = read_verify_cases(assets_folder() / "verify" / "cases.json");
  return all;
}

inline const VerifyCase& known_answer(const std::string& name) {
  for (const VerifyCase& answer : known_answers())
    if (answer.name == name) return answer;
  throw std::invalid_argument("no known answer: " + name);
}

inline Scene scene_of(const VerifyCase& answer) { return load_scene(answer.scene.string(), answer.overrides).scene; }

}  // namespace tyndall::test
