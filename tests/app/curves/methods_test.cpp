#include "app/curves/chart.h"
#include "core/scene/load.h"

#include <doctest/doctest.h>

namespace tyndall::test::methods_test {

TEST_CASE("chart: the books' method first, each improvement in turn, what a scene has no use for left out") {
  const auto names = [](const char* scene) {
    std::string all;
    for (const ChartMethod& m : default_methods(load_scene(scene).scene)) all += m.name + "; ";
    return all;
  };
  CHECK(names("cornell-smoke").find("the books' method; + light sampling; + MIS; + Sobol'; ") == 0);
  CHECK(names("cover").find("the books' method; + exact Fresnel; + Sobol'; ") == 0);
  CHECK(names("cover").find("light sampling") == std::string::npos);
  CHECK(names("cover").find("+ Sobol'; + splitting; ") != std::string::npos);
  CHECK(names("showroom").find("+ Sobol'; + splitting; ") != std::string::npos);  // no light small enough for chains
  CHECK(names("stress-caustic-glass").find("+ Sobol'; + chains; + splitting; ") != std::string::npos);
  CHECK(names("stress-two-balls").find("+ Sobol'; + chains, guided light; + splitting; ") != std::string::npos);
  CHECK(names("stress-small-fuzz").find("+ Sobol'; + guided light; ") != std::string::npos);
  CHECK(names("stress-small-fuzz").find("splitting") == std::string::npos);
  CHECK(names("cornell-box").find("splitting") == std::string::npos);
  CHECK(names("cover").find("+ clean (filtered); + adaptive; Schlick; ") != std::string::npos);
  for (const ChartMethod& m : default_methods(load_scene("cover").scene))
    CHECK((m.settings.adaptive == (m.name == "+ adaptive") && m.clean == (m.name == "+ clean (filtered)")));
}

}  // namespace tyndall::test::methods_test
