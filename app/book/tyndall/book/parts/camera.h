#pragma once
#include "launch.h"
#include "shapes.h"

/// The camera of all editions. Its render() is where the scene is written.
namespace tyndall_book {

/// A colour that knows whether it was given.
struct given_color : color {
  bool given = false;
  given_color& operator=(const vec3& colour) {
    vec3::operator=(colour);
    given = true;
    return *this;
  }
};

/// A member that may be set, and called, to no effect.
struct ignored {
  template <class T>
  ignored& operator=(const T&) {
    return *this;
  }
  template <class... T>
  void operator()(const T&...) const {}
};

/// What cameras are copied by. Angles in degrees, lengths in scene units.
struct camera_values {
  double aspect_ratio = 1;
  int image_width = 100, image_height = 0;  ///< height 0: by the ratio
  int samples_per_pixel = 10, max_depth = 10;
  given_color background;
  double vfov = 90;
  point3 lookfrom = point3(0, 0, 0), lookat = point3(0, 0, -1);
  vec3 vup = vec3(0, 1, 0);
  double defocus_angle = 0, focus_dist = 10;
  int num_threads = 0, number_of_threads = 0;
  double shutter_open = 0, shutter_close = 1;
  bool has_aspect_ratio = false;  ///< it was given to the constructor, as in editions 1 to 3
};

/// The sky of a program that sets no background: the first book's, unless the caller knows better.
inline std::string usual_sky() {
  const char* sky = std::getenv("TYNDALL_BOOK_SKY");
  return sky ? sky : "{\"type\":\"gradient\",\"bottom\":[1,1,1],\"top\":[0.5,0.7,1]}";
}

/// The whole scene. sky: JSON. events: the longest path, in scattering events.
inline std::string scene_of(const camera_values& cam, const scene_text& objects, const std::string& sky, int events) {
  const int by_ratio = static_cast<int>(cam.image_width / cam.aspect_ratio);
  const int height = cam.image_height > 0 ? cam.image_height : std::max(1, by_ratio);
  std::string text =
      "{\"tyndall\":1,\"image\":{\"width\":" + std::to_string(cam.image_width) +
      ",\"height\":" + std::to_string(height) + "},\n\"camera\":{\"look_from\":" + triple(cam.lookfrom) +
      ",\"look_at\":" + triple(cam.lookat) + ",\"vup\":" + triple(cam.vup) + ",\"vfov\":" + number(cam.vfov) +
      ",\"defocus_angle\":" + number(cam.defocus_angle) + ",\"focus_distance\":" + number(cam.focus_dist) +
      ",\"shutter\":[" + number(cam.shutter_open) + "," + number(cam.shutter_close) + "]},\n\"background\":" + sky +
      ",\n\"render\":{\"spp\":" + std::to_string(cam.samples_per_pixel) + ",\"max_depth\":" + std::to_string(events) +
      "},\n\"textures\":{" + objects.textures + "},\n\"materials\":{" + objects.materials + "},\n\"objects\":[";
  for (std::size_t k = 0; k < objects.objects.size(); ++k) text += (k > 0 ? ",\n" : "\n") + objects.objects[k];
  return text + "\n]}\n";
}

/// Whether an argument of render() is the third book's list of lights: with it come lights that shine on one side.
template <class T>
constexpr bool is_list_of_lights() {
  return std::is_base_of<hittable, T>::value || std::is_convertible<const T&, ref<hittable>>::value;
}

}  // namespace tyndall_book

struct camera : tyndall_book::camera_values {
  // The names that readers give the same members.
  double &aspectRatio = aspect_ratio, &aspect = aspect_ratio;
  double &vFov = vfov, &vertical_fov = vfov, &verticalFov = vfov, &fov = vfov, &field_of_view = vfov;
  double &defocusAngle = defocus_angle, &focusDist = focus_dist, &focus_distance = focus_dist,
         &focusDistance = focus_dist;
  int &imageWidth = image_width, &width = image_width, &imageHeight = image_height, &height = image_height;
  int &samplesPerPixel = samples_per_pixel, &no_samples = samples_per_pixel, &num_samples = samples_per_pixel,
      &samples = samples_per_pixel, &spp = samples_per_pixel;
  int &maxDepth = max_depth, &depth = max_depth, &max_bounces = max_depth, &maxBounces = max_depth;
  point3 &lookFrom = lookfrom, &lookAt = lookat, &look_from = lookfrom, &look_at = lookat;
  vec3 &vUp = vup, &view_up = vup, &viewUp = vup;
  tyndall_book::given_color &backgroundColor = background, &background_color = background;

