#pragma once
#include <memory>

namespace tyndall {

/// Returns the pointer in which jobs keep memory on the calling pool thread from one job to the next; null at first.
/// Only one kind of job may use it. (A thread_local with a destructor would end the program where there is no memory to
/// register the destructor.)
std::shared_ptr<void>& thread_pool_memory();

}  // namespace tyndall
