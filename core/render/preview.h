#pragma once
#include <cstdint>

/// How the first pictures after an edit are paced. Pure decisions, so that they can be tested.
namespace tyndall {

/// Seconds that the first picture of an edit should take. A camera wants fluency and gets a frame of a 60 Hz display,
/// so that its picture is there in two of them on a busy machine too; a slider that is dragged gets two; a single
/// change is looked at. since: seconds from the edit before it; within 0.3 they are one movement.
double picture_budget(bool only_camera, double since);

/// Every how many pixels (8, 4, 2 or 1, in x and y) a first picture samples, so that `pixels / step²` paths take about
/// `budget` seconds at `paths_per_second` (<= 0: unknown). `before`: the last answer, kept while the ideal is at
/// most 1.1 times coarser or 1.4 times finer, or the picture's sharpness would flicker.
int preview_step(std::int64_t pixels, double paths_per_second, double budget, int before);

/// Samples of the next full pass, after `taken` (>= 1): doubles what is there, but within about `seconds` a pass.
std::uint32_t pass_samples(std::uint32_t taken, std::int64_t pixels, double paths_per_second, double seconds);

}  // namespace tyndall
