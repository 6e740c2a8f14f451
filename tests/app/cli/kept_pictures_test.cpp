#include "app/cli/pictures.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

namespace tyndall::test::kept_pictures_test {

TEST_CASE("what is left to do of a picture: each file that is not whole, whatever others hold; with --fresh all") {
  RenderJob job{};
  job.kernels = find_kernels("");
  job.command.region = Region{}, job.command.spp = 1, job.command.frame = 3;
  const std::filesystem::path whole = scratch_folder("kept_pictures") / "b.ppm";
  write_text(whole, "P6");
  const FrameList list{"", {{3, "whole " + picture_mark(job)}}};
  job.lists[whole] = &list;
  job.command.outputs = {"a.png", whole, "c.png"};
  CHECK(task_of(job).outputs == std::vector<std::filesystem::path>{"a.png", "c.png"});
  CHECK(task_of(job).film.empty());
  job.command.fresh = true;
  CHECK(task_of(job).outputs == job.command.outputs);
}

}  // namespace tyndall::test::kept_pictures_test
