#pragma once
#include "app/cli/verify_cases.h"
#include "core/base/choice.h"
#include "core/render/measure.h"

#include <string>
#include <vector>

/// What `tyndall verify` measured, its judgement, and both as a table or JSON.
namespace tyndall {

enum class Verdict { ok, fail, vague, skipped };

constexpr Word word(Verdict verdict) {
  switch (verdict) {
    case Verdict::ok:
      return {"ok"};
    case Verdict::fail:
      return {"FAIL", "more than 4 standard errors off, or samples were rejected"};
    case Verdict::vague:
      return {"vague", "the standard error stayed above what was asked for"};
    case Verdict::skipped:
      return {"skipped", "cannot be measured without light sampling"};
  }
  return {};
}

struct VerifyRow {
  VerifyCase what;
  RenderSettings method;
  Measured measured{};
  double z = 0;
  Verdict verdict = Verdict::skipped;
};

/// The row with a measurement, judged. precision: largest standard error, as a share of what is expected.
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
  bool ok() const { return count == 0 || (mean_square >= band.low && mean_square <= band.high); }
};
ZStatistic z_statistic(const std::vector<VerifyRow>& rows);

/// Whether every case passed, every standard error became small enough, and the z-scores are as large as chance makes
/// them.
bool passed(const VerifyRun& run);

std::string verify_table(const VerifyRun& run);
std::string verify_json(const VerifyRun& run);

}  // namespace tyndall
