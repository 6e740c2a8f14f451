#pragma once
#include "tests/bench/table.h"

namespace tyndall::bench {

/// Where and with what the figures were made: program, compiler, processor.
Json machine();

/// Threads that the machine runs at once, at most `most`.
int threads_up_to(int most);

}  // namespace tyndall::bench
