#include "app/files/own_samples.h"

#include <algorithm>

namespace tyndall {

OwnSamples::OwnSamples() : held_(std::make_shared<Held>()) {
  const auto remove = [held = held_](WatchedFunction* function) { delete function; };
  function_ = {new WatchedFunction(compute, held_.get()), remove};
}

void OwnSamples::compute(void* held, double x, double y, std::uint64_t, double rgb[3]) {
  auto& its = *static_cast<Held*>(held);
  std::unique_lock lock(its.mutex);
  const std::shared_ptr<OwnProgram> program = its.program;
  lock.unlock();
  if (!program) return;
  const std::vector<double> colour = program->samples({x, y});
  std::copy(colour.begin(), colour.end(), rgb);
}

void OwnSamples::take(std::shared_ptr<OwnProgram> program, const std::string& reason) {
  const std::lock_guard lock(held_->mutex);
  held_->taken += program ? 1 : 0;
  held_->program.swap(program);
  held_->reason = reason;
}

std::string OwnSamples::reason() const {
  const std::lock_guard lock(held_->mutex);
  return held_->reason;
}

std::uint32_t OwnSamples::taken() const {
  const std::lock_guard lock(held_->mutex);
  return held_->taken;
}

}  // namespace tyndall
