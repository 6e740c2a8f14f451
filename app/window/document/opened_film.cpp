#include "app/window/document/opened_film.h"

#include "app/files/film_files.h"
#include "app/text/numbers.h"
#include "core/image/image_io_file.h"
#include "core/targets/kernels.h"

#include <exception>
#include <filesystem>
#include <utility>

namespace tyndall {
namespace {

/// Why a film cannot go on; "": it can.
std::string obstacle(const StoredFilm& stored, const Scene& scene, const std::string& isa) {
  const Film& film = stored.part.film;
  const Region& region = film.region;
  const bool whole = region.x0 == 0 && region.y0 == 0 && region.x1 == scene.width && region.y1 == scene.height;
  if (!whole || film.first_sample != 0 || film.width != scene.width || film.height != scene.height)
    return "its film is a part of a picture";
  if (stored.label.version != TYNDALL_VERSION) return "its film is of version " + stored.label.version;
  if (stored.label.isa != isa) return "its film is of instruction set " + stored.label.isa + ", this is " + isa;
  return "";
}

}  // namespace

OpenedFilm read_opened_film(const LoadedScene& loaded, const std::string& isa) {
  if (!loaded.source.empty() || loaded.files.empty()) return {};
  const std::filesystem::path& file = loaded.files.front();
  try {
    const ImageKind kind = image_kind(read_bytes(file, kind_size));
    if (kind == ImageKind::unknown) return {};
    if (kind == ImageKind::png) return {nullptr, "it starts over, as a PNG holds no film; the EXR beside it does"};
    StoredFilm stored = read_stored_film(file);
    // Textures in both scenes are named from different folders; all else is the same if the samples are.
    const auto chosen = choose_kernels(isa);
    const std::string wrong = obstacle(stored, loaded.scene, chosen ? chosen->isa : isa);
    if (!wrong.empty()) return {nullptr, "it starts over, as " + wrong};
    Scene scene = move_textures(loaded.scene, loaded.folder, ".");
    if (!same_samples(std::move(scene), stored.scene)) return {nullptr, "it starts over with the changed settings"};
    auto film = std::make_shared<Film>(std::move(stored.part.film));
    const std::uint32_t spp = totals(*film).min_taken;
    if (spp == 0) return {nullptr, "it starts over, as its film is empty"};
    return {std::move(film), "it goes on from " + format_count(spp) + " spp"};
  } catch (const std::exception& error) {
    return {nullptr, std::string("it starts over: ") + error.what()};
  }
}

}  // namespace tyndall
