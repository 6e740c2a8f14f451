#pragma once
#include <cmath>

/// What a reader's program is asked, and what it answers, as both sides write it. All are numbers, which go from one
/// program to the other as they lie in memory. Whoever includes this has a vector: x, y and z.
namespace tyndall_book {

/// How the program's loop goes through the picture, and its world, as it tells before it is asked.
struct picture_told {
  double width = 0, height = 0, samples = 0;  ///< 0: it is not known
  double less = 0;       ///< 1: the loop divides by width - 1 and height - 1, as editions 2 and 3 do
  double first_row = 0;  ///< 1: then rows count from 1, not from 0
  double by_pixels = 0;  ///< 1: get_ray() takes a column and a row, not parts of the picture's sides
  double depth = 0;      ///< that the loop begins with
  double world = 0;      ///< its address; 0: its classes are not those of the books
  double is_float = 0;   ///< 1: its numbers are
};

/// Begins each question, each answer, and what is told without a question. Objects are named by their addresses, which
/// are exact as numbers. s, m, t, k: the members of a shape, a material, a texture or the camera; see take.h.
struct question {
  double letter = 0, object = 0;
  double count = 0;  ///< how many answers are wanted, to questions that begin again behind the last one; 0: one each
  double size = 0;   ///< of the bytes that follow
};

/// h: a ray that a shape is asked for, between two ends of t. One question can be put to many shapes.
struct shot {
  vector from, to;
  double time = 0, low = 0.001, high = HUGE_VAL, shape = 0;
};
struct shot_answer {
  double found = 0, front = 1, t = 0, material = 0;
  vector normal;
};
/// x, e: where a ray that goes in the direction `to` meets a surface whose normal is y, from above (in front) or below.
/// v: what a texture is asked for. Emitted light and textures answer by a colour.
struct surface_point {
  vector p{0.3, -0.2, 0.7};
  double u = 0.37, v = 0.61;
  vector to{0.8, -0.6, 0};
  double front = 1;
};
/// What scatter() answers to x.
struct scatter_answer {
  double does = 0;
  vector part, to;
};
/// p, r: a place in the picture, in pixels from the upper left corner; what is its colour (p) or its ray.
struct pixel_place {
  double x = 0, y = 0;
};
/// y: a ray that meets nothing; what is its colour.
struct ray_answer {
  vector from, to;
  double time = 0;
};
/// c: the colour of a ray that hits one material so often, then another so often, then nothing.
struct light_question {
  double first = 0, firsts = 0, then = 0, thens = 0;
  vector from{0, 1, 0}, to{0.6, -0.8, 0};
};
struct light_answer {
  vector colour;
  double hits = 0;           ///< that were looked for
  double low = 0, high = 0;  ///< between which t of the first
  vector second;             ///< the direction behind it
};

}  // namespace tyndall_book
