#pragma once
#include "core/base/math.h"

/// Chooses one of several candidates that are offered one after the other, with probabilities in proportion to their
/// weights, by a single random number. (M. T. Chao, A General Purpose Unequal Probability Sampling Plan, Biometrika
/// 69(3), 1982)
namespace tyndall {

template <class F>
struct Reservoir {
  F pick;              ///< random, in [0, 1): decides about the next thing
  F weight = F(0.0f);  ///< of all things so far

  /// Offers a candidate of weight `next` >= 0. Returns the lanes that take it in place of the one before.
  TYNDALL_INLINE MaskOf<F> offer(F next) {
    const F before = weight, at = pick * (before + next);
    const auto takes = less(at, next);
    const F left = select(takes, at, at - next) / max(select(takes, next, before), F(1e-37f));
    pick = select(less(F(0.0f), next), min(max(left, F(0.0f)), F(0.99999994f)), pick);
    weight = before + next;
    return takes;
  }
};

}  // namespace tyndall
