#pragma once
#include "app/book/load_program.h"
#include "core/scene/scene.h"

#include <string>

namespace tyndall {

/// Compares a small picture of the scene that was taken from a program, made by the rules of its edition, with one of
/// samples that the program computes itself. Returns why they are not the same, in one sentence; "": they are, or it
/// cannot be judged (of noise and images, each program has its own). Takes half a second of the program's time.
std::string differs_from_own(const Scene& scene, const ProgramScene& program);

}  // namespace tyndall
