/* Rings that become finer outwards, in Tyndall's window: rings [OUTPUT.png]. */
#include <tyndall/watch.h>
#include <math.h>

struct picture {
  double centre_x, centre_y;
};

static void rings(void* user, double x, double y, uint64_t sample, double rgb[3]) {
  const struct picture* picture = user;
  const double across = x - picture->centre_x, down = y - picture->centre_y;
  const double grey = 0.5 + 0.5 * cos(0.01 * (across * across + down * down));
  (void)sample; /* the function has no random numbers of its own: the points are spread over each pixel */
  rgb[0] = grey;
  rgb[1] = 0.9 * grey;
  rgb[2] = 0.7 * grey;
}

int main(int count, char** arguments) {
  struct picture picture = {160, 120};
  tyndall_watch_options options = TYNDALL_WATCH_OPTIONS;
  options.title = "rings";
  if (count > 1) options.output = arguments[1];
  return tyndall_watch(320, 240, rings, &picture, &options);
}
