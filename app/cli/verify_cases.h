#pragma once
#include "core/scene/json.h"

#include <filesystem>
#include <string>
#include <vector>

/// The known answers that `tyndall verify` checks the renderer against.
namespace tyndall {

/// One known answer: the mean of a picture over its pixels and channels.
struct VerifyCase {
  std::string name;                 ///< "plate/reflected-60deg"
  std::filesystem::path scene;      ///< file
  std::vector<Override> overrides;  ///< of the scene, in order
  double expected = 0;
  std::string source;                 ///< author, title, year, or how it is derived
  bool needs_light_sampling = false;  ///< its lights are too small for a path to meet by chance
  bool needs_chains = false;          ///< so small that light through or off a ball is found by chains alone
};

/// Reads a table of cases: { "groups": [{ "name", "scene", "source", "set": { POINTER: VALUE, … }, "light_sampling",
/// "chains", "cases": [{ "name", "set", "expected", "source" }, …] }, …] }. Scenes are files in the table's folder; a
/// group's overrides go before a case's, a case's source before its group's. Throws SceneError for everything that is
/// wrong with the table.
std::vector<VerifyCase> read_verify_cases(const std::filesystem::path& file);

/// The cases whose names begin with one of these; without names all cases. Throws UsageError for a name that chooses
/// nothing.
std::vector<VerifyCase> chosen_cases(const std::vector<VerifyCase>& cases, const std::vector<std::string>& names);

}  // namespace tyndall
