#pragma once
#include "app/window/document/job_queue.h"
#include "core/scene/scene.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

/// This room shows what a value does: small pictures of the scene with the values of a row in steps.
namespace tyndall {

/// A small picture while it sharpens.
struct SmallPicture {
  int width = 0, height = 0;
  std::vector<float> rgb;  ///< linear, top row first
  std::uint32_t spp = 0;
};

/// What small renders are asked for.
struct SmallRequest {
  std::size_t count = 0;  ///< of pictures
  /// The scene of a picture, in the size that it is to have; nothing: there is none. Called in the background.
  std::function<std::optional<Scene>(std::size_t index)> scene;
  bool clean = false;  ///< pictures are filtered
  int threads = 1;     ///< for the first picture of each
};

/// Renders several small pictures in the background: first all of them with few samples, as quickly as it can, so that
/// they stand after a moment; then they sharpen in turn, on one thread of the lowest priority, so that the main picture
/// does not wait for them. For the main thread.
class SmallRenders {
 public:
  /// wake: collect() has something to do; called from any thread.
  explicit SmallRenders(const std::function<void()>& wake) : first_(wake), further_(wake) {}
  ~SmallRenders() { ++number_; }

  /// Takes the place of what was asked for before, and forgets its pictures. An empty one: renders nothing any more.
  void request(SmallRequest request);

  /// Takes what has come. Whether there was anything.
  bool collect();
  /// The newest picture of each; null: none yet, or there is none.
  const std::vector<std::shared_ptr<const SmallPicture>>& pictures() const { return pictures_; }
  /// Whether all pictures have all their samples.
  bool finished() const { return first_.idle() && further_.idle(); }
  /// Seconds from the request until all pictures stood; 0: they do not stand yet.
  double seconds_to_stand() const { return stood_after_; }

 private:
  struct Work;
  JobQueue::Job job(const std::shared_ptr<Work>& work, std::size_t index, std::uint32_t samples);

  std::vector<std::shared_ptr<const SmallPicture>> pictures_;
  double stood_after_ = 0;
  std::atomic<std::uint64_t> number_ = 0;  ///< counts the requests; jobs of earlier ones give up
  JobQueue first_, further_;               // last: their jobs use the others
};

}  // namespace tyndall
