#include "app/window/accuracy/comparison.h"

#include "app/report/heat_map.h"
#include "app/window/system/pacing.h"
#include "core/accuracy/error.h"
#include "core/accuracy/flip.h"
#include "core/system/process.h"

#include <numeric>

namespace tyndall {
namespace {

template <class Colour>
std::vector<float> map_of(const std::vector<float>& values, const Colour& colour_of) {
  std::vector<float> rgba;
  rgba.reserve(4 * values.size());
  for (const float value : values) {
    const std::array<float, 3> colour = colour_of(value);
    rgba.insert(rgba.end(), {colour[0], colour[1], colour[2], 1.0f});
  }
  return rgba;
}

std::array<float, 3> grey(float error) {
  const float shown = error < 1 ? error : 1.0f;  // also what is not a number
  return {shown, shown, shown};
}

bool has_picture(const Frame& frame) { return frame.spp > 0 && (frame.view == View::beauty || !frame.beauty.empty()); }

}  // namespace

bool can_compare(const ComparisonOrder& order) {
  if (!order.frame || !has_picture(*order.frame)) return false;
  const Frame& frame = *order.frame;
  if (order.kept)
    return has_picture(*order.kept) && order.kept->width == frame.width && order.kept->height == frame.height;
  return order.reference && order.reference->image.width == frame.width &&
         order.reference->image.height == frame.height;
}

ComparisonResult compare(const ComparisonOrder& order) {
  const double before = thread_cpu_seconds();
  const int width = order.frame->width, height = order.frame->height;
  const std::vector<float> image = picture_of(*order.frame);
  const std::vector<float> kept = order.kept ? picture_of(*order.kept) : std::vector<float>{};
  const std::vector<float>& against = order.kept ? kept : order.reference->image.rgb;
  ComparisonResult result;
  result.rel_mse = relative_mse(image, against);
  if (order.clean && order.frame->clean) result.clean_rel_mse = relative_mse(rgb_of(order.frame->clean->rgba), against);
  const double noise = !order.kept && order.independent ? order.reference->rel_mse : 0;
  result.rel_mse -= noise;
  if (result.clean_rel_mse) *result.clean_rel_mse -= noise;
  if (order.map == ErrorView::error) result.map = map_of(pixel_relative_error(image, against, width, height), grey);
  if (order.flip || order.map == ErrorView::flip) {
    const std::vector<float> flip = flip_map(image, against, width, height);
    result.flip = std::accumulate(flip.begin(), flip.end(), 0.0) / static_cast<double>(flip.size());
    if (order.map == ErrorView::flip) result.map = map_of(flip, heat);
  }
  result.cpu_seconds = thread_cpu_seconds() - before;
  return result;
}

}  // namespace tyndall
