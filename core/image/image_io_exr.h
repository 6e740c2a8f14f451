#pragma once
#include "core/film/film.h"
#include "core/image/image.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

/// How an EXR carries a film: each field of FilmPixel and of EmissionSums as channels of 32-bit words.
namespace tyndall {

/// One channel of a film in an EXR.
struct FilmChannel {
  std::string name;    ///< for example film.A.R.high0: half A or B, channel, limb, word (0: the limb's low half)
  std::size_t offset;  ///< of the word in FilmPixel or EmissionSums, bytes
};
std::vector<FilmChannel> film_channels();
/// The channels of EmissionSums, for example film.A.R.emission0, in files of films that have it.
std::vector<FilmChannel> emission_channels();

/// Refuses an EXR whose header asks for more memory than a whole file of its size could need: OpenEXR itself believes
/// what attributes, windows and tiles say, and takes the memory before it looks for the bytes. Throws ImageFileError.
void check_exr(const std::filesystem::path& file);

/// What users are told about EXR files if OpenEXR was not found when the build was configured.
inline constexpr const char* without_openexr =
    "this build has no EXR images (OpenEXR was not found when it was configured)";

/// What users are told about pixels with many depths.
inline constexpr const char* deep_data = "found deep data (many depths a pixel), expected a flat picture";

/// The version of the form in which films are written. 0 had neither label nor planned rounds. All up to this one are
/// read.
inline constexpr int film_format = 1;

// Names of the header's attributes.
namespace exr_name {
inline constexpr const char* scene = "tyndall:scene";
inline constexpr const char* stats = "tyndall:stats";
inline constexpr const char* contents = "tyndall:contents";          // FilmLabel::contents; absent: ""
inline constexpr const char* width = "tyndall:width";                // of the full image
inline constexpr const char* height = "tyndall:height";              // of the full image
inline constexpr const char* first_sample = "tyndall:first_sample";  // a double, to hold all of 32 bits
inline constexpr const char* quantum = "tyndall:unit";
inline constexpr const char* cut_throughput = "tyndall:cut_throughput";  // both limbs in decimal, high first
inline constexpr const char* film_format = "tyndall:film_format";        // an int; absent: 0
inline constexpr const char* unfinished = "tyndall:unfinished";          // an int, 0 or 1
inline constexpr const char* version = "tyndall:version";
inline constexpr const char* isa = "tyndall:isa";
inline constexpr const char* planned = "tyndall:planned";    // Film::planned as it is in memory; absent: empty
inline constexpr const char* checksum = "tyndall:checksum";  // see checksum_text(): 16 hex digits
}  // namespace exr_name

/// The attribute `checksum` for a film, the scene's text and the label.
std::string checksum_text(const Film& film, const Embedded& embedded);

}  // namespace tyndall
