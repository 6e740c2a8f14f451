#include "app/check/arrangement.h"

#include "app/book/load_program.h"
#include "app/check/explain.h"
#include "app/files/open_scene.h"
#include "core/base/error.h"

#include <optional>
#include <utility>
#include <vector>

namespace tyndall {
namespace {

constexpr double part_of_other_scene = 0.05;  // blocks that differ from the start, before others are looked for
constexpr double part_of_right_scene = 0.5;   // of the difference that is left where another one is taken

/// Loads the program again, compiled in another way; nothing: it cannot be.
std::optional<LoadedScene> load(SceneRequest request, const std::string& compiler) {
  request.program.compiler = compiler;
  request.program.told = true;
  try {
    return open_scene(request);
  } catch (const ProgramInterrupted&) {
    throw;
  } catch (const std::runtime_error&) {  // a compiler that is not there, or that refuses the program
    return {};
  }
}

}  // namespace

Arrangement find_arrangement(const PictureNumbers& picture, const SceneRequest& request, LoadedScene loaded,
                             const std::function<bool()>& go_on) {
  Arrangement best{std::move(loaded), ""};
  if (!is_program(request.what)) return best;
  const auto misfit = [&](LoadedScene& other) {
    other.scene.width = picture.width, other.scene.height = picture.height;
    return rough_misfit(picture, other.scene);
  };
  const Misfit plain = misfit(best.loaded);
  if (plain.different <= part_of_other_scene * plain.blocks) return best;
  double amount = part_of_right_scene * plain.amount;
  const Scene first = best.loaded.scene;
  for (const char* compiler : {"g++", "clang++"}) {
    if (!go_on()) return best;
    std::optional<LoadedScene> other = load(request, compiler);
    if (!other || other->scene == first) continue;
    const Misfit found = misfit(*other);
    if (found.amount >= amount) continue;
    amount = found.amount;
    best = {std::move(*other), std::string("balls as ") + compiler + " places them"};
  }
  return best;
}

}  // namespace tyndall
