#pragma once
#include "app/window/document/document.h"
#include "core/render/renderer.h"

#include <filesystem>
#include <functional>
#include <string>

/// Snapshots: the picture on the screen as image files.
namespace tyndall {

struct Snapshot {
  Document document;
  std::filesystem::path base;  ///< the files' names without their endings
  std::string isa;             ///< of the kernel that renders
  int threads = 1;
  bool has_scene = true;  ///< the files hold the scene, and the EXR what it is made of; else the picture alone
};

/// Writes BASE.png and BASE.exr (in builds with OpenEXR) from a film. Returns what to tell the
/// user. Throws ImageFileError.
std::string write_snapshot(const Snapshot& snapshot, Film film);

/// Waits until every pixel of the film has a sample, and returns the film. film: returns it as it is at present. Gives
/// up, with an empty film, after 20 seconds, as soon as current() is false because the picture was edited meanwhile, or
/// as soon as patient() is false because the window is closing.
Film wait_for_film(const std::function<Film()>& film, const std::function<bool()>& current,
                   const std::function<bool()>& patient);

}  // namespace tyndall
