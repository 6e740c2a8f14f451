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
#include "core/system/locks.h"
#include "core/system/processors.h"

#include <cfenv>
#include <mutex>
#include <new>

/// The core's own types, under names that the library's header does not use: both have a Scene, a Film and a render().
/// That header comes after these names, so that a file of this room includes this one first.
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

#include <tyndall/tyndall.h>

/// What every call of the library does first and last.
namespace tyndall::inner {

/// The environment of floating point in which pictures are computed: rounding to nearest, numbers next to zero kept.
/// Threads that are started meanwhile inherit it. At its end the caller has its own one again.
class PlainFloatingPoint {
 public:
  PlainFloatingPoint() {
    std::fegetenv(&callers_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~PlainFloatingPoint() { std::fesetenv(&callers_); }
  PlainFloatingPoint(const PlainFloatingPoint&) = delete;
  PlainFloatingPoint& operator=(const PlainFloatingPoint&) = delete;

 private:
  std::fenv_t callers_{};
};

/// A fault at a place of the scene of that name.
inline v0::Error error_of(const std::string& name, const ParseError& fault) {
  const SceneError error(name, fault.where, fault.found, fault.expected);
  return {error.what(), error.file, error.where, error.found, error.expected};
}

/// Calls work(), and turns what it throws into the library's errors.
template <class Work>
decltype(auto) guarded(const Work& work) {
  const PlainFloatingPoint environment;
  try {
    return work();
  } catch (const v0::Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const SceneError& error) {
    throw v0::Error(error.what(), error.file, error.where, error.found, error.expected);
  } catch (const std::exception& error) {
    throw v0::Error(all_printable(error.what()));
  }
}

}  // namespace tyndall::inner

/// What the library's handles point to. Nothing in it changes but what is computed when it is first asked for.
namespace tyndall {
inline namespace v0 {

struct TYNDALL_HIDDEN Scene::Data {
  inner::CoreScene scene{};
  std::string name = "scene";          ///< what messages call it
  std::filesystem::path folder = ".";  ///< where its relative texture files are
  /// The scene from which this one was made, whose tree may be taken over; null: none.
  std::shared_ptr<const PreparedScene> before{};

  /// Prepared at the first call.
  const std::shared_ptr<const PreparedScene>& prepared() const;
  /// Null before that.
  std::shared_ptr<const PreparedScene> prepared_already() const;

 private:
  mutable Mutex mutex_{};
  mutable std::shared_ptr<const PreparedScene> prepared_{};
};

struct TYNDALL_HIDDEN Film::Data {
  std::shared_ptr<const inner::CoreFilm> film;
  Scene scene;
  FilmLabel label;
};

struct TYNDALL_HIDDEN Picture::Data {
  Scene scene;
  RenderResult result;
  FinishedPicture picture;

  const std::vector<float>& error_map() const;
  /// Layers of an EXR: albedo, normal, depth, variance.
  const std::vector<Layer>& layers() const;
  const CleanPicture& clean() const;

 private:
  mutable std::once_flag error_made_{}, layers_made_{};
  mutable std::vector<float> error_map_{};
  mutable std::vector<Layer> layers_{};
};

/// Opens the handles to the functions of this room.
struct Access {
  static const Scene::Data& of(const Scene& scene) { return *scene.data_; }
  static Scene scene(std::shared_ptr<const Scene::Data> data) {
    Scene made;
    made.data_ = std::move(data);
    return made;
  }
  static const std::shared_ptr<const Film::Data>& of(const Film& film) { return film.data_.pointer(); }
  static Film film(std::shared_ptr<const Film::Data> data) { return Film(std::move(data)); }
  static Picture picture(std::shared_ptr<const Picture::Data> data) { return Picture(std::move(data)); }
};

}  // namespace v0
}  // namespace tyndall
