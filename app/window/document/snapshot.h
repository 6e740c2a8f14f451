#pragma once
#include "app/window/document/document.h"
#include "core/render/renderer.h"

#include <filesystem>
#include <functional>
#include <string>

namespace tyndall {

struct Snapshot {
  Document document;
  std::filesystem::path base;  ///< the files' names without their endings
  std::string isa;             ///< of the kernel that renders
  int threads = 1;
};

/// Writes BASE.png and BASE.exr (in builds with OpenEXR) from a film, with the scene in them. Returns what to tell the
/// user. Throws ImageFileError.
std::string write_snapshot(const Snapshot& snapshot, Film film);

/// The film of the picture, as soon as it has a sample everywhere. film: gives the film as it is; current: false when
/// the picture was edited since; patient: false when it should not be waited for. An empty film: one of these, or 20
/// seconds have passed.
Film wait_for_film(const std::function<Film()>& film, const std::function<bool()>& current,
                   const std::function<bool()>& patient);

}  // namespace tyndall
