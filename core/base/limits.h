#pragma once
#include <string>

/// What the system lets this process have.
namespace tyndall {

/// The limits of memory that are set for this process, as messages add them: " (the address space is limited to 0.3 GB:
/// ulimit -v)"; "" if there are none.
std::string memory_limit_text();
/// Those that can keep a thread from starting: "; this user may have 64 threads and processes: ulimit -u".
std::string thread_limit_text();

}  // namespace tyndall
