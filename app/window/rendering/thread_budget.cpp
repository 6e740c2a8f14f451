#include "app/window/rendering/thread_budget.h"

#include <utility>

namespace tyndall {
namespace {

constexpr double slice = 0.3, slack = 0.5;  // seconds of a turn; by which one may be ahead while both work

}  // namespace

Active next_active(Active now, RenderingTime first, RenderingTime second, bool together) {
  if (first.finished || second.finished) return Active::both;  // one that has finished takes no time from the other
  const double lead = first.seconds - second.seconds;
  if (together) {
    if (now == Active::second && lead > 0) return Active::second;
    if (now == Active::first && lead < 0) return Active::first;
    return lead > slack ? Active::second : lead < -slack ? Active::first : Active::both;
  }
  if (now == Active::both) return lead > 0 ? Active::second : Active::first;
  if (now == Active::first) return lead > slice ? Active::second : Active::first;
  return lead < -slice ? Active::first : Active::second;
}

void ThreadBudget::begin(int threads, bool split) {
  threads_ = threads, split_ = split;
  active_ = split && !together() ? Active::first : Active::both;
}

bool ThreadBudget::go_on(RenderingTime current, RenderingTime kept) {
  const Active active = split_ ? next_active(active_, current, kept, together()) : Active::both;
  return std::exchange(active_, active) != active;
}

RenderRequest ThreadBudget::part_of(RenderRequest wanted, Half half) const {
  if (split_ && together()) wanted.threads /= 2;
  wanted.paused |= active_ == (half == Half::current ? Active::second : Active::first);
  return wanted;
}

}  // namespace tyndall
