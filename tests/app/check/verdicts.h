#pragma once
#include "app/check/check.h"
#include "core/image/tonemap.h"
#include "core/scene/load.h"
#include "tests/support/book_tracer.h"

#include <limits>
#include <string>

/// What the check says of pictures of a program that shares nothing with it.
namespace tyndall::test {

inline PictureNumbers numbers_of_bytes(int width, int height, const std::vector<std::uint8_t>& bytes) {
  PictureFile file{{width, height, {}}, ImageKind::ppm, 8, false, {}};
  for (const std::uint8_t byte : bytes) file.image.rgb.push_back(srgb_decode(static_cast<float>(byte) / 255));
  return numbers_of(file);
}

/// A built-in scene in another size, with Schlick's rule out of the way: the books' programs have it.
inline Scene scene_for_book(const std::string& name, int width, int height) {
  Scene scene = load_scene(name).scene;
  scene.width = width, scene.height = height;
  return scene;
}

/// By a fixed number of samples, so that the answer does not depend on the speed of the machine. spp: of the reference.
inline Findings verdict_of(
    const Scene& scene, const BookProgramPlan& plan, std::uint32_t spp,
    const CheckOptions& options = {std::numeric_limits<double>::infinity(), 24},
    const std::function<bool()>& go_on = [] { return true; }) {
  const PictureNumbers picture = numbers_of_bytes(scene.width, scene.height, book_picture(scene, plan));
  LinearImage light{picture.width, picture.height, picture.numbers};
  for (float& value : light.rgb) value *= value;
  const double endless = std::numeric_limits<double>::infinity();
  const NoisyImage reference = render_reference(scene, light, endless, spp, [] { return true; });
  return explain(picture, scene, reference, options, go_on);
}

/// "agrees", "too few", "unknown", "schlick-always-1", or "unexplained".
inline std::string name_of(const Findings& verdict) {
  return verdict.unknown   ? "unknown"
         : verdict.too_few ? "too few"
         : verdict.agrees  ? "agrees"
         : verdict.mistake ? verdict.mistake->name
                           : "unexplained";
}

}  // namespace tyndall::test
