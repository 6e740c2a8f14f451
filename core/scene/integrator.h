#pragma once
#include "core/base/choice.h"

/// How paths find light. A header of its own: kernels know the integrator, but no other setting.
///
/// To add one: a value and its word here; what it does in core/kernel (event.h weighs light that is found and light
/// that is asked for); whether it asks for light at all, in core/compile/compile.cpp.
namespace tyndall {

enum class Integrator { path, nee, mis };

constexpr Word word(Integrator integrator) {
  switch (integrator) {
    case Integrator::path:
      return {"path", "no light sampling"};
    case Integrator::nee:
      return {"nee", "light sampling, without weights: in fog of g > 0.9998 too bright for a film now and then"};
    case Integrator::mis:
      return {"mis", "light sampling, weighted"};
  }
  return {};
}

}  // namespace tyndall
