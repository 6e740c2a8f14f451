#pragma once
#include "core/clean/judge.h"
#include "core/clean/predict.h"

/// The filter's entry points as templates over the number type F, instantiated by one small .cpp file for each
/// instruction set. The functions are static, so that each file has its own copy: of an ordinary template the linker
/// keeps one copy for all files, and a copy with wide instructions would crash older CPUs.
namespace tyndall::filter {

template <class F>
static void sum_cells_entry(const FilterView& view, int row) {
  sum_cells_of<F>(view, row);
}
template <class F>
static void fit_blocks_entry(const FilterView& view, int row) {
  fit_blocks_of<F>(view, row);
}
template <class F>
static void predict_entry(const FilterView& view, int row) {
  predict_of<F>(view, row);
}
template <class F>
static void compare_entry(const FilterView& view, Rival rival, int y) {
  compare_of<F>(view, rival, y);
}
template <class F>
static void mix_entry(const FilterView& view, Rival rival, int y) {
  mix_of<F>(view, rival, y);
}
template <class F>
static void judge_entry(const FilterView& view, int y) {
  judge_of<F>(view, y);
}
template <class F>
static void tell_entry(const FilterView& view, int y, float* pixel_error) {
  tell_of<F>(view, y, pixel_error);
}

template <class F>
static FilterSteps filter_of() {
  return {sum_cells_entry<F>, fit_blocks_entry<F>, predict_entry<F>, compare_entry<F>,
          mix_entry<F>,       judge_entry<F>,      tell_entry<F>};
}

}  // namespace tyndall::filter
