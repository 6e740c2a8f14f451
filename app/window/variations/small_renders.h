#pragma once
#include "core/base/stoppable.h"
#include "core/scene/scene.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

/// This room shows what a value does: small pictures of the scene with the values of a row in steps.
namespace tyndall {

/// A small picture while it sharpens. Never changes once it is shared.
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
/// does not wait for them. For the main thread unless it says otherwise.
class SmallRenders {
 public:
  /// wake: a picture has come; called from any thread.
  explicit SmallRenders(std::function<void()> wake);
  ~SmallRenders();

  /// Takes the place of what was asked for before, and forgets its pictures.
  void request(SmallRequest request);
  /// Renders nothing any more.
  void stop() { request({}); }

  /// The newest picture of each; null: none yet, or there is none.
  std::vector<std::shared_ptr<const SmallPicture>> pictures() const;
  /// Whether anything has come since the last call.
  bool take_news() { return news_.exchange(false); }
  /// Whether all pictures have all their samples.
  bool finished() const { return finished_; }
  /// Seconds from the request until all pictures stood; 0: they do not stand yet.
  double seconds_to_stand() const { return stood_after_; }

 private:
  struct Work;
  void manage(const StopToken& stop);
  void render_first(Work& work);
  void refine(Work& work);
  void tell();
  void publish(const Work& work, std::size_t index, SmallPicture picture);
  bool is_newest(const Work& work) const;

  std::function<void()> wake_;
  mutable std::mutex mutex_;  ///< guards the next three
  SmallRequest request_;
  std::vector<std::shared_ptr<const SmallPicture>> pictures_;
  StoppableCondition changed_;
  std::atomic<std::uint64_t> number_ = 0;  ///< counts the requests
  std::atomic<bool> finished_ = true, news_ = false;
  std::atomic<double> stood_after_ = 0;
  std::atomic<bool> closing_ = false;
  StoppableThread manager_;  // declared last, because it uses the others
};

}  // namespace tyndall
