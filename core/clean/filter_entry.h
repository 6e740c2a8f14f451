#pragma once
#include "core/clean/judge.h"
#include "core/clean/predict.h"

/// The filter's entry points as templates over the number type F, instantiated by one small .cpp file for each
/// instruction set. The functions are within a static one, so that each file has its own copy: of an ordinary template
/// the linker keeps one copy for all files, and a copy with wide instructions would crash older CPUs.
namespace tyndall::filter {

template <class F>
static FilterSteps filter_of() {
  return {[](const FilterView& view, int row) { sum_cells_of<F>(view, row); },
          [](const FilterView& view, int row) { fit_blocks_of<F>(view, row); },
          [](const FilterView& view, int row) { predict_of<F>(view, row); },
          [](const FilterView& view, Rival rival, int y) { compare_of<F>(view, rival, y); },
          [](const FilterView& view, Rival rival, int y) { mix_of<F>(view, rival, y); },
          [](const FilterView& view, int y) { judge_of<F>(view, y); },
          [](const FilterView& view, int y, float* pixel_error) { tell_of<F>(view, y, pixel_error); }};
}

}  // namespace tyndall::filter
