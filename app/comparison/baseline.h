#pragma once
#include "app/comparison/comparison.h"

#include <map>

/// A folder of pictures that renders should go on looking like, for other people's tests: each with its tolerances.
///
/// The folder holds the pictures by name and the file tolerances.json:
///   { "box.png": { "max_flip": 0.02 }, "fog.exr": { "max_relmse": 0.001, "max_flip": 0.05 } }
namespace tyndall {

/// The tolerance of a picture for which none was ever given. FLIP clips its pictures to [0, 1], so with it also relMSE
/// among the values outside has a limit; 8-bit pictures have no such values.
inline constexpr Tolerance usual_tolerance{{}, {}, 0.02};
inline constexpr double usual_outside = 0.01;

/// Whether a file is a picture by its name.
bool has_picture_ending(const std::filesystem::path& file);

/// One picture and what became of it.
struct CheckedPicture {
  std::string name;                            ///< from the folder on: "box.png", "fog/thin.exr"
  std::filesystem::path image{}, reference{};  ///< reference: in the baseline; image: empty if it was not rendered
  Tolerance limits{};
  std::optional<Comparison> comparison{};  ///< absent if there was nothing to compare
  std::vector<std::string> failures{};     ///< none: it passed
  double seconds = 0;                      ///< that the comparison took
};

struct BaselineRequest {
  std::filesystem::path folder;
  /// Pictures (see PictureName), or folders of them, at least one. Of a layer of an EXR the whole file is kept, and
  /// tolerances under the layer's name. Of a folder all pictures are taken, those in folders within it included, and
  /// those of the baseline that it lacks fail.
  std::vector<std::filesystem::path> images;
  Tolerance limits;               ///< in place of those that are kept
  PpmCurve ppm = PpmCurve::srgb;  ///< how PPM files are read
};

/// Pictures by name, with what is to be said of the folders that they are in, a line each.
struct NamedPictures {
  /// Names from the folder on, with "/" between them: "box.png", "fog/thin.exr". Those in the baseline that should be
  /// there and are not have an empty path.
  std::map<std::string, std::filesystem::path> files;
  std::vector<std::string> notes;
};

struct BaselineCheck {
  std::vector<CheckedPicture> pictures;  ///< never empty: where there is nothing to compare, that is a failure
  std::vector<std::string> notes;        ///< what was left out of folders and why, a line each
};

/// Compares each picture with the one of its name. What goes wrong with one is its failure, and the others go on.
/// Throws UsageError where the folder or its tolerances cannot be read, or two pictures have one name, or for --gamma2
/// without a PPM.
BaselineCheck check_baseline(const BaselineRequest& request);

/// Copies the pictures into the folder and keeps the limits as their tolerances; where none are given, those that are
/// kept stay. Looks at all pictures first: where one cannot be read, or has values that are not finite, or no noise
/// though a limit asks for it, or there is none, nothing is changed. Returns the pictures that are kept now, and what
/// the baseline keeps from before among the notes. Throws UsageError, IoError, ImageFileError.
NamedPictures update_baseline(const BaselineRequest& request);

/// Where the numbers of a report lie, for programs: in a file of the same name that ends in .json. Throws UsageError if
/// another file has that name, such as a scene.
std::filesystem::path numbers_beside(std::filesystem::path report);

/// One page with everything in it: numbers, both pictures behind a slider, the map of FLIP; and beside it its numbers.
/// ppm: how PPM files are read. Throws as numbers_beside() does, and ImageFileError.
void write_html_report(const std::filesystem::path& file, const std::vector<CheckedPicture>& pictures, PpmCurve ppm);

/// A report in the form that JUnit gave to continuous integration.
std::string junit_report(const std::vector<CheckedPicture>& pictures);

}  // namespace tyndall
