#pragma once
#include "core/base/crew.h"
#include "core/film/film.h"
#include "core/kernel/kernels.h"

#include <atomic>
#include <functional>

namespace tyndall {

/// Takes the samples that some pixels of a film have and others lack, as an interrupted pass leaves it: afterwards all
/// have as many as the one with the most. Ends early, with every pixel's samples still a prefix, when `give_up` is set.
/// Adds to `counts`. poll: see Crew::for_each.
void level(Crew& crew, const Kernels& kernels, const SceneView& scene, Film& film, const std::atomic<bool>& give_up,
           UnitCounts& counts, const std::function<void()>& poll = {});

}  // namespace tyndall
