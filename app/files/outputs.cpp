#include "app/files/outputs.h"

#include "app/book/compile_program.h"
#include "app/text/standard_streams.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/film/film.h"
#include "core/system/files.h"
#include "core/system/process.h"

#include <algorithm>
#include <span>

namespace tyndall {
namespace fs = std::filesystem;
namespace {

void check_standard_output(const std::vector<fs::path>& files, const ImageForm& form, const fs::path& stats) {
  const auto streams = std::count(files.begin(), files.end(), "-");
  if (streams > 0 && form.format.empty())
    throw UsageError("--output: found -, standard output, expected --format as well, which says what goes there");
  if (streams > 1) throw UsageError("--output: found - twice");
  if (streams == 0 && !form.format.empty())
    throw UsageError("--format: found " + form.format + ", expected -o - as well: of files the ending says the format");
  if (streams > 0 && stats == "-")
    throw UsageError("--stats - and -o - exclude each other: only one can go to standard output");
  if (streams > 0 && is_terminal(standard_output))
    throw UsageError("--output: found -, which is a terminal, expected a pipe or a file");
}

/// Whether both names mean one file, which need not exist yet.
bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  const auto full = [&error](const fs::path& file) { return fs::weakly_canonical(fs::absolute(file, error), error); };
  return full(a) == full(b);
}

/// A name beside the file that nothing has; empty: there is none.
fs::path free_name(const fs::path& file) {
  std::error_code error;
  for (int number = 1; number < 1000; ++number) {
    fs::path name = beside(file, number == 1 ? "new" : "new-" + std::to_string(number));
    if (fs::symlink_status(name, error).type() == fs::file_type::not_found) return name;
  }
  return {};
}

}  // namespace

fs::path kept_film(const std::vector<fs::path>& outputs, const ImageForm& form) {
  if (!form.exr_film) return {};
  const auto keeps = [](const fs::path& file) {
    std::error_code error;
    const auto type = fs::status(file, error).type();
    return is_exr(file) && !is_stream(file) && (type == fs::file_type::not_found || type == fs::file_type::regular);
  };
  const auto file = std::find_if(outputs.begin(), outputs.end(), keeps);
  return file == outputs.end() ? fs::path() : *file;
}

void check_image_names(const std::vector<fs::path>& files, const ImageForm& form, const fs::path& stats) {
  check_standard_output(files, form, stats);
  for (const fs::path& file : files) {
    const std::string name = "--output: found " + in_quotes(file.string());
    const std::string kind = image_ending(file, form);
    if (!is_image_output("image" + kind))
      throw UsageError(name + ", expected a name that ends in .png, .exr, .pfm, .hdr or .ppm");
    if (kind == ".exr" && !has_openexr())
      throw UsageError(name + ", expected .png, .pfm, .hdr or .ppm: this build has no OpenEXR");
  }
  const auto is_ppm = [&form](const auto& file) { return image_ending(file, form) == ".ppm"; };
  if (form.ppm == PpmCurve::gamma2 && std::none_of(files.begin(), files.end(), is_ppm))
    throw UsageError("--gamma2: found no output that ends in .ppm, expected one: only PPM is written so");
  check_outputs(outputs_of(files), {});
}

std::vector<Output> outputs_of(const std::vector<fs::path>& files, const fs::path& stats) {
  std::vector<Output> outputs;
  for (const fs::path& file : files) outputs.push_back({"--output", file});
  outputs.push_back({"--stats", stats});
  return outputs;
}

void check_outputs(const std::vector<Output>& outputs, const std::vector<fs::path>& inputs) {
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    const auto is_output = [&](const fs::path& file) { return is_same_file(file, output->file); };
    if (output->file.empty() || output->file == "-") continue;
    const std::string found = output->option + ": found " + in_quotes(output->file.string());
    const auto input = std::find_if(inputs.begin(), inputs.end(), is_output);
    if (input != inputs.end())
      throw UsageError(found + ", which is the input " + in_quotes(input->string()) + "; expected another file");
    const auto twin = std::find_if(outputs.begin(), output, [&](const Output& o) { return is_output(o.file); });
    if (twin != output) throw UsageError(found + " twice");
  }
}

FilePlace check_can_write(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw IoError(file.string() + ": cannot write: there is no folder " + folder.string());
  return WholeFile(file).place();  // removed again, as it is not committed
}

void check_can_write(const std::vector<Output>& outputs) {
  for (const Output& output : outputs)
    if (!output.file.empty() && output.file != "-") check_can_write(output.file);
}

FilmPlace film_place(const std::vector<fs::path>& outputs, const ImageForm& form) {
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

std::vector<std::string> write_images(const Picture& picture, const std::vector<fs::path>& files) {
  std::vector<std::string> problems;
  for (const fs::path& file : files) {
    try {
      const std::string kind = image_ending(file, picture.form);
      write_or_rescue(file, [&](const fs::path& to) { write_picture(picture, kind, to); });
    } catch (const std::bad_alloc&) {
      problems.push_back(file.string() + ": cannot write: not enough memory" + memory_limit_text());
    } catch (const std::exception& error) {
      problems.emplace_back(error.what());
    }
  }
  return problems;
}

void write_text_file(const fs::path& file, const std::string& text) {
  WholeFile out(file);
  out.write(std::as_bytes(std::span(text)));
  out.commit();
}

void write_or_rescue(const fs::path& file, const std::function<void(const fs::path& file)>& write) {
  try {
    return write(file);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    if (is_stream(file)) throw;
    const auto rescue_to = [&](const fs::path& place) {
      try {
        write(place);
      } catch (const std::exception&) {
        return;
      }
      throw ImageFileError(error.what() + ("; it is in " + place.string()) + " instead");
    };
    if (const fs::path name = free_name(file); !name.empty()) rescue_to(name);
    const fs::path folder = make_temporary_folder("tyndall-");  // empty if none can be made
    if (!folder.empty()) rescue_to(folder / file.filename());
    std::error_code ignored;
    fs::remove(folder, ignored);
    throw;
  }
}

void write_text_or_rescue(const fs::path& file, const std::string& text) {
  if (file == "-") return write_standard_output(text);
  write_or_rescue(file, [&text](const fs::path& to) { write_text_file(to, text); });
}

bool written_or_told(const std::function<void()>& write) {
  try {
    write();
    return true;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    complain(printable(error.what(), 2000));
    return false;
  }
}

int told_exit_code() {
  constexpr int wrong_usage = 2, input_output_error = 3;
  try {
    throw;
  } catch (const std::bad_alloc&) {
    complain("not enough memory" + memory_limit_text());
  } catch (const std::exception& error) {
    complain(error.what());
    if (const auto* interrupted = dynamic_cast<const ProgramInterrupted*>(&error)) return 128 + interrupted->signal;
    const bool is_users = dynamic_cast<const UsageError*>(&error) || dynamic_cast<const SceneError*>(&error) ||
                          dynamic_cast<const MergeError*>(&error) || dynamic_cast<const NoSuchLayer*>(&error);
    if (is_users) return wrong_usage;
  }
  return input_output_error;
}

}  // namespace tyndall
