// Renders a scene for several values of one setting, and prints how bright and how accurate each picture is:
//   sweep [SCENE [POINTER]]
#include <tyndall/tyndall.h>

#include <cstdio>

int main(int argc, char** argv) {
  try {
    tyndall::Scene scene = tyndall::Scene::load(argc > 1 ? argv[1] : "showroom");
    const char* pointer = argc > 2 ? argv[2] : "/camera/vfov";
    scene.set("/image/width", 160);
    scene.set("/image/height", 90);
    for (const double value : {20, 30, 40}) {
      scene.set(pointer, value);
      tyndall::RenderOptions options;
      options.spp = 16;
      const tyndall::Picture picture = tyndall::render(scene, options);
      double sum = 0;
      for (const float number : picture.rgb()) sum += static_cast<double>(number);
      std::printf("%s %g: mean %.4f, error %.2g\n", pointer, value, sum / static_cast<double>(picture.rgb().size()),
                  picture.error());
    }
  } catch (const tyndall::Error& error) {
    std::fprintf(stderr, "sweep: %s\n", error.what());
    return 2;
  }
  return 0;
}
