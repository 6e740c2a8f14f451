#pragma once
#include <doctest/doctest.h>

/// CAPTURE for a name that a structured binding made: clang before 16 does not let lambdas use those.
#define CAPTURE_BOUND(name)      \
  const auto name##_copy = name; \
  CAPTURE(name##_copy)
