#include "app/cli/verify.h"
#include "app/cli/render_setup.h"
#include "app/cli/requests.h"
#include "app/files/open_scene.h"
#include "app/text/progress.h"
#include "app/text/standard_streams.h"
#include "core/base/seconds.h"
#include "core/base/thread_pool.h"
#include "core/system/signals.h"

#include <fmt/core.h>

#include <chrono>
#include <cmath>

namespace tyndall {
namespace {

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

VerifyRun verify(const CommandRequest& command, const std::vector<VerifyCase>& cases, const SignalWatch& signals) {
  const auto start = Clock::now();
  ProgressReport report(command.progress);
  VerifyRun run;
  run.precision = command.thorough ? 1e-4 : 1e-3;
  run.isa = find_kernels(command.isa).isa;
  run.threads = ThreadPool(command.threads).size();
  for (const VerifyCase& what : cases) {
    const Scene scene = scene_of(command, what);
    VerifyRow row{what, scene.render};
    if (!is_out_of_reach(what, scene.render)) {
      const MeasureOptions options{command.threads, command.isa, run.precision * std::abs(what.expected),
                                   what.expected};
      const auto done = static_cast<double>(run.rows.size()), all = static_cast<double>(cases.size());
      const Measured measured = measure_mean(scene, options, [&](const RenderProgress&) {
        const double seconds = seconds_since(start);
        report.show(seconds, done / all,
                    fmt::format("{}/{} {}, {}", run.rows.size(), cases.size(), what.name, duration(seconds)));
        return signals.received() == 0;
      });
      if (measured.interrupted) break;
      row = judge(row, measured, run.precision);
    }
    run.rows.push_back(row);
  }
  run.seconds = seconds_since(start);
  run.interrupted = signals.received() != 0;
  report.finish(std::to_string(run.rows.size()) + " cases done, " + duration(run.seconds));
  return run;
}

}  // namespace

int run_verify(const CommandRequest& command) {
  const auto table = assets_folder() / "verify" / "cases.json";
  const std::vector<VerifyCase> cases = chosen_cases(read_verify_cases(table), command.operands);
  const SignalWatch signals;
  const VerifyRun run = verify(command, cases, signals);
  write_standard_output(command.json ? verify_json(run) : verify_table(run));
  if (run.interrupted) return 128 + signals.received();
  return passed(run) ? 0 : 1;
}

}  // namespace tyndall
