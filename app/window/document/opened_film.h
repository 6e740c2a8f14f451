#pragma once
#include "core/film/film.h"
#include "core/scene/load.h"

#include <memory>
#include <string>

/// The film of a snapshot that is opened again: its picture goes on from where it was.
namespace tyndall {

struct OpenedFilm {
  std::shared_ptr<Film> film;  ///< null: the picture starts over, or it is no snapshot
  std::string remark;          ///< what the user is told of it; "": nothing
};

/// Reads the film of a scene that was loaded from an image. It is only of use if it is whole and its samples are those
/// that this program would take with these kernels, so that nobody can tell that the picture was ever closed; else the
/// word says what it lacks. isa: of the kernels; "": the best. Never throws.
OpenedFilm read_opened_film(const LoadedScene& loaded, const std::string& isa);

}  // namespace tyndall
