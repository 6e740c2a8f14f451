#pragma once
#include "core/clean/clean.h"
#include "core/film/film.h"
#include "core/image/image_io.h"
#include "core/render/prepare.h"
#include "core/render/render.h"
#include "core/scene/scene.h"
#include "core/targets/kernels.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// This room keeps pictures and films in files, with what is said beside them: scene, figures, layers.
///
/// Films in files: what --resume goes on from and merge adds. Whether films belong together is said here, for all:
/// see differing_samples(). Pictures become files of any kind by write_picture().
namespace tyndall {

/// A film, and the scene that it is of; texture files relative to the current folder.
struct StoredFilm {
  FilmPart part;
  Scene scene;
  FilmLabel label{};     ///< of films from before there were labels: what their figures say
  std::string remark{};  ///< see contents_remark()
};

/// Reads an EXR that render wrote. A film whose text does not say how caustics were found is of scattering: it is from
/// before chains. Throws UsageError if it holds no film or no scene.
StoredFilm read_stored_film(const std::filesystem::path& file);
/// The same without the film's pixels and emission.
StoredFilm read_stored_frame(const std::filesystem::path& file);
/// The film alone.
Film read_film_alone(const std::filesystem::path& file);

/// The label of a film that this program makes of the scene. isa: of the kernels.
FilmLabel label_for(const Scene& scene, const std::string& isa, bool unfinished = false);

/// What keeps a film from being gone on with or added: "found X, expected Y".
struct Mismatch {
  std::string found, expected;
};
/// How the samples of a film differ from those of another one or of a render; nothing: they are the same. Image size,
/// scene, settings, pixels of textures and sky, version and instruction set are compared; names, display, the number
/// of samples, and how caustics are found where no chains would be looked for, are not. A version or instruction set
/// that one label does not say fits any; where it does not say the pixels, those are taken that the scene has now.
std::optional<Mismatch> differing_samples(const Scene& film, const FilmLabel& label, const Scene& requested,
                                          const FilmLabel& requested_label);

/// The scene's text for an image of `film` at `image`: with the number of samples that the film has, and how caustics
/// were found even where that is the default. textures: the folder that the scene's texture files are relative to.
std::string embedded_scene(Scene scene, const std::filesystem::path& textures, const Film& film,
                           const std::filesystem::path& image);

/// What users are told of a picture whose pixels have different numbers of samples though the scene asks for the same
/// everywhere: a signal ended its render within a pass, whose samples are not thrown away. "": all have the same
/// number, or sampling is adaptive.
std::string uneven_text(const Scene& scene, const FilmTotals& totals);

/// The label of a film that is added from two others. Where their instruction sets differ it names all of them, such as
/// "several: avx2, scalar"; the same for versions.
FilmLabel merged_label(const FilmLabel& a, const FilmLabel& b);

/// The clean view of a film, and how long that took.
struct CleanOfFilm {
  CleanPicture picture;
  double seconds = 0;
};

/// Filters the film of the scene. Throws UsageError, which names `file`, if some pixels have fewer than 2 samples.
CleanOfFilm clean_view(const Film& film, const Scene& scene, const std::string& file, int threads = 0,
                       const std::string& isa = "");

/// How image files are written, where their names do not say it.
struct ImageForm {
  std::string
      format;  ///< of what goes to standard output, the file "-": png, exr, pfm, hdr or ppm; empty: nothing goes there
  bool exr_film = true;           ///< whether EXR files hold the film itself, which merge, denoise and --resume need
  PpmCurve ppm = PpmCurve::srgb;  ///< how PPM files are written
};

/// What says the format of an image file: the ending of its name, or of standard output the form's. In small letters,
/// with its dot, for example ".png".
std::string image_ending(const std::filesystem::path& file, const ImageForm& form);

/// True for names that end in .exr (any case).
bool is_exr(const std::filesystem::path& file);

/// What becomes image files.
struct Picture {
  const Film& film;
  const LinearImage& image;                                             ///< the film's means
  Display display;                                                      ///< for PNG and PPM
  std::function<Embedded(const std::filesystem::path& file)> embedded;  ///< for PNG and EXR
  std::function<std::vector<Layer>()> layers;  ///< for EXR, made only when needed; may be empty
  const CleanPicture* clean = nullptr;         ///< shown in place of the means, in EXR beside them; null: none
  ImageForm form{};
};

/// Writes the picture as a whole file, or throws ImageFileError and writes nothing. kind: see image_ending(); the
/// file's own where it is left out. Throws UsageError for an ending that is no image's.
void write_picture(const Picture& picture, const std::string& kind, const std::filesystem::path& file);
void write_picture(const Picture& picture, const std::filesystem::path& file);

/// What --stats says about a run, and what made it.
struct RunFigures {
  std::string scene;  ///< file or built-in name
  const PreparedScene& prepared;
  const RenderResult& result;
  const FinishedPicture& picture;    ///< of that result
  std::uint64_t samples_before = 0;  ///< in the film when the run began
  double seconds_build = 0;          ///< preparing the scene
  double seconds_total = 0;          ///< from the command's start to now
  std::string threads_from{};        ///< what decided the number of threads: see ThreadCount
};

/// All figures, as a JSON object. What is not known is null.
std::string stats_text(const RunFigures& run);

/// What PNG and EXR carry beside the scene: the figures that are the same for every run of the same build.
std::string embedded_stats_text(const RunFigures& run);

/// The same for a film that was read from a file and filtered: what is known of it.
std::string clean_stats_text(const Film& film, const CleanPicture& clean, double seconds);

/// The layers that an EXR gets beside a picture. Of what is seen first through the middle of each pixel: albedo, normal
/// (towards the outside of the shape), and depth along the camera's axis; 0, 0 and infinity where nothing is seen. From
/// the film's halves: the variance of each pixel's mean, by channel; infinite if a half has no sample.
std::vector<Layer> layers_of(const PreparedScene& scene, const Film& film, const Kernels& kernels);

}  // namespace tyndall
