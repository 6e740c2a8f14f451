#pragma once
#include "core/compile/render_scene.h"
#include "core/scene/scene.h"
#include "core/targets/replay.h"

#include <string>

/// What happened along one path of light, told in words.
namespace tyndall {

/// What a path met at one place and what became of it there, in a few words: "ball (gold), goes on".
std::string vertex_text(const Scene& scene, const RenderScene& compiled, const PathVertex& vertex);

/// One path as text, a paragraph a vertex: what it met (by its name in the scene, else by its place in the file) and
/// what became of it there; which part of the light gathered there came by exact chains, and what a light counts that
/// chance found but chains find too. Positions are the scene's own. The last line is the sample's value, to the last
/// bit.
std::string replay_text(const Scene& scene, const RenderScene& compiled, const PathReplay& path);

}  // namespace tyndall
