#include "app/check/arrangement.h"

#include "app/book/compile_program.h"
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

struct Generator {
  const char* name;
  std::vector<std::string> options;
};

std::vector<Generator> generators() {
  return {{"rand()", {}},
          {"std::mt19937", {"-DTYNDALL_BOOK_ENGINE=std::mt19937"}},
          {"drand48()", {"-DTYNDALL_BOOK_DRAND48"}}};
}

/// Loads the program again, compiled in another way; nothing: it cannot be.
std::optional<LoadedScene> load(SceneRequest request, const std::string& compiler, const Generator& generator) {
  request.program.build = {compiler, generator.options};
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
    return rough_misfit(picture, other.scene, 0);
  };
  const Misfit plain = misfit(best.loaded);
  if (plain.different <= part_of_other_scene * plain.blocks) return best;
  const Scene first = best.loaded.scene;
  double amount = part_of_right_scene * plain.amount;
  bool depends = false;
  for (const char* compiler : {"g++", "clang++"})
    for (const Generator& generator : generators()) {
      if (!go_on()) return best;
      std::optional<LoadedScene> other = load(request, compiler, generator);
      if (!other) break;
      const Misfit found = misfit(*other);
      depends = depends || !(other->scene == first);
      if (found.amount < amount && !(other->scene == first)) {
        amount = found.amount;
        best = {std::move(*other), std::string("balls as ") + generator.name + " and " + compiler + " place them"};
        if (found.different <= part_of_other_scene * found.blocks) return best;
      }
      if (!depends && generator.options.size() == 1)
        return best;  // two generators, and the same scene: no balls at random
    }
  return best;
}

}  // namespace tyndall
