#include "app/comparison/baseline.h"

#include "app/files/outputs.h"
#include "app/text/values.h"
#include "core/base/error.h"
#include "core/base/seconds.h"
#include "core/base/text.h"
#include "core/image/image_io.h"
#include "core/image/image_io_file.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The endings of pictures' names, for messages.
constexpr const char* picture_endings = ".png .exr .pfm .hdr .ppm .pgm .jpg .jpeg .bmp .tga";

constexpr char tolerances_name[] = "tolerances.json";

/// The pictures in a folder, those in folders within it included. Links are followed, but for those that lead back to a
/// folder around them. without: folders that are not gone into. Throws IoError for a folder that cannot be read.
NamedPictures pictures_in(const fs::path& folder, const std::vector<fs::path>& without) {
  NamedPictures found;
  std::vector<std::string> others, loops;  // others: no pictures by their names; those that begin with "." go untold
  fs::path at = folder;
  std::error_code error, ignored;  // what cannot be looked at is no folder, and as a picture it fails
  fs::recursive_directory_iterator entry(folder, fs::directory_options::follow_directory_symlink, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    at = entry->path();
    const std::string name = at.lexically_relative(folder).generic_string();
    const auto is_this = [&](const fs::path& other) { return fs::equivalent(at, other, ignored); };
    if (!entry->is_directory(ignored)) {
      entry.disable_recursion_pending();
      if (has_picture_ending(at))
        found.files.emplace(name, at);
      else if (at.filename().string().front() != '.' && name != tolerances_name)
        others.push_back(name);
      continue;
    }
    bool loop = false;
    fs::path around = at;
    for (int depth = entry.depth(); depth >= 0; --depth) loop = loop || is_this(around = around.parent_path());
    if (loop) loops.push_back(name);
    if (loop || std::any_of(without.begin(), without.end(), is_this)) entry.disable_recursion_pending();
  }
  if (error) throw IoError(at.string() + ": cannot read the folder: " + error.message());
  const auto note = [&](const std::string& why, std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    if (!names.empty()) found.notes.push_back(folder.string() + ": left out, as " + why + ": " + listed(names, 3));
  };
  note(std::string("their names end in none of ") + picture_endings, others);
  note("links to folders around them", loops);
  return found;
}

[[noreturn]] void refuse(const fs::path& file, const std::string& found, const std::string& expected) {
  throw UsageError(file.string() + ": found " + found + ", expected " + expected);
}

Tolerance read_limits(const fs::path& file, const std::string& picture, const Json& json) {
  Tolerance limits;
  if (!json.is_object()) refuse(file, "no object for " + in_quotes(picture), "{\"max_flip\": 0.02}");
  for (const auto& [key, value] : json.items()) {
    const auto* known = std::ranges::find_if(tolerance_keys, [&k = key](const auto& e) { return k == e.first; });
    if (known == std::end(tolerance_keys)) refuse(file, in_quotes(key), "max_rmse, max_relmse, max_flip or max_z");
    if (!value.is_number() || !(value.get<double>() >= 0)) refuse(file, value.dump() + " for " + key, "a number >= 0");
    limits.*known->second = value.get<double>();
  }
  return limits;
}

/// What stands for a picture in tolerances.json: its name, which JSON can hold if it is UTF-8.
std::string key_of(const std::string& name) { return is_utf8(name) ? name : all_printable(name); }

std::map<std::string, Tolerance> read_tolerances(const fs::path& folder) {
  std::map<std::string, Tolerance> tolerances;
  const fs::path file = folder / tolerances_name;
  std::ifstream stream(file);
  if (!stream) return tolerances;
  const Json json = Json::parse(stream, nullptr, false);
  if (!json.is_object()) refuse(file, "no JSON object", "pictures' names with their tolerances");
  for (const auto& [picture, value] : json.items()) tolerances[picture] = read_limits(file, picture, value);
  return tolerances;
}

void write_tolerances(const fs::path& folder, const std::map<std::string, Tolerance>& tolerances) {
  Json json = Json::object();
  for (const auto& [picture, limits] : tolerances) {
    Json& entry = json[picture] = Json::object();
    for (const auto& [key, member] : tolerance_keys)
      if (limits.*member) entry[key] = *(limits.*member);
  }
  write_text_file(folder / tolerances_name, json.dump(2) + "\n");
}

NamedPictures pictures_of(const BaselineRequest& request) {
  NamedPictures pictures;
  const auto add = [&files = pictures.files](const std::string& name, const fs::path& file) {
    const auto [at, fresh] = files.emplace(name, file);
    if (!fresh) refuse(file, "another picture of the name of " + at->second.string(), "each name once");
  };
  bool whole = false;
  std::error_code error;  // what cannot be looked at fails when it is read
  for (const fs::path& image : request.images) {
    if (!fs::is_directory(image, error)) {
      // The file's own name and, where one was asked for, the layer.
      const auto [file, layer] = picture_name(image);
      add(file.filename().string() + (layer ? ":" + *layer : ""), image);
      continue;
    }
    whole = true;
    const NamedPictures found = pictures_in(image, {request.folder});
    for (const auto& [name, file] : found.files) add(name, file);
    pictures.notes.insert(pictures.notes.end(), found.notes.begin(), found.notes.end());
  }
  if (!whole || !fs::is_directory(request.folder, error)) return pictures;
  for (const auto& [name, file] : pictures_in(request.folder, request.images).files)
    pictures.files.emplace(name, fs::path());
  return pictures;
}

