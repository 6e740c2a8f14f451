#include "app/book/camera_constructor.h"

#include <doctest/doctest.h>

using namespace tyndall;

TEST_CASE("camera: values that its members begin with, where these are plain numbers") {
  CHECK(camera_defaults("class camera { public: double aspect_ratio = 16.0 / 9; int image_width{400}; double vfov; "
                        "point3 lookfrom = point3(0, 1, -1); vec3 vup = {0, 1, 0}; };") ==
        "#define TYNDALL_BOOK_CAMERA_DEFAULTS aspect_ratio = double(16.0/9); image_width = int(400); "
        "lookfrom = point3(0,1,-1); vup = vec3(0,1,0); \n");
  CHECK(camera_defaults("class Camera { double m_vfov = 20; };") ==
        "#define TYNDALL_BOOK_CAMERA_DEFAULTS vfov = double(20); \n");
  CHECK(camera_defaults("class camera { double vfov = wide(); int max_depth = limit; point3 lookat = a + b; };") == "");
  CHECK(camera_defaults("class camera { int image_height = 100; void f() { double vfov = 3; } }; class other { double "
                        "vfov = 4; };") == "");
}

TEST_CASE("camera: members that are called nearly like one of the books'") {
  const std::string camera =
      "class camera { double ascpect_ratio; int sample_per_pix; int max_ray_depth = 5; vec3 v_up; "
      "double hfov, blur; point3 lookto, focus_point; color backgroundcolour; };";
  CHECK(camera_alias(camera, "ascpect_ratio") == "double& ascpect_ratio = aspect_ratio;");
  CHECK(camera_alias(camera, "sample_per_pix") == "int& sample_per_pix = samples_per_pixel;");
  CHECK(camera_alias(camera, "max_ray_depth") == "int& max_ray_depth = max_depth;");
  CHECK(camera_alias(camera, "v_up") == "vec3& v_up = vup;");
  CHECK(camera_alias(camera, "lookto") == "point3& lookto = lookat;");
  CHECK(camera_alias(camera, "backgroundcolour") == "tyndall_book::given_color& backgroundcolour = background;");
  for (const char* other : {"hfov", "blur", "focus_point", "vfov"}) CHECK(camera_alias(camera, other) == "");
  CHECK(camera_alias("class camera { double aspect_ratio, ascpect_ratio; };", "ascpect_ratio") == "");
}
