#pragma once
#include "core/render/measure.h"
#include "core/scene/load.h"

#include <filesystem>
#include <string>
#include <vector>

/// The known answers that `tyndall verify` checks the renderer against; what it measured, its judgement, and both as a
/// table or JSON.
namespace tyndall {

/// One known answer: the mean of a picture over its pixels and channels.
struct VerifyCase {
  std::string name;                   ///< "plate/reflected-60deg"
  std::string scene;                  ///< file
  std::vector<Override> overrides{};  ///< of the scene, in order
  double expected = 0;
  std::string source{};                  ///< author, title, year, or how it is derived
  bool requires_light_sampling = false;  ///< its lights are too small for a path to meet by chance
  bool requires_specular_paths = false;  ///< so small that light through or off a sphere is found by chains alone
};

constexpr auto fields(const VerifyCase*) {
  return std::tuple{Field{"name", &VerifyCase::name, ""},
                    Field{"scene", &VerifyCase::scene, ""},
                    Field{"set", &VerifyCase::overrides, ""},
                    Field{"expected", &VerifyCase::expected, any_number(), no_slider(), "", "mean radiance"},
                    Field{"source", &VerifyCase::source, ""},
                    Field{"light_sampling", &VerifyCase::requires_light_sampling, ""},
                    Field{"chains", &VerifyCase::requires_specular_paths, ""}};
}

/// Reads a table of cases: { "groups": [{ "name", "scene", "source", "set": { POINTER: VALUE, … }, "light_sampling",
/// "chains", "cases": [{ "name", "set", "expected", "source" }, …] }, …] }. Scenes are files in the table's folder. A
/// group is itself a case, of which its cases have all that they do not say; its overrides go before theirs. Throws
/// SceneError for everything that is wrong with the table.
std::vector<VerifyCase> read_verify_cases(const std::filesystem::path& file);

/// The cases whose names begin with one of these; without names all cases. Throws UsageError for a name that chooses
/// nothing.
std::vector<VerifyCase> chosen_cases(std::vector<VerifyCase> cases, const std::vector<std::string>& names);

struct VerifyRow : VerifyCase {
  RenderSettings method;
  Measured measured{};
  double z = 0;
  /// "ok"; "FAIL": more than 4 standard errors off, or samples were rejected; "vague": the standard error stayed above
  /// what was asked for; "skipped": cannot be measured without light sampling, or without chains.
  std::string verdict = "skipped";
};

/// The row with a measurement, judged. precision: largest standard error, as a fraction of what is expected.
VerifyRow judge(VerifyRow row, const Measured& measured, double precision);

struct VerifyRun {
  std::vector<VerifyRow> rows;
  double precision = 0;
  double seconds = 0;
  std::string isa;
  int threads = 0;
  bool interrupted = false;
};

/// The mean square of the z-scores, which chance keeps near 1, and the band that it may be in. Cases whose standard
/// error is as small as the rounding of single precision are left out.
struct ZStatistic {
  int count = 0;
  double mean_square = 0;
  SquareBand band;
  bool ok() const { return mean_square >= band.low && mean_square <= band.high; }
};
ZStatistic z_statistic(const std::vector<VerifyRow>& rows);

/// Whether every case passed, every standard error became small enough, and the z-scores are as large as chance makes
/// them.
bool passed(const VerifyRun& run);

std::string verify_table(const VerifyRun& run);
std::string verify_json(const VerifyRun& run);

}  // namespace tyndall
