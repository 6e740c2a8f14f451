#pragma once

/// The part of a script for Blender that is the same for all scenes.
namespace tyndall {

extern const char* const blender_script_head;
/// What builds the scene that the string DATA holds as JSON.
extern const char* const blender_script;

}  // namespace tyndall
