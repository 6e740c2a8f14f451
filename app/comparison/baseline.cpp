#include "app/comparison/baseline.h"

#include "app/files/outputs.h"
#include "app/text/values.h"
#include "core/base/error.h"
#include "core/base/seconds.h"
#include "core/base/text.h"
#include "core/image/image_io.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr char tolerances_name[] = "tolerances.json";
constexpr std::pair<const char*, std::optional<double> Tolerance::*> keys[] = {
    {"max_rmse", &Tolerance::rmse}, {"max_relmse", &Tolerance::rel_mse}, {"max_flip", &Tolerance::flip}};

[[noreturn]] void refuse(const fs::path& file, const std::string& found, const std::string& expected) {
  throw UsageError(file.string() + ": found " + found + ", expected " + expected);
}

Tolerance read_limits(const fs::path& file, const std::string& picture, const Json& json) {
  Tolerance limits;
  if (!json.is_object()) refuse(file, "no object for " + in_quotes(picture), "{\"max_flip\": 0.02}");
  for (const auto& [key, value] : json.items()) {
    const auto* known =
        std::find_if(std::begin(keys), std::end(keys), [&k = key](const auto& e) { return k == e.first; });
    if (known == std::end(keys)) refuse(file, in_quotes(key), "max_rmse, max_relmse or max_flip");
    if (!value.is_number() || !(value.get<double>() >= 0)) refuse(file, value.dump() + " for " + key, "a number >= 0");
    limits.*known->second = value.get<double>();
  }
  return limits;
}

std::map<std::string, Tolerance> read_tolerances(const fs::path& folder) {
  std::map<std::string, Tolerance> tolerances;
  const fs::path file = folder / tolerances_name;
  std::ifstream stream(file);
  if (!stream) return tolerances;
  const Json json = Json::parse(stream, nullptr, false);
  if (!json.is_object()) refuse(file, "no JSON object", "pictures' names with their tolerances");
  for (const auto& [name, value] : json.items()) tolerances[name] = read_limits(file, name, value);
  return tolerances;
}

void write_tolerances(const fs::path& folder, const std::map<std::string, Tolerance>& tolerances) {
  Json json = Json::object();
  for (const auto& [name, limits] : tolerances) {
    Json& entry = json[name] = Json::object();
    for (const auto& [key, member] : keys)
      if (limits.*member) entry[key] = *(limits.*member);
  }
  write_text_file(folder / tolerances_name, json.dump(2) + "\n");
}

std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && is_image_output(entry.path())) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// What a picture is called in the baseline: the file's own name and, where one was asked for, the layer.
std::string name_of(const fs::path& image) {
  const auto [file, layer] = picture_name(image);
  return file.filename().string() + (layer ? ":" + *layer : "");
}

/// Pictures by name; those in the baseline that should be there and are not have an empty path.
std::map<std::string, fs::path> pictures_of(const BaselineRequest& request) {
  std::map<std::string, fs::path> found;
  const auto add = [&found](const fs::path& file) {
    const auto [at, fresh] = found.emplace(name_of(file), file);
    if (!fresh) refuse(file, "another picture of the name of " + at->second.string(), "each name once");
  };
  bool whole = false;
  for (const fs::path& image : request.images) {
    const bool folder = fs::is_directory(image);
    whole = whole || folder;
    if (!folder) add(image);
    if (folder)
      for (const fs::path& file : pictures_in(image)) add(file);
  }
  if (whole && fs::is_directory(request.folder))
    for (const fs::path& file : pictures_in(request.folder)) found.emplace(file.filename().string(), fs::path());
  return found;
}

Tolerance chosen(const Tolerance& given, const std::map<std::string, Tolerance>& kept, const std::string& name) {
  if (!given.none()) return given;
  const auto at = kept.find(name);
  if (at != kept.end() && !at->second.none()) return at->second;
  Tolerance usual;
  usual.flip = usual_flip;
  return usual;
}

void check(CheckedPicture& picture, PpmCurve ppm) {
  if (picture.image.empty()) {
    picture.failures.push_back("the baseline has it, and it was not rendered; delete it there if that is meant");
    return;
  }
  if (!fs::exists(picture_name(picture.reference).file)) {
    picture.failures.push_back("the baseline lacks it; --update keeps it");
    return;
  }
  const auto start = std::chrono::steady_clock::now();
  try {
    picture.comparison = compare_images(picture.image, picture.reference, ppm);
    picture.failures = too_large(*picture.comparison, picture.limits);
  } catch (const std::exception& error) {
    picture.failures.push_back(error.what());
  }
  picture.seconds = seconds_since(start);
}

}  // namespace

std::vector<CheckedPicture> check_baseline(const BaselineRequest& request) {
  if (!fs::is_directory(request.folder)) refuse(request.folder, "no such folder", "a baseline; --update makes one");
  const auto tolerances = read_tolerances(request.folder);
  std::vector<CheckedPicture> pictures;
  bool has_ppm = false;
  for (const auto& [name, image] : pictures_of(request)) {
    CheckedPicture& picture = pictures.emplace_back();
    picture.name = name, picture.image = image, picture.reference = request.folder / name;
    picture.limits = chosen(request.limits, tolerances, name);
    check(picture, request.ppm);
    has_ppm = has_ppm || (picture.comparison && picture.comparison->has_ppm);
  }
  check_gamma2(request.ppm, has_ppm);
  return pictures;
}

std::vector<std::string> update_baseline(const BaselineRequest& request) {
  std::error_code error;
  fs::create_directories(request.folder, error);
  if (error) throw IoError(request.folder.string() + ": cannot make the folder: " + error.message());
  auto tolerances = read_tolerances(request.folder);
  const auto pictures = pictures_of(request);
  bool has_ppm = false;
  for (const auto& [name, image] : pictures)
    if (!image.empty() && read_picture(image, request.ppm).kind == ImageKind::ppm) has_ppm = true;
  check_gamma2(request.ppm, has_ppm);
  std::vector<std::string> names;
  for (const auto& [name, image] : pictures) {
    if (image.empty()) continue;  // not rendered this time: it stays
    const fs::path file = picture_name(image).file, target = request.folder / file.filename();
    if (!fs::equivalent(file, target, error)) write_copy(file, target);
    tolerances[name] = chosen(request.limits, tolerances, name);
    names.push_back(name);
  }
  write_tolerances(request.folder, tolerances);
  return names;
}

}  // namespace tyndall
