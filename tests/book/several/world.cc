#include "world.h"


hittable_list balls() {
  hittable_list list;
  list.add(make_shared<sphere>(point3(0, 0, -2), 1.0, make_shared<lambertian>(color(0.5, 0.5, 0.5))));
  return list;
}
