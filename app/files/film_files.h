#pragma once
#include "core/film/merge.h"
#include "core/image/image_io.h"
#include "core/scene/scene.h"

#include <filesystem>
#include <string>

/// Films in files: what --resume goes on from and merge adds.
namespace tyndall {

/// A film, and the scene that it is of; texture files relative to the current folder.
struct StoredFilm {
  FilmPart part;
  Scene scene;
};

/// Reads an EXR that render wrote. Throws UsageError if it holds no film or no scene.
StoredFilm read_stored_film(const std::filesystem::path& file);

/// Whether the samples of both scenes are the same: all but names, display and the number of samples is equal.
bool same_samples(Scene a, Scene b);

/// The scene's text for an image of `film` at `image`: with the number of samples that the film has. textures: the
/// folder that the scene's texture files are relative to.
std::string embedded_scene(Scene scene, const std::filesystem::path& textures, const Film& film,
                           const std::filesystem::path& image);

}  // namespace tyndall
