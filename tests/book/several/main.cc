// Written for Tyndall's tests: several source files, and a header in a folder that -I names.
#include "books.h"
#include "sky_colour.h"
#include "world.h"

int main() {
  camera cam;
  cam.image_width = 16;
  cam.background = sky_colour;
  cam.render(balls());
}
