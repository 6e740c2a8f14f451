#pragma once
#include <memory>

namespace tyndall {

/// What the jobs of a thread pool keep on the calling thread, which must be one of a thread pool's, from one to the
/// next; at first null. One kind of job may use it. (A thread_local with a destructor ends the program where there is
/// no memory to note the destructor.)
std::shared_ptr<void>& thread_pool_memory();

}  // namespace tyndall
