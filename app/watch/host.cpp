#include "app/watch/host.h"

#include <clocale>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace tyndall {
namespace {

/// Whether denormal numbers are taken for 0, as programs compiled with -ffast-math ask for.
bool flushes_to_zero() {
#ifdef __SSE2__
  constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x40;
  return (_mm_getcsr() & (flush_to_zero | denormals_are_zero)) != 0;
#else
  return false;
#endif
}

}  // namespace

Host::Host(Function called, void* argument)
    : called_(called), argument_(argument), differs_(std::fegetround() != FE_TONEAREST || flushes_to_zero()) {
  const char* name = std::setlocale(LC_CTYPE, nullptr);
  character_type_ = name ? name : "C";
  std::fegetenv(&arithmetic_);
  std::fesetenv(FE_DFL_ENV);
}

Host::~Host() {
  std::fesetenv(&arithmetic_);
  std::setlocale(LC_CTYPE, character_type_.c_str());
}

void* Host::user() { return differs_ ? this : argument_; }

Host::Function Host::function() const {
  if (!differs_) return called_;
  return [](void* user, double x, double y, std::uint64_t sample, double rgb[3]) {
    struct Back {
      ~Back() { std::fesetenv(FE_DFL_ENV); }
    } back;
    const Host& host = *static_cast<const Host*>(user);
    std::fesetenv(&host.arithmetic_);
    host.called_(host.argument_, x, y, sample, rgb);
  };
}

}  // namespace tyndall