Tolerance chosen(const Tolerance& given, const std::map<std::string, Tolerance>& kept, const std::string& name) {
  if (!given.none()) return given;
  const auto at = kept.find(key_of(name));
  return at == kept.end() || at->second.none() ? usual_tolerance : at->second;
}

/// Throws for what is there and no file, such as a pipe, which would be waited for.
void check_ordinary(const fs::path& image) {
  std::error_code error;
  const fs::file_status status = fs::status(picture_name(image).file, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
    refuse(image, "something that is not an ordinary file", "a picture");
}

void check(CheckedPicture& picture, PpmCurve ppm) {
  std::error_code error;
  if (picture.image.empty())
    return picture.failures.push_back("the baseline has it, and it was not rendered; delete it there if that is meant");
  if (!fs::exists(picture_name(picture.reference).file, error))
    return picture.failures.push_back("the baseline lacks it; --update keeps it");
  const auto start = std::chrono::steady_clock::now();
  try {
    check_ordinary(picture.image);
    picture.comparison = compare_images(picture.image, picture.reference, ppm, picture.limits.z.has_value());
    picture.failures = too_large(*picture.comparison, picture.limits);
    const OutsideError& outside = picture.comparison->outside;
    if (picture.limits == usual_tolerance && !(outside.rel_mse <= usual_outside))
      picture.failures.push_back(
          fmt::format("relMSE among the {} values outside [0, 1], which FLIP clips, is {:.6g}, expected at most {:g}",
                      outside.values, outside.rel_mse, usual_outside));
  } catch (const std::exception& problem) {
    picture.failures.emplace_back(problem.what());
  }
  picture.seconds = seconds_since(start);
}

/// The files of the pictures, which are whole files for layers too, and what becomes of each in the baseline. Throws
/// IoError unless all of them can be written.
std::map<fs::path, fs::path> copies_of(const std::map<std::string, fs::path>& pictures, const fs::path& folder) {
  std::map<fs::path, fs::path> copies;
  for (const auto& [name, image] : pictures) {
    const auto [file, layer] = picture_name(image);
    const fs::path target = folder / (layer ? file.filename() : fs::path(name));
    std::error_code error;
    fs::create_directories(target.parent_path(), error);
    if (error) throw IoError(target.parent_path().string() + ": cannot make the folder: " + error.message());
    if (fs::equivalent(file, target, error)) continue;
    check_can_write(target);
    copies[target] = file;
  }
  return copies;
}

/// What goes wrong here is the disk's fault, and is told with how far it got.
void copy_all(const std::map<fs::path, fs::path>& copies) {
  std::size_t done = 0;
  try {
    for (const auto& [target, file] : copies) {
      const std::vector<std::uint8_t> bytes = read_bytes(file);
      write_text_file(target, {bytes.begin(), bytes.end()});
      ++done;
    }
  } catch (const std::runtime_error& problem) {
    throw IoError(std::string(problem.what()) + " (" + std::to_string(done) + " of " + std::to_string(copies.size()) +
                  " pictures were copied)");
  }
}

}  // namespace

bool has_picture_ending(const fs::path& file) {
  const std::string ending = lower_case(file.extension().string());
  const std::string endings = picture_endings + std::string(" ");
  return !ending.empty() && endings.find(ending + " ") != endings.npos;
}

BaselineCheck check_baseline(const BaselineRequest& request) {
  std::error_code error;
  if (!fs::is_directory(request.folder, error))
    refuse(request.folder, "no such folder", "a baseline; --update makes one");
  const auto tolerances = read_tolerances(request.folder);
  const NamedPictures found = pictures_of(request);
  BaselineCheck result{{}, found.notes};
  bool has_ppm = false;
  for (const auto& [name, image] : found.files) {
    result.pictures.push_back({name, image, request.folder / name, chosen(request.limits, tolerances, name)});
    CheckedPicture& picture = result.pictures.back();
    check(picture, request.ppm);
    has_ppm = has_ppm || (picture.comparison && picture.comparison->has_ppm);
  }
  check_gamma2(request.ppm, has_ppm);
  if (result.pictures.empty())  // nothing was checked, which is no success
    result.pictures.push_back(
        {.name = "no picture",
         .failures = {"nothing was compared: there is no picture in " + request.images.front().string() +
                      " (names that end in " + picture_endings + ")"}});
  return result;
}

NamedPictures update_baseline(const BaselineRequest& request) {
  NamedPictures found = pictures_of(request);
  for (const auto& [name, image] : found.files)
    if (image.empty()) found.notes.push_back(name + ": not rendered this time; the baseline keeps what it has");
  std::erase_if(found.files, [](const auto& picture) { return picture.second.empty(); });
  if (found.files.empty())
    refuse(request.images.front(), "no picture",
           "at least one, with a name that ends in " + std::string(picture_endings));
  auto tolerances = read_tolerances(request.folder);
  bool has_ppm = false;
  for (const auto& [name, image] : found.files) {
    check_ordinary(image);
    const PictureFile picture = read_picture(image, request.ppm);  // throws for what is no picture
    check_finite(image, picture.image);
    if (request.limits.z) read_noisy_image(image, {0, 0, picture.image.width, picture.image.height});
    has_ppm = has_ppm || picture.kind == ImageKind::ppm;
    tolerances[key_of(name)] = chosen(request.limits, tolerances, name);
  }
  check_gamma2(request.ppm, has_ppm);
  const auto copies = copies_of(found.files, request.folder);
  write_tolerances(request.folder, tolerances);
  copy_all(copies);
  return found;
}

}  // namespace tyndall
