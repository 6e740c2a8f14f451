// --set POINTER=VALUE: the input is a line with an override, then another.
#include "app/text/values.h"
#include "core/scene/load.h"
#include "tests/fuzz/fuzz_input.h"

using namespace tyndall;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size), first = text.substr(0, text.find('\n'));
  const std::string_view second = first.size() < text.size() ? text.substr(first.size() + 1) : std::string_view();
  std::vector<Override> overrides;
  fuzz::survives<UsageError>([&] {
    for (const std::string_view one : {first, second}) overrides.push_back(read_override(std::string(one)));
  });
  const std::string_view scene = R"({"tyndall": 1, "camera": {"vfov": 40}, "materials": {"white": {"type": "lambertian",
    "albedo": [0.7, 0.7, 0.7]}}, "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "white"}]})";
  fuzz::survives<SceneError>([&] { read_scene(scene, "fuzz", "/nowhere", overrides); });
  return 0;
}
