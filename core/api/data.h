#pragma once
#include "core/api/guarded.h"
#include "core/system/locks.h"

#include <mutex>

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
  void save(const std::filesystem::path& file) const;

 private:
  mutable std::once_flag error_made_{}, layers_made_{};
  mutable std::vector<float> error_map_{};
  mutable std::vector<Layer> layers_{};
};

/// Opens the handles to the functions of this room.
struct Access {
  static const Scene::Data& of(const Scene& scene) { return *scene.data_; }
  static Scene scene(std::shared_ptr<const Scene::Data> data);
  static const std::shared_ptr<const Film::Data>& of(const Film& film) { return film.data_.pointer(); }
  static Film film(std::shared_ptr<const Film::Data> data) { return Film(std::move(data)); }
  static Picture picture(std::shared_ptr<const Picture::Data> data) { return Picture(std::move(data)); }
  static const Picture::Data& of(const Picture& picture) { return *picture.data_; }
};

}  // namespace v0
}  // namespace tyndall
