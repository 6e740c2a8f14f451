#pragma once
#include "core/clean/clean.h"

namespace tyndall::test {

/// What CleanInput::seen holds of a pixel.
struct FirstSeen {
  Vec3f albedo, normal;
  float nearness = 0;
  bool sharp = true;
};

/// Sets all pixels to seen(x, y).
inline void see_first(const auto& seen, int width, int height, CleanInput& input) {
  input.seen.resize(width, height, 8);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const FirstSeen s = seen(x, y);
      int plane = 0;
      for (const float value :
           {s.albedo.x, s.albedo.y, s.albedo.z, s.normal.x, s.normal.y, s.normal.z, s.nearness, s.sharp ? 1.0f : 0.0f})
        input.seen.plane(plane++)[y * input.seen.stride() + x] = value;
    }
}

}  // namespace tyndall::test
