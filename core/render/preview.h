#pragma once
#include <cstdint>

/// How the first pictures after an edit are paced. Pure decisions, so that they can be tested.
namespace tyndall {

/// Seconds in which the first picture should be there: what moves (a camera, a slider that is dragged) wants fluency, a
/// single change is looked at.
inline constexpr double moving_budget = 0.033, single_budget = 0.075;

/// Edits that follow each other within this many seconds are one movement.
inline constexpr double movement_gap = 0.3;

/// Every how many pixels (8, 4, 2 or 1, in x and y) a first picture samples, so that `pixels / step²` paths take about
/// `budget` seconds at `paths_per_second` (<= 0: unknown). `before`: the last answer, kept while the ideal is at
/// most 1.1 times coarser or 1.4 times finer, or the picture's sharpness would flicker.
int preview_step(std::int64_t pixels, double paths_per_second, double budget, int before);

/// Samples of the next full pass, after `taken` (>= 1): doubles what is there, but within about `seconds` a pass.
std::uint32_t pass_samples(std::uint32_t taken, std::int64_t pixels, double paths_per_second, double seconds);

}  // namespace tyndall
