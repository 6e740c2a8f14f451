#include "core/image/file_place.h"

#include "core/image/image_io_file.h"
#include "core/system/files.h"
#include "core/system/open_file.h"
#include "core/system/process.h"

#include <cerrno>
#include <system_error>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

/// Follows symbolic links to a name that is none, or to one that stands for an open file.
fs::path end_of_links(const fs::path& file) {
  fs::path target = file;
  std::error_code error;
  for (int links = 0; fs::is_symlink(target, error) && !is_open_file(target); ++links) {
    if (links == 40) cannot_write(file, error_text(ELOOP));
    target = target.parent_path() / fs::read_symlink(target, error);
    if (error) cannot_write(file, error.message());
  }
  return target;
}

/// What keeps the ordinary file at place.target from being replaced; "": nothing that is known beforehand.
std::string obstacle_of(const FilePlace& place) {
  if (is_mount_point(place.target)) return "it is a mount point";
  if (const std::string only = protection_of(place.target); !only.empty()) return "it may " + only;
  if (!place.folder_problem.empty()) return place.folder_problem;
  return is_kept_by_sticky_folder(place.target, place.folder)
             ? "it is another user's file in a folder with the sticky bit"
             : "";
}

}  // namespace

FilePlace find_place(const fs::path& file) {
  FilePlace place;
  place.method = file == "-" ? WriteMethod::stream : WriteMethod::replace;
  place.target = file;
  if (file == "-") return place;
  if (const std::string problem = problem_of_name(file); !problem.empty()) cannot_write(file, problem);
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  const bool there = !error;
  if (!there && error != std::errc::no_such_file_or_directory) cannot_write(file, error.message());
  place.target = end_of_links(file);
  place.folder = folder_of(place.target);
  if (!place.target.has_filename()) cannot_write(file, error_text(EISDIR));
  if (const std::string only = protection_of(place.folder); !only.empty())
    place.folder_problem = "its folder may " + only;
  if (!there && !place.folder_problem.empty()) cannot_write(file, place.folder_problem);
  if (!there) return place;
  place.exists = true;
  place.mode = static_cast<unsigned>(status.permissions()), place.owner = owner_of(file);
  if (fs::is_directory(status)) cannot_write(file, error_text(EISDIR));
  const bool once = fs::is_fifo(status) || fs::is_character_file(status) || fs::is_symlink(place.target, error);
  if (!once && !fs::is_regular_file(status)) cannot_write(file, "not an ordinary file");
  if (const int problem = once ? writing_error(file) : 0) cannot_write(file, error_text(problem));
  if (once) place.method = WriteMethod::stream;
  if (!once) place.obstacle = obstacle_of(place);
  if (!place.obstacle.empty()) place.method = WriteMethod::in_place;
  return place;
}

bool is_stream(const fs::path& file) {
  if (file == "-") return true;
  std::error_code error;
  const fs::file_type type = fs::status(file, error).type();
  if (type == fs::file_type::fifo || type == fs::file_type::character) return true;
  try {
    return type == fs::file_type::regular && find_place(file).method == WriteMethod::stream;
  } catch (const ImageFileError&) {
    return false;  // writing it says why
  }
}

fs::path beside(const fs::path& file, const std::string& mark) {
  return file.parent_path() / (file.stem().string() + "." + mark + file.extension().string());
}

}  // namespace tyndall
