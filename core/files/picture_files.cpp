#include "core/files/picture_files.h"

#include "core/base/error.h"
#include "core/base/text.h"

namespace tyndall {
namespace {

/// Layers of an EXR: those of the scene and, if there is one, the clean view with its error.
std::vector<Layer> all_layers(const Picture& picture) {
  std::vector<Layer> layers;
  if (picture.layers) layers = picture.layers();
  if (!picture.clean) return layers;
  Layer clean{"denoised", {"R", "G", "B", "error"}, {}};
  clean.values.reserve(4 * picture.clean->pixel_error.size());
  for (std::size_t i = 0; i < picture.clean->pixel_error.size(); ++i) {
    const float* rgb = picture.clean->rgb.data() + 3 * i;
    clean.values.insert(clean.values.end(), {rgb[0], rgb[1], rgb[2], picture.clean->pixel_error[i]});
  }
  layers.push_back(std::move(clean));
  return layers;
}

/// What files of one picture show.
LinearImage shown(const Picture& picture) {
  if (!picture.clean) return picture.image;
  return {picture.clean->width, picture.clean->height, picture.clean->rgb};
}

}  // namespace

bool is_exr(const std::filesystem::path& file) { return image_ending(file, {}) == ".exr"; }

std::string image_ending(const std::filesystem::path& file, const ImageForm& form) {
  return lower_case(file == "-" ? "." + form.format : file.extension().string());
}

void write_picture(const Picture& picture, const std::string& kind, const std::filesystem::path& file) {
  const Display& display = picture.display;
  const Region& region = picture.film.region;
  const auto dither = display.dither ? std::optional(DitherOrigin{region.x0, region.y0}) : std::nullopt;
  if (kind == ".exr") {
    Embedded embedded = picture.embedded(file);
    embedded.film = picture.form.exr_film;
    write_exr(file, picture.film, all_layers(picture), embedded, &picture.image);
  } else if (kind == ".png")
    write_png(file, shown(picture), display.exposure, display.tone_map, picture.embedded(file), dither);
  else if (kind == ".ppm")
    write_ppm(file, shown(picture), display.exposure, display.tone_map, picture.form.ppm, dither);
  else if (kind == ".pfm")
    write_pfm(file, shown(picture));
  else
    write_hdr(file, shown(picture));
}

void write_picture(const Picture& picture, const std::filesystem::path& file) {
  const std::string kind = image_ending(file, picture.form);
  if (!is_image_output(file) || (kind == ".exr" && !has_openexr()))
    throw UsageError(file.string() + ": found this name, expected one that ends in .png, .exr, .pfm, .hdr or .ppm" +
                     (has_openexr() ? "" : "; .exr not, as this build has no OpenEXR"));
  write_picture(picture, kind, file);
}

}  // namespace tyndall