  TYNDALL_BOOK_CAMERA_MEMBERS

  camera(){TYNDALL_BOOK_CAMERA_DEFAULTS} camera(const camera& other) : camera_values(other) {}
  camera& operator=(const camera& other) {
    camera_values::operator=(other);
    return *this;
  }
  explicit camera(const std::string&) : camera() {}  // a reader's, with the name of the picture's file

#ifdef TYNDALL_BOOK_CAMERA_PARAMETERS  // a constructor of the reader's own: `tyndall main.cc` looks it up
  camera(TYNDALL_BOOK_CAMERA_PARAMETERS) { TYNDALL_BOOK_CAMERA_BODY }
#endif

  /// Editions 1 to 3. aperture: the lens's diameter; begin, end: when the shutter opens and closes.
  camera(const point3& from, const point3& at, const vec3& up, double field, double ratio, double aperture = 0,
         double focus = 0, double begin = 0, double end = 0)
      : camera(field, ratio) {
    lookfrom = from;
    lookat = at;
    vup = up;
    focus_dist = focus > 0 ? focus : (from - at).length();
    defocus_angle = 2 * std::atan(aperture / 2 / focus_dist) / tyndall_book::radians_of_degree;
    shutter_open = begin;
    shutter_close = end;
  }
  camera(double field, double ratio) {
    aspect_ratio = ratio;
    vfov = field;
    has_aspect_ratio = true;
  }

  /// Called by loops in main(): see loop.h.
  ray get_ray(double u, double v) const;
  ray getRay(double u, double v) const { return get_ray(u, v); }  // as some readers spell it
  ray GetRay(double u, double v) const { return get_ray(u, v); }

  /// Hands the scene over, or shows it. rest: lights of the third book, which are no part of the scene; a file's name,
  /// a number of threads of readers' own.
  template <class... Rest>
  bool render(const hittable& world, const Rest&...) const {
    static int calls = 0;
    if (++calls > 1 && tyndall_book::caller() >= 0) {
      if (calls == 2) tyndall_book::note("main() calls camera::render() more than once; this is its first picture");
      return true;
    }
    if (max_depth < 1)
      tyndall_book::refuse("max_depth of the camera is " + std::to_string(max_depth) + ": the book's picture is black");
    tyndall_book::scene_text objects;
    objects.one_sided_lights = (false || ... || tyndall_book::is_list_of_lights<Rest>());
    world.tyndall_write(objects, {});
    const std::string sky = background.given ? tyndall_book::triple(background) : tyndall_book::usual_sky();
    // A ray of the books that may hit max_depth things scatters one time less: at the last hit only light counts.
    tyndall_book::deliver(tyndall_book::scene_of(*this, objects, sky, max_depth - 1));
    return true;
  }
  template <class World, class... Rest>
  bool render(const shared_ptr<World>& world, const Rest&... rest) const {
    return render(*world, rest...);
  }
  template <class... Arguments>
  bool Render(const Arguments&... arguments) const {
    return render(arguments...);
  }
  // Readers' renders in several threads.
  template <class... Arguments>
  bool parallel_render(const Arguments&... arguments) const {
    return render(arguments...);
  }
  template <class... Arguments>
  bool render_parallel(const Arguments&... arguments) const {
    return render(arguments...);
  }
  template <class... Arguments>
  bool render_threaded(const Arguments&... arguments) const {
    return render(arguments...);
  }
  template <class... Arguments>
  bool render_multithreaded(const Arguments&... arguments) const {
    return render(arguments...);
  }
};
