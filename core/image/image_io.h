#pragma once
#include "core/film/film.h"
#include "core/image/image.h"
#include "core/image/tonemap.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// Image files. Every writer writes a whole file or none: it writes beside the target and renames, and removes what it
/// began when something fails. All throw ImageFileError.
namespace tyndall {

void write_png(const std::filesystem::path& file, const LinearImage& image, double exposure, ToneMap curve,
               const Embedded& embedded, std::optional<DitherOrigin> dither = {});
/// The bytes of that PNG. name: what errors call it.
std::vector<std::uint8_t> png_bytes(const std::filesystem::path& name, const LinearImage& image, double exposure,
                                    ToneMap curve, const Embedded& embedded, std::optional<DitherOrigin> dither = {});
/// PPM (P6, 8 bits): the bytes of the PNG; with PpmCurve::gamma2 those of gamma2_bytes(), which are not dithered. It
/// carries no scene and no statistics.
void write_ppm(const std::filesystem::path& file, const LinearImage& image, double exposure, ToneMap curve,
               PpmCurve ppm = PpmCurve::srgb, std::optional<DitherOrigin> dither = {});
/// PFM: bottom row first, scale -1.0 (little endian). It carries no scene and no statistics.
void write_pfm(const std::filesystem::path& file, const LinearImage& image);
/// Radiance HDR (RGBE). It carries no scene and no statistics.
void write_hdr(const std::filesystem::path& file, const LinearImage& image);
/// EXR: RGB in float, the layers, and, unless `embedded` says no, the film itself in channels film.*; the data window
/// is the film's region. Throws if built without OpenEXR. image: the film's means, if the caller has them; null: they
/// are computed here.
void write_exr(const std::filesystem::path& file, const Film& film, const std::vector<Layer>& layers,
               const Embedded& embedded, const LinearImage* image = nullptr);
/// A checkpoint: the film alone, uncompressed, which is much faster. It can be gone on with, but shows no picture.
void write_checkpoint(const std::filesystem::path& file, const Film& film, const Embedded& embedded);
bool has_openexr();

/// What a user calls a picture: FILE, or FILE.exr:LAYER for a layer of an EXR.
struct PictureName {
  std::filesystem::path file;
  std::optional<std::string> layer{};
};
/// Takes such a name apart. A file that has the whole name is meant itself, even if there is a ':' in it; else the
/// longest beginning up to a ':' that is the name of a file. Where no file is found, the whole name is the file's.
PictureName picture_name(const std::filesystem::path& name);

/// Reads a picture of any kind; the content tells which, not the name. What the file says of its pixels is honoured,
/// refused or told in a remark; core/image/README.md lists each format's fields. ppm: how the numbers of a PPM are
/// read. name: see PictureName. Throws NoSuchLayer for a layer that is not there.
PictureFile read_picture(const std::filesystem::path& name, PpmCurve ppm = PpmCurve::srgb);
/// The same for a texture: floating-point pixels, which may be brighter than white, are refused.
PictureFile read_texture(const std::filesystem::path& file);
/// The same for a picture of the sky: floating-point pixels of the whole display window; all else is refused.
PictureFile read_sky(const std::filesystem::path& name);
/// The light of read_picture() alone.
LinearImage read_image(const std::filesystem::path& name);
/// The film in an EXR that Tyndall wrote; nothing if it holds none.
std::optional<Film> read_film(const std::filesystem::path& file);
/// The same without pixels and emission: its size, region, first sample and unit.
std::optional<Film> read_film_frame(const std::filesystem::path& file);
/// How the film in an EXR was made; nothing if it holds none.
std::optional<FilmLabel> read_film_label(const std::filesystem::path& file);
/// The figures (JSON) in a PNG or EXR that Tyndall wrote; nothing if it holds none or is no such file.
std::optional<std::string> read_embedded_stats(const std::filesystem::path& file);
/// The scene text in a PNG or EXR that Tyndall wrote; nothing if it holds none or is no such file.
std::optional<std::string> read_embedded_scene(const std::filesystem::path& file);
/// FilmLabel::contents of a PNG or EXR that Tyndall wrote; nothing if it holds none or is no such file.
std::optional<std::string> read_embedded_contents(const std::filesystem::path& file);

/// True for an ending that write_* knows: .png .exr .pfm .hdr .ppm (any case).
bool is_image_output(const std::filesystem::path& file);

}  // namespace tyndall
