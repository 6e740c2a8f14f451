#include "app/cli/pictures.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

namespace tyndall::test::kept_pictures_test {

TEST_CASE("what is left to do of a picture: each file that is not whole, whatever others hold; with --fresh all") {
  RenderJob job{};
  job.kernels = find_kernels("");
  job.command.region = Region{}, job.command.spp = 1, job.command.frame = 3;
  const FrameList whole{"", {{3, "whole " + picture_mark(job)}}}, begun{"", {{3, "begun " + picture_mark(job)}}};
  const std::filesystem::path folder = scratch_folder("kept_pictures");
  for (const char* name : {"a.ppm", "b.ppm", "c.ppm"}) {
    const std::filesystem::path& file = job.command.outputs.emplace_back(folder / name);
    write_text(file, "P6");
    job.lists[file] = file.stem() == "b" ? &whole : &begun;
  }
  const auto all = job.command.outputs;
  CHECK(task_of(job).outputs == std::vector{all[0], all[2]});
  CHECK(task_of(job).film.empty());
  job.command.fresh = true;
  CHECK(task_of(job).outputs == all);
}

}  // namespace tyndall::test::kept_pictures_test
