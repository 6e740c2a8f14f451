#pragma once

/// Where the scenes, textures and known answers lie that came with the sources.
namespace tyndall {

/// The folder assets of the source tree that this program was built from, which may be gone by now.
const char* source_assets();

}  // namespace tyndall
