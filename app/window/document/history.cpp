#include "app/window/document/history.h"

#include <utility>

namespace tyndall {

History::History(Document start) { steps_.push_back(std::move(start)); }

bool History::record(Document next, std::uint64_t gesture) {
  if (next == current()) return false;
  steps_.resize(at_ + 1);
  if (open_ && gesture != 0 && gesture == gesture_) {
    if (at_ > 0 && next == steps_[at_ - 1]) {
      steps_.pop_back();
      --at_;
      open_ = false;
    } else {
      steps_[at_] = std::move(next);
    }
    return true;
  }
  steps_.push_back(std::move(next));
  if (steps_.size() > most_steps) steps_.erase(steps_.begin());
  at_ = steps_.size() - 1;
  gesture_ = gesture;
  open_ = true;
  return true;
}

void History::set_origin(const std::shared_ptr<const Origin>& origin) {
  // Every step of the same file is now compared with what was saved.
  const auto before = current().origin;
  for (Document& step : steps_)
    if (step.origin == before) step.origin = origin;
}

/// The number of the step that unsaved() returns; steps_.size(): none.
std::size_t History::unsaved_step() const {
  for (std::size_t step = at_ + 1; step-- > 0;) {
    const bool last_of_its_scene = step == at_ || steps_[step].origin->what != steps_[step + 1].origin->what;
    if (last_of_its_scene && edited(steps_[step])) return step;
  }
  return steps_.size();
}

const Document* History::unsaved() const {
  const std::size_t step = unsaved_step();
  return step < steps_.size() ? &steps_[step] : nullptr;
}

void History::go_to_unsaved() {
  const std::size_t step = unsaved_step();
  if (step == steps_.size()) return;
  at_ = step;
  open_ = false;
}

bool History::undo() {
  open_ = false;
  if (!can_undo()) return false;
  --at_;
  return true;
}

bool History::redo() {
  open_ = false;
  if (!can_redo()) return false;
  ++at_;
  return true;
}

}  // namespace tyndall
