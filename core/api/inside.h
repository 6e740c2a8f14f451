#pragma once
#include "core/accuracy/error.h"
#include "core/accuracy/noise_test.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/files/film_files.h"
#include "core/film/film.h"
#include "core/image/whole_file.h"
#include "core/render/clean_film.h"
#include "core/render/plan.h"
#include "core/render/render.h"
#include "core/scene/check.h"
#include "core/scene/json_read.h"
#include "core/scene/json_tree.h"
#include "core/scene/load.h"
#include "core/system/processors.h"

/// The core's own types, under names that the library's header does not use: both have a Scene, a Film and a render().
/// A file of this room includes this header first, then <tyndall/tyndall.h>.
namespace tyndall::inner {

using CoreFilm = tyndall::Film;
using CoreRegion = tyndall::Region;
using CoreScene = tyndall::Scene;
using CoreOptions = tyndall::RenderOptions;

inline RenderResult render_film(const PreparedScene& scene, const CoreOptions& options,
                                const ProgressCallback& progress, CoreFilm film) {
  return tyndall::render(scene, options, progress, std::move(film));
}
inline CoreFilm merge_films(const std::vector<FilmPart>& frames,
                            const std::function<CoreFilm(std::size_t index)>& read) {
  return tyndall::merge(frames, read);
}

}  // namespace tyndall::inner
