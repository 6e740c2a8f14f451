#pragma once
#include "core/api/inside.h"

#include <tyndall/tyndall.h>

#include <cfenv>
#include <new>

/// What every call of the library does first and last.
namespace tyndall::inner {

/// The environment of floating point in which pictures are computed: rounding to nearest, numbers next to zero kept.
/// Threads that are started meanwhile inherit it. At its end the caller has its own one again.
class PlainFloatingPoint {
 public:
  PlainFloatingPoint() {
    std::fegetenv(&callers_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~PlainFloatingPoint() { std::fesetenv(&callers_); }
  PlainFloatingPoint(const PlainFloatingPoint&) = delete;
  PlainFloatingPoint& operator=(const PlainFloatingPoint&) = delete;

 private:
  std::fenv_t callers_{};
};

/// A fault at a place of the scene of that name.
inline v0::Error error_of(const std::string& name, const ParseError& fault) {
  const SceneError error(name, fault.where, fault.found, fault.expected);
  return {error.what(), error.file, error.where, error.found, error.expected};
}

/// Calls work(), and turns what it throws into the library's errors.
template <class Work>
decltype(auto) guarded(const Work& work) {
  const PlainFloatingPoint environment;
  try {
    return work();
  } catch (const v0::Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const SceneError& error) {
    throw v0::Error(error.what(), error.file, error.where, error.found, error.expected);
  } catch (const std::exception& error) {
    throw v0::Error(all_printable(error.what()));
  }
}

}  // namespace tyndall::inner
