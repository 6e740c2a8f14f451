#include "app/cli/verify.h"
#include "app/cli/commands.h"
#include "app/cli/render_setup.h"
#include "app/files/open_scene.h"
#include "app/text/progress.h"
#include "app/text/standard_streams.h"
#include "core/base/seconds.h"
#include "core/base/thread_pool.h"
#include "core/system/signals.h"

#include <chrono>
#include <cmath>

namespace tyndall {
namespace {

using Clock = std::chrono::steady_clock;

/// A seed from a case's name, so that it stays the same when other cases are added. Fowler, Noll, Vo: The FNV
/// Non-Cryptographic Hash Algorithm.
std::uint32_t seed_of(const std::string& name) {
  std::uint32_t hash = 0x811c9dc5u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x01000193u;
  return hash;
}

/// A case's scene with the command's method.
Scene scene_of(const CommandRequest& command, const VerifyCase& what) {
  SceneRequest request = command.scene;
  request.what = what.scene.string();
  request.overrides = what.overrides;
  set(request.render, &RenderSettings::seed, seed_of(what.name) + max_rounds * command.scene.render.values.seed);
  return open_scene(request).scene;
}

/// Whether a method finds the light of a case only by rare chance.
bool is_out_of_reach(const VerifyCase& what, const RenderSettings& method) {
  if (what.requires_light_sampling && method.integrator == Integrator::path) return true;
  const bool solved = method.integrator == Integrator::mis && method.caustics == Caustics::chains &&
                      method.fresnel == FresnelKind::exact;
  return what.requires_specular_paths && !solved;
}

class Verification {
 public:
  Verification(const CommandRequest& command, std::vector<VerifyCase> cases)
      : command_(command), cases_(std::move(cases)), report_(command.progress) {
    run_.precision = command.thorough ? 1e-4 : 1e-3;
    run_.isa = find_kernels(command.isa).isa;
    run_.threads = ThreadPool(command.threads).size();
  }

  VerifyRun run() {
    for (const VerifyCase& what : cases_) {
      const Scene scene = scene_of(command_, what);
      VerifyRow row{what, scene.render};
      if (is_out_of_reach(what, scene.render)) {
        run_.rows.push_back(row);
        continue;
      }
      const Measured measured = measure(scene, what);
      if (measured.interrupted) break;
      run_.rows.push_back(judge(row, measured, run_.precision));
    }
    run_.seconds = seconds_since(start_);
    run_.interrupted = signals_.received() != 0;
    report_.finish(std::to_string(run_.rows.size()) + " cases done, " + duration(run_.seconds));
    return run_;
  }
  int signal() const { return signals_.received(); }

 private:
  Measured measure(const Scene& scene, const VerifyCase& what) {
    const MeasureOptions options{command_.threads, command_.isa, run_.precision * std::abs(what.expected),
                                 what.expected};
    const auto done = static_cast<double>(run_.rows.size()), all = static_cast<double>(cases_.size());
    return measure_mean(scene, options, [&](const RenderProgress&) {
      report_.show(seconds_since(start_), done / all,
                   std::to_string(run_.rows.size()) + "/" + std::to_string(cases_.size()) + " " + what.name + ", " +
                       duration(seconds_since(start_)));
      return signals_.received() == 0;
    });
  }

  const CommandRequest& command_;
  std::vector<VerifyCase> cases_;
  ProgressReport report_;
  SignalWatch signals_;
  Clock::time_point start_ = Clock::now();
  VerifyRun run_;
};

}  // namespace

int run_verify(const CommandRequest& command) {
  const auto table = assets_folder() / "verify" / "cases.json";
  Verification verification(command, chosen_cases(read_verify_cases(table), command.operands));
  const VerifyRun run = verification.run();
  write_standard_output(command.json ? verify_json(run) : verify_table(run));
  if (run.interrupted) return 128 + verification.signal();
  return passed(run) ? 0 : 1;
}

}  // namespace tyndall
