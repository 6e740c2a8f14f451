#pragma once
#include "app/window/panels/widgets.h"
#include "core/render/frame.h"
#include "core/scene/settings.h"

#include <array>
#include <cstdint>
#include <vector>

/// How bright the picture is, as the screen shows it.
namespace tyndall {

/// How many of a picture's pixels have which value on the screen.
struct Histogram {
  static constexpr std::size_t bins = 64;
  std::array<std::array<std::uint32_t, bins>, 3> counts{};  ///< of red, green, blue: from black to white
  std::uint32_t pixels = 0;                                 ///< that were counted
  double white = 0;  ///< fraction of the pixels with a channel that the screen cannot show brighter
  double black = 0;  ///< fraction of the pixels that are shown black
};

/// rgba: linear, 4 floats a pixel. Counts about 16,000 pixels, evenly spread.
Histogram histogram_of(const std::vector<float>& rgba, const Display& display);

/// The histogram of what is on the screen, kept until that changes.
class LiveHistogram {
 public:
  const Histogram& of(const Frame& frame, const Display& display);

 private:
  std::uint64_t pass_ = 0;
  const void* clean_ = nullptr;
  Display display_;
  Histogram histogram_;
};

/// The section with the histogram. frame: on the screen; null: none.
void histogram_section(Ui& ui, LiveHistogram& live, const Frame* frame, const Display& display);

}  // namespace tyndall
