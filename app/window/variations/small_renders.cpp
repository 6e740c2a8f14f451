#include "app/window/variations/strip.h"

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

}  // namespace

/// A request, which its jobs share. They run one after another, and each picture belongs to one of them at a time.
struct SmallRenders::Work {
  struct Item {
    std::shared_ptr<const PreparedScene> scene;  ///< null: there is none
    Film film;
  };
  SmallRequest request;
  std::uint64_t number = 0;
  std::vector<Item> items{};
  std::shared_ptr<const PreparedScene> before{};  ///< the scene that was prepared last
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();

  void prepare_item(std::size_t index) {
    auto scene = request.scene(index);
    if (scene) before = items[index].scene = prepare(std::make_shared<const Scene>(std::move(*scene)), before.get());
  }
  /// Renders a picture on, up to so many samples a pixel. Null: there is none.
  std::shared_ptr<const SmallPicture> render_on(Item& item, std::uint32_t samples,
                                                const ProgressCallback& go_on) const {
    if (!item.scene) return nullptr;
    RenderOptions options;
    options.threads = samples == first_samples ? request.threads : 1;
    options.spp = samples;
    options.clean = request.clean;
    RenderResult result = render(*item.scene, options, go_on, std::move(item.film));
    const Region& region = result.film.region;
    auto picture = std::make_shared<const SmallPicture>(SmallPicture{
        region.width(), region.height(), result.clean ? result.clean->rgb : resolve(result.film), samples});
    item.film = std::move(result.film);
    return result.interrupted ? nullptr : picture;
  }
};

void SmallRenders::request(SmallRequest request) {
  pictures_.assign(request.count, nullptr);
  stood_after_ = 0;
  const auto work = std::make_shared<Work>(Work{std::move(request), ++number_});
  work->items.resize(pictures_.size());
  for (std::size_t k = 0; k < pictures_.size(); ++k) first_.run(job(work, k, first_samples));
}

JobQueue::Job SmallRenders::job(const std::shared_ptr<Work>& work, std::size_t index, std::uint32_t samples) {
  return [this, work, index, samples]() -> JobQueue::Result {
    const auto is_newest = [this, number = work->number] { return number_ == number; };
    if (!is_newest()) return {};
    std::shared_ptr<const SmallPicture> picture;
    try {
      samples == first_samples ? work->prepare_item(index) : lower_priority(19);
      picture = work->render_on(work->items[index], samples, [&](const RenderProgress&) { return is_newest(); });
    } catch (const std::exception&) {
      work->items[index].scene = nullptr;  // such a scene has no picture
    }
    return [this, work, index, samples, picture, is_newest, seconds = seconds_since(work->start)] {
      if (!is_newest()) return;
      if (picture) pictures_[index] = picture;
      if (samples != first_samples || index + 1 < pictures_.size()) return;
      stood_after_ = seconds;
      for (const std::uint32_t more : further_samples)
        for (std::size_t k = 0; k < pictures_.size(); ++k) further_.run(job(work, k, more));
    };
  };
}

bool SmallRenders::collect() {
  const bool came = first_.collect();
  return further_.collect() || came;
}

}  // namespace tyndall
