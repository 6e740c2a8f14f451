#include "core/render/mailbox.h"
#include "core/render/sample_source.h"
#include "tests/support/watched_renderer.h"

#include <doctest/doctest.h>

/// What is asked of the renderer is one value: what follows from it depends on the values alone.
namespace tyndall::test::render_request_test {

namespace {

RenderRequest request_for(const Scene& scene) { return {.scene = std::make_shared<const Scene>(scene)}; }

}  // namespace

TEST_CASE("requests: each part that differs is told of, and what cannot wait for the pass to end") {
  ReceivedRequest before;
  before.wanted = request_for(small_scene("showroom", 40, 30, 4));
  const auto changed = [&](const auto& edit) {
    ReceivedRequest after = before;
    edit(after);
    return change_between(before, after);
  };
  const auto with = [&](auto RenderRequest::*part, auto value) {
    return changed([&](ReceivedRequest& after) { after.wanted.*part = value; });
  };
  CHECK_FALSE(changed([](ReceivedRequest&) {}).any());
  CHECK(changed([](ReceivedRequest& after) { ++after.edit; }).scene);
  CHECK(changed([](ReceivedRequest& after) { ++after.edit; }).is_urgent());
  CHECK(with(&RenderRequest::view, View::depth).drawing);
  CHECK(with(&RenderRequest::clean, true).is_urgent());
  CHECK(with(&RenderRequest::threads, 3).threads);
  CHECK(with(&RenderRequest::restarts, 1u).restart);
  CHECK(with(&RenderRequest::watched_pixel, std::pair{3, 4}).pixel);
  CHECK_FALSE(with(&RenderRequest::watched_pixel, std::pair{3, 4}).is_urgent());
  CHECK_FALSE(with(&RenderRequest::paused, true).any());  // it is the limit of the next pass that changes
  CHECK_FALSE(with(&RenderRequest::shown_pixels, 99).any());
  const RequestChange limit =
      with(&RenderRequest::scene, std::make_shared<const Scene>(small_scene("showroom", 40, 30, 9)));
  CHECK(limit.limit);
  CHECK_FALSE(limit.is_urgent());
  Mailbox mailbox;
  RenderRequest wanted = before.wanted;
  for (const bool urgent : {true, false}) {  // a scene, and then only whether it pauses
    mailbox.request(wanted);
    CHECK(mailbox.give_up() == urgent);
    mailbox.take();
    wanted.paused = true;
  }
}

TEST_CASE("requests: the limit is the scene's, one sample while it is paused, none without a scene") {
  ReceivedRequest request;
  CHECK(request.limit() == 0);
  request.wanted = request_for(small_scene("showroom", 40, 30, 7));
  CHECK(request.limit() == 7);
  request.wanted.paused = true;
  CHECK(request.limit() == 1);
  CHECK(request.full_spp() == 7);
}

TEST_CASE("requests: without a scene there is nothing to render, whatever else is asked for") {
  WatchedRenderer renderer;
  const Scene scene = small_scene("cornell-box", 24, 18, 2);
  const auto source = std::make_shared<const SampleSource>(SampleSource{[](double, double, std::uint64_t) {
    return Vec3f{1, 1, 1};
  }});
  CHECK(renderer.set(&RenderRequest::samples, source) == 0);
  CHECK(renderer.set(&RenderRequest::film, std::make_shared<Film>()) == 0);
  renderer.catch_up();
  renderer.set(&RenderRequest::samples, nullptr);
  const std::uint64_t edit = renderer.submit(scene);
  CHECK(rgb_of(*renderer.wait_finished(edit)) == reference_picture(scene));
  CHECK(renderer.submit(nullptr) == edit);  // what was rendered stays
  renderer.catch_up();
  CHECK(rgb_of(*renderer->reply().frame) == reference_picture(scene));
}

TEST_CASE("requests: the same one again gives no other frame") {
  WatchedRenderer renderer;
  const std::uint64_t edit = renderer.submit(small_scene("showroom", 40, 30, 3));
  renderer.wait_finished(edit);
  renderer.catch_up();
  const std::size_t calls = renderer.calls();
  for (int i = 0; i < 100; ++i) CHECK(renderer->request(renderer.wanted()) == edit);
  renderer.catch_up();
  CHECK(renderer.calls() == calls);
}

TEST_CASE("requests: a film that is gone on from is not lost when another request follows before it was taken") {
  const Scene scene = small_scene("cornell-box", 40, 40, 6);
  RenderOptions options{.spp = 4};
  RenderRequest request = request_for(scene);
  request.film = std::make_shared<Film>(render(compile(scene), options).film);
  WatchedRenderer renderer;
  const std::uint64_t edit = renderer->request(request);
  request.view = View::samples;
  CHECK(renderer->request(request) == edit);
  const FramePointer first = renderer.wait_for([](const Frame&) { return true; });
  CHECK(first->spp >= 4);
  const FramePointer last =
      renderer.wait_for([&](const Frame& f) { return f.finished && f.edit == edit && f.view == View::samples; });
  CHECK(last->beauty.size() == last->rgba.size());
  options.spp = 6;
  CHECK(renderer->film() == render(compile(scene), options).film);
  ++request.restarts;  // the film was used up
  const std::size_t before = renderer.frames().size();
  CHECK(renderer->request(request) == edit);
  CHECK(renderer.wait_for([](const Frame&) { return true; }, before)->spp <= 1);
}

}  // namespace tyndall::test::render_request_test
