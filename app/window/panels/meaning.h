#pragma once
#include "core/scene/scene.h"

#include <string>
#include <string_view>

/// What a value means, in words: the grey line beneath a slider. Pure.
namespace tyndall {

/// Fraction of white light, spread over directions as from a bright sky, that a fuzzy metal loses below its surface:
/// 1 - metal_survival averaged over the cosine, which is fuzz² / 10. In [0, 0.1].
double fuzz_loss(double fuzz);
/// Share that Henyey and Greenstein's law sends into the forward half, in [0, 1]; g in (-1, 1).
double forward_fraction(double g);

/// The range of depths that one pixel shows sharp: blur discs of at most a pixel. far is infinite beyond the hyperfocal
/// distance.
struct SharpRange {
  double near = 0, far = 0;
};
SharpRange sharp_range(const Camera& camera, int image_height);

/// The grey line for a field of each struct that has something to say; "" where there is nothing.
std::string meaning(const Metal<>& metal, std::string_view field);
std::string meaning(const Dielectric<>& glass, std::string_view field);
std::string meaning(const Medium<>& medium, std::string_view field);
std::string meaning(const Sphere<>& sphere, std::string_view field);
std::string meaning(const Disk<>& disk, std::string_view field);
std::string meaning(const Camera& camera, std::string_view field);
std::string meaning(const Display& display, std::string_view field);

/// What a colour does, as the albedo or radiance of a material or medium.
std::string colour_meaning(const Material& material, Vec3d colour);
std::string albedo_meaning(const Medium<>& medium, Vec3d albedo);

}  // namespace tyndall
