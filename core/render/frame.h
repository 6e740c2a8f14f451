#pragma once
#include "core/base/crew.h"
#include "core/film/film.h"
#include "core/kernel/kernels.h"
#include "core/render/renderer.h"

#include <vector>

/// From a film to what is shown. Values are linear; exposure and tone mapping are the display's.
namespace tyndall {

/// RGBA of a film's means. step > 1: only every step-th pixel has samples; the others are filled in between (bilinear),
/// in the picture only.
std::vector<float> beauty_rgba(const Film& film, int step, Crew& crew);

/// A picture of one grey.
std::vector<float> grey_rgba(std::size_t pixels, float grey);

/// Estimated relative error of each pixel (see pixel_relative_error) as grey: 1 is 100 % and more.
std::vector<float> noise_rgba(const Film& film);

/// Samples of each pixel over the most any pixel has, as grey.
std::vector<float> samples_rgba(const Film& film);

/// Albedo, normal (x, y, z in [0, 1]) or depth (grey; 1 at the farthest) of what is first seen. hits: a frame's worth.
std::vector<float> first_hit_rgba(const std::vector<FirstHit>& hits, View view);

/// What is first seen through every pixel of the image.
std::vector<FirstHit> find_first_hits(const Kernels& kernels, const SceneView& scene, Crew& crew);

}  // namespace tyndall
