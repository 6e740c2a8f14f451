#pragma once
#include "core/base/choice.h"

/// How paths find light. This is a header of its own because kernels know the integrator, but no other setting.
///
/// To add one: give it a value and a word here; write what it does in core/transport (event.h weighs light that
/// paths meet by chance and light that shadow rays ask for); say in core/compile/compile.cpp whether it sends shadow
/// rays at all.
namespace tyndall {

enum class Integrator { path, nee, mis };

constexpr Label label(Integrator integrator) {
  switch (integrator) {
    case Integrator::path:
      return {"path", "paths meet lamps by chance alone"};
    case Integrator::nee:
      return {"nee", "light sampling without weights, which may lose very bright samples in fog with g above 0.9998"};
    case Integrator::mis:
      return {"mis", "light sampling and chance, weighted"};
  }
  return {};
}

}  // namespace tyndall
