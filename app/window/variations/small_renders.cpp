#include "app/window/variations/small_renders.h"

#include "app/window/document/job_queue.h"
#include "core/base/seconds.h"
#include "core/render/render.h"
#include "core/system/process.h"

#include <chrono>
#include <exception>
#include <utility>

namespace tyndall {
namespace {

constexpr std::uint32_t first_samples = 8;
constexpr std::uint32_t further_samples[] = {32, 128, 512};

/// Renders a picture on, up to so many samples a pixel.
SmallPicture render_on(const PreparedScene& scene, Film& film, const RenderOptions& options,
                       const ProgressCallback& go_on, bool& whole) {
  RenderResult result = render(scene, options, go_on, std::move(film));
  whole = !result.interrupted;
  const Region& region = result.film.region;
  SmallPicture picture{region.width(), region.height(), result.clean ? result.clean->rgb : resolve(result.film),
                       *options.spp};
  film = std::move(result.film);
  return picture;
}

}  // namespace

struct SmallRenders::Work {
  struct Item {
    std::shared_ptr<const PreparedScene> scene;  ///< null: there is none
    Film film;
  };
  SmallRequest request;
  std::uint64_t number = 0;
  std::vector<Item> items{};
};

SmallRenders::SmallRenders(std::function<void()> wake)
    : wake_(std::move(wake)), manager_([this](const StopToken& stop) { manage(stop); }) {}

SmallRenders::~SmallRenders() { closing_ = true; }

void SmallRenders::request(SmallRequest request) {
  const std::lock_guard lock(mutex_);
  pictures_.assign(request.count, nullptr);
  finished_ = request.count == 0;
  stood_after_ = 0;
  request_ = std::move(request);
  ++number_;
  changed_.notify_all();
}

std::vector<std::shared_ptr<const SmallPicture>> SmallRenders::pictures() const {
  const std::lock_guard lock(mutex_);
  return pictures_;
}

bool SmallRenders::is_newest(const Work& work) const { return !closing_ && number_ == work.number; }

void SmallRenders::manage(const StopToken& stop) {
  std::uint64_t done = 0;
  while (!stop.stop_requested()) {
    Work work;
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, stop, [&] { return number_ != done; })) return;
      work.request = request_;
      work.number = done = number_;
    }
    work.items.resize(work.request.count);
    render_first(work);
    // A thread cannot take its old priority back, so another one sharpens the pictures.
    const StoppableThread refiner([&](const StopToken&) {
      lower_priority(19);
      refine(work);
    });
    std::unique_lock lock(mutex_);
    changed_.wait(lock, stop, [&] { return number_ != done; });
  }
}

void SmallRenders::render_first(Work& work) {
  const auto start = std::chrono::steady_clock::now();
  std::shared_ptr<const PreparedScene> before;
  for (std::size_t k = 0; k < work.items.size() && is_newest(work); ++k) {
    try {
      auto scene = work.request.scene(k);
      if (!scene) continue;
      before = work.items[k].scene = prepare(std::make_shared<const Scene>(std::move(*scene)), before.get());
      RenderOptions options;
      options.threads = work.request.threads;
      options.spp = first_samples;
      options.clean = work.request.clean;
      bool whole = false;
      SmallPicture picture = render_on(
          *before, work.items[k].film, options, [&](const RenderProgress&) { return is_newest(work); }, whole);
      if (whole) publish(work, k, std::move(picture));
    } catch (const std::exception&) {
      work.items[k].scene = nullptr;  // such a scene has no picture
    }
  }
  if (!is_newest(work)) return;
  stood_after_ = seconds_since(start);
  tell();
}

void SmallRenders::refine(Work& work) {
  for (const std::uint32_t samples : further_samples)
    for (std::size_t k = 0; k < work.items.size(); ++k) {
      if (!is_newest(work)) return;
      if (!work.items[k].scene) continue;
      try {
        RenderOptions options;
        options.threads = 1;
        options.spp = samples;
        options.clean = work.request.clean;
        bool whole = false;
        SmallPicture picture = render_on(
            *work.items[k].scene, work.items[k].film, options, [&](const RenderProgress&) { return is_newest(work); },
            whole);
        if (!whole) return;
        publish(work, k, std::move(picture));
      } catch (const std::exception&) {
        work.items[k].scene = nullptr;
      }
    }
  if (!is_newest(work)) return;
  finished_ = true;
  tell();
}

void SmallRenders::tell() {
  news_ = true;
  wake_();
}

void SmallRenders::publish(const Work& work, std::size_t index, SmallPicture picture) {
  {
    const std::lock_guard lock(mutex_);
    if (number_ != work.number) return;
    pictures_[index] = std::make_shared<const SmallPicture>(std::move(picture));
  }
  tell();
}

}  // namespace tyndall
