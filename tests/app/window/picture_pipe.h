#pragma once
#include "app/window/window.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <array>
#include <memory>
#include <string>

namespace tyndall::test {

/// A picture that a program writes, as the command line gives it to a window.
class PicturePipe {
 public:
  PicturePipe() { REQUIRE(pipe(ends_.data()) == 0); }
  ~PicturePipe() {
    close_writer();
    close(ends_[0]);
  }
  PicturePipe(const PicturePipe&) = delete;
  PicturePipe& operator=(const PicturePipe&) = delete;

  /// Must be called after the picture's head was written.
  void give_to(WindowOptions& options, int width, int height) {
    const int in = ends_[0];
    options.picture = std::make_shared<ArrivingPicture>(in, beginning_of(in).bytes, "standard input", PpmCurve::srgb);
    options.scene = {};
    options.scene.name = "standard input";
    options.scene.is_picture = true;
    options.scene.scene.width = width, options.scene.scene.height = height;
    options.scene.scene.render.spp = 1;
  }
  void write(const std::string& text) const {
    REQUIRE(::write(ends_[1], text.data(), text.size()) == static_cast<ssize_t>(text.size()));
  }
  void close_writer() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

}  // namespace tyndall::test
