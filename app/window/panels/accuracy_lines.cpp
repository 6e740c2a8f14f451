#include "app/window/panels/panels.h"

#include <fmt/core.h>

namespace tyndall {
namespace {

std::string flip_text(const PairErrors& pair) {
  return pair.flip ? fmt::format(" · FLIP {:.2g}", *pair.flip) + " at " + format_count(pair.flip_spp) + " spp" : "";
}

AccuracyLine reference_line(const LiveAccuracy& accuracy) {
  const std::string& name = accuracy.reference()->about;
  const ReferenceFit fit = *accuracy.fit(Half::current);
  const bool shared = fit == ReferenceFit::same_samples || accuracy.fit(Half::kept) == ReferenceFit::same_samples;
  if (fit == ReferenceFit::other_scene) return {"reference of another scene: " + name, true};
  if (fit == ReferenceFit::other_size) return {"reference of another size: " + name, true};
  if (shared) return {"same random numbers, noise looks too small: " + name, true};
  return {"against " + name + (accuracy.split() ? "" : flip_text(accuracy.pair())), false};
}

}  // namespace

std::vector<AccuracyLine> accuracy_lines(const LiveAccuracy& accuracy) {
  std::vector<AccuracyLine> lines;
  if (accuracy.reference() && accuracy.fit(Half::current)) lines.push_back(reference_line(accuracy));
  if (!accuracy.split()) return lines;
  const PairErrors& pair = accuracy.pair();
  lines.push_back(
      {"B against A" + (pair.rel_mse ? fmt::format(": relMSE {:.2g}", *pair.rel_mse) : "") + flip_text(pair), false});
  return lines;
}

}  // namespace tyndall
