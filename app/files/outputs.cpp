#include "app/files/outputs.h"

#include "app/text/values.h"
#include "core/base/limits.h"
#include "core/base/text.h"
#include "core/image/whole_file.h"

#include <unistd.h>

#include <algorithm>
#include <span>

namespace tyndall {
namespace {

std::string ending(const std::filesystem::path& file) { return lower_case(file.extension().string()); }

/// The file's name, or for standard output one that ends in its format.
std::filesystem::path name_with_ending(const std::filesystem::path& file, const ImageForm& form) {
  return file == "-" ? std::filesystem::path("standard-output." + form.format) : file;
}

void check_standard_output(const std::vector<std::filesystem::path>& files, const ImageForm& form,
                           const std::filesystem::path& stats) {
  const auto streams = std::count(files.begin(), files.end(), "-");
  if (streams > 0 && form.format.empty())
    throw UsageError("--output: found -, standard output, expected --format as well, which says what goes there");
  if (streams > 1) throw UsageError("--output: found - twice");
  if (streams == 0 && !form.format.empty())
    throw UsageError("--format: found " + form.format + ", expected -o - as well: of files the ending says the format");
  if (streams > 0 && stats == "-")
    throw UsageError("--stats - and -o - exclude each other: only one can go to standard output");
  if (streams > 0 && isatty(STDOUT_FILENO) != 0)
    throw UsageError("--output: found -, which is a terminal, expected a pipe or a file");
}

/// Whether both names mean one file, which need not exist yet.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return true;
  const auto full = [&error](const std::filesystem::path& file) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(file, error), error);
  };
  return full(a) == full(b);
}

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

Embedded embedded_in_exr(const Picture& picture, const std::filesystem::path& file) {
  Embedded embedded = picture.embedded(file);
  embedded.film = picture.form.exr_film;
  return embedded;
}

/// What files of one picture show.
LinearImage shown(const Picture& picture) {
  if (!picture.clean) return picture.image;
  return {picture.clean->width, picture.clean->height, picture.clean->rgb};
}

void write_image(const Picture& picture, const std::string& kind, const std::filesystem::path& file) {
  const Display& display = picture.display;
  const Region& region = picture.film.region;
  const auto dither = display.dither ? std::optional(DitherOrigin{region.x0, region.y0}) : std::nullopt;
  if (kind == ".exr")
    write_exr(file, picture.film, all_layers(picture), embedded_in_exr(picture, file), &picture.image);
  else if (kind == ".png")
    write_png(file, shown(picture), display.exposure, display.tone_map, picture.embedded(file), dither);
  else if (kind == ".ppm")
    write_ppm(file, shown(picture), display.exposure, display.tone_map, picture.form.ppm, dither);
  else if (kind == ".pfm")
    write_pfm(file, shown(picture));
  else
    write_hdr(file, shown(picture));
}

}  // namespace

bool is_exr(const std::filesystem::path& file) { return ending(file) == ".exr"; }

std::filesystem::path kept_film(const std::vector<std::filesystem::path>& outputs, const ImageForm& form) {
  if (!form.exr_film) return {};
  const auto keeps = [](const std::filesystem::path& file) {
    std::error_code error;
    const auto type = std::filesystem::status(file, error).type();
    return is_exr(file) && !is_stream(file) &&
           (type == std::filesystem::file_type::not_found || type == std::filesystem::file_type::regular);
  };
  const auto file = std::find_if(outputs.begin(), outputs.end(), keeps);
  return file == outputs.end() ? std::filesystem::path() : *file;
}

std::string image_ending(const std::filesystem::path& file, const ImageForm& form) {
  return ending(name_with_ending(file, form));
}

void check_image_names(const std::vector<std::filesystem::path>& files, const ImageForm& form,
                       const std::filesystem::path& stats) {
  check_standard_output(files, form, stats);
  for (const std::filesystem::path& file : files) {
    const std::string name = "--output: found " + in_quotes(file.string());
    const std::filesystem::path full = name_with_ending(file, form);
    if (!is_image_output(full))
      throw UsageError(name + ", expected a name that ends in .png, .exr, .pfm, .hdr or .ppm");
    if (is_exr(full) && !has_openexr())
      throw UsageError(name + ", expected .png, .pfm, .hdr or .ppm: this build has no OpenEXR");
  }
  const auto is_ppm = [&form](const auto& file) { return image_ending(file, form) == ".ppm"; };
  if (form.ppm == PpmCurve::gamma2 && std::none_of(files.begin(), files.end(), is_ppm))
    throw UsageError("--gamma2: found no output that ends in .ppm, expected one: only PPM is written so");
  check_outputs(outputs_of("--output", files), {});
}

std::vector<Output> outputs_of(const std::string& option, const std::vector<std::filesystem::path>& files) {
  std::vector<Output> outputs;
  for (const std::filesystem::path& file : files) outputs.push_back({option, file});
  return outputs;
}

void check_outputs(const std::vector<Output>& outputs, const std::vector<std::filesystem::path>& inputs) {
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    const auto is_output = [&](const std::filesystem::path& file) { return is_same_file(file, output->file); };
    if (output->file.empty() || output->file == "-") continue;
    const std::string found = output->option + ": found " + in_quotes(output->file.string());
    const auto input = std::find_if(inputs.begin(), inputs.end(), is_output);
    if (input != inputs.end())
      throw UsageError(found + ", which is the input " + in_quotes(input->string()) + "; expected another file");
    const auto twin = std::find_if(outputs.begin(), output, [&](const Output& o) { return is_output(o.file); });
    if (twin != output) throw UsageError(found + " twice");
  }
}

FilePlace check_can_write(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw IoError(file.string() + ": cannot write: there is no folder " + folder.string());
  return WholeFile(file).place();  // removed again, as it is not committed
}

void check_can_write(const std::vector<Output>& outputs) {
  for (const Output& output : outputs)
    if (!output.file.empty() && output.file != "-") check_can_write(output.file);
}

FilmPlace film_place(const std::vector<std::filesystem::path>& outputs, const ImageForm& form) {
  FilmPlace film;
  film.output = kept_film(outputs, form);
  if (film.output.empty()) return film;
  const FilePlace place = check_can_write(film.output);
  film.unfinished = film.output;
  if (place.method == WriteMethod::replace) return film;
  film.unfinished = beside(place.target, "unfinished");
  const auto is_that = [&film](const auto& file) { return is_same_file(file, film.unfinished); };
  try {
    const bool other = std::any_of(outputs.begin(), outputs.end(), is_that);
    if (other || check_can_write(film.unfinished).method != WriteMethod::replace) film.unfinished.clear();
  } catch (const std::exception&) {
    film.unfinished.clear();
  }
  return film;
}

std::vector<std::string> write_images(const Picture& picture, const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> problems;
  for (const std::filesystem::path& file : files) {
    try {
      const std::string kind = image_ending(file, picture.form);
      write_or_rescue(file, [&](const std::filesystem::path& to) { write_image(picture, kind, to); });
    } catch (const std::bad_alloc&) {
      problems.push_back(file.string() + ": cannot write: not enough memory" + memory_limit_text());
    } catch (const std::exception& error) {
      problems.emplace_back(error.what());
    }
  }
  return problems;
}

void write_text_file(const std::filesystem::path& file, const std::string& text) {
  WholeFile out(file);
  out.write(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  out.commit();
}

}  // namespace tyndall
