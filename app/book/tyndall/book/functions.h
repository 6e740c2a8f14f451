#pragma once
#include <cmath>

/// What the calls that are inserted into the reader's code and the library that is linked to it (app/book/inside) know
/// of each other. Whoever includes this has a vector: x, y and z.
namespace tyndall_book {

/// How the program's loop goes through the picture, and what its functions do otherwise than Tyndall's.
struct picture_told {
  int width = 0, height = 0, samples = 0;  ///< 0: it is not known
  int less = 0;                            ///< 1: the loop divides by width - 1 and height - 1, as editions 2 and 3 do
  int first_row = 0;                       ///< 1: then rows count from 1, not from 0
  int depth = 0;                           ///< that the loop begins with
  bool by_pixels = false;                  ///< get_ray() takes a column and a row, not parts of the picture's sides
  bool draws_by_pdf = false;               ///< it draws directions as the third book does, from mixtures
  bool decodes_images = false;             ///< it lets its library decode images
  bool fuzz_on_sphere = false;             ///< its metals are those of the fourth edition
  bool matt_in_sphere = false;             ///< its matt surfaces are those of the first edition
  bool has_noise = false;                  ///< it has textures of noise, whose lattice is its own
  bool has_images = false;                 ///< it has textures of images, which it reads by a curve of its own
};

/// A place in the picture, in pixels from the upper left corner.
struct pixel_place {
  double x = 0, y = 0;
};
/// Begins what one program sends to the other: a letter, and the bytes that follow. From the reader's program: F, a
/// file that is missing; P, its picture_told; I, of the scene's next texture of an image, image_values; S, a scene that
/// begins with a brace, or why there is none; N, a note for the user; A, colours; E, why there is nothing to be shown.
/// To it: pixel_places, whose colours are wanted.
struct message_head {
  double letter = 0, size = 0;
};
/// What a texture of an image is at a place.
struct image_value {
  double u = 0, v = 0;
  vector colour;
};

struct ray_parts {
  vector from, to;
  double time = 0;
};
/// A ray that a shape is asked for, between two ends of t.
struct shot : ray_parts {
  double low = 0.001, high = HUGE_VAL;
};
struct hit_answer {
  bool found = false, front = true;
  double t = 0;
  const void* material = nullptr;
  vector normal;
};
/// Where a ray that goes in the direction `to` meets a surface whose normal is y, from above (in front) or below.
struct surface_point {
  vector p{0.3, -0.2, 0.7};
  double u = 0.37, v = 0.61;
  vector to{0.8, -0.6, 0};
  bool front = true;
};
struct scatter_answer {
  bool does = false;
  vector part, to;
};
/// The colour of a ray that hits one material so often, then another so often, then nothing.
struct light_question {
  const void* first = nullptr;
  int firsts = 0;
  const void* then = nullptr;
  int thens = 0;
  vector from{0, 1, 0}, to{0.6, -0.8, 0};
};
struct light_answer {
  vector colour;
  int hits = 0;              ///< that were looked for
  double low = 0, high = 0;  ///< between which t of the first; 0: it does not ask its world
  vector second;             ///< the direction behind it
};

/// Takes an object of the reader's.
struct description {
  /// A member, with the key of its name. n: a number, v: a vector, r: a ray's origin and direction.
  virtual void take_numbers(char kind, const char* key, const double* numbers, int count) = 0;
  /// s, m, t: a member that is, or points to, a shape, a material, a texture. c: the whole object, with the mangled
  /// name of its class.
  virtual void take_object(char kind, const char* key, const void* object) = 0;
};

/// The reader's functions of his objects. k: the camera is described, without an object.
struct program_functions {
  hit_answer (*hit)(const void* shape, const shot& ray);
  scatter_answer (*scatter)(const void* material, const surface_point& at);
  vector (*emitted)(const void* material, const surface_point& at);
  vector (*value)(const void* texture, const surface_point& at);
  light_answer (*light)(const light_question& question);
  void (*describe)(char kind, const void* object, description& to);
  bool is_float;  ///< his numbers are
  bool draws_by_pdf, decodes_images;
};

/// The reader's loop. Rays are objects of his class; those that are returned live until the next call.
struct program_loop {
  const void* (*ray)(double first, double second) = nullptr;  ///< get_ray(); null: there is none yet
  bool by_pixels = false;                                     ///< its arguments are whole numbers
  void (*tell_size)(picture_told& size) = nullptr;            ///< what his camera's members tell of the picture
  void (*describe_camera)(description& to) = nullptr;
  const void* (*made)(const ray_parts& parts) = nullptr;
  ray_parts (*parts)(const void* ray) = nullptr;
  vector (*colour)(const void* ray) = nullptr;  ///< what he computes
  const void* world = nullptr;                  ///< a shape; null: it is none
  int depth = 0;
  bool alone = false;  ///< see goes_on_alone()
};

// Of the library.
#pragma GCC visibility push(default)
program_loop& loop();
/// The last arguments of get_ray(), in this thread.
void keep_place(double first, double second);
/// Whether all is known of the loop; called for each of its rays, which get black until then.
bool knows_loop(const void* ray);
/// Forks the program. True in the new one, which goes on for 2 s at most, with light that is known in place of what it
/// would compute: so it is seen how it writes light, and whether it makes further pictures.
bool goes_on_alone();
constexpr double known_light[] = {0.25, 0.64, 4};
/// Takes the world over, if there are functions, then serves samples.
[[noreturn]] void serve(const program_functions* functions);
/// Inserted into the constructors of textures: at their end it is known which file was read for them.
struct texture_made {
  const void* texture;
  ~texture_made();
};
/// Only one of the reader's threads at a time; the one that is served keeps it for good, and the others wait.
struct one_thread {
  one_thread();
  ~one_thread();
  one_thread(const one_thread&) = delete;
};
#pragma GCC visibility pop

}  // namespace tyndall_book
