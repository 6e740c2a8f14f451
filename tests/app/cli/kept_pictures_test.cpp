#include "app/cli/pictures.h"

#include <doctest/doctest.h>

namespace tyndall::test::kept_pictures_test {

TEST_CASE("what is left to do of a picture: each file that is not whole, whatever others hold; with --fresh all") {
  RenderJob job{};
  job.command.outputs = {"a.png", "b.png", "c.png"};
  const auto look = [](const std::filesystem::path& file) { return file == "b.png"; };
  CHECK(task_of(job, look).outputs == std::vector<std::filesystem::path>{"a.png", "c.png"});
  CHECK(task_of(job, look).film.empty());
  job.command.fresh = true;
  CHECK(task_of(job, look).outputs == job.command.outputs);
}

}  // namespace tyndall::test::kept_pictures_test
