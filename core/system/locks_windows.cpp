#include "core/system/locks.h"

#include "core/system/windows_api.h"

namespace tyndall {
namespace {

static_assert(sizeof(SRWLOCK) == sizeof(void*) && sizeof(CONDITION_VARIABLE) == sizeof(void*));

SRWLOCK* native_lock(void** lock) { return reinterpret_cast<SRWLOCK*>(lock); }
CONDITION_VARIABLE* native_condition(void** condition) { return reinterpret_cast<CONDITION_VARIABLE*>(condition); }

}  // namespace

void Mutex::lock() { AcquireSRWLockExclusive(native_lock(&lock_)); }
void Mutex::unlock() { ReleaseSRWLockExclusive(native_lock(&lock_)); }

void Condition::notify_one() { WakeConditionVariable(native_condition(&condition_)); }
void Condition::notify_all() { WakeAllConditionVariable(native_condition(&condition_)); }

void Condition::sleep(std::unique_lock<Mutex>& lock, unsigned milliseconds) {
  SleepConditionVariableSRW(native_condition(&condition_), native_lock(&lock.mutex()->lock_), milliseconds, 0);
}

}  // namespace tyndall
