#pragma once
#include "tests/bench/table.h"

/// What is known of the machine on which the figures are measured.
namespace tyndall::bench {

/// The program, the compiler and the processor with which the figures are measured.
Json machine();

/// Threads that this process may run at once (see thread_count), at most `maximum`.
int threads_up_to(int maximum);

}  // namespace tyndall::bench
