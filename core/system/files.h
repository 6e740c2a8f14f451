#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace tyndall {

/// The names in a folder, in no order; none if it cannot be read. (std::filesystem's iterator ends the program when
/// memory runs out.)
std::vector<std::string> names_in_folder(const std::filesystem::path& folder);
/// How many bytes a name in the folder may have.
std::size_t longest_name(const std::filesystem::path& folder);

/// Where temporary files go: $TMPDIR, or /tmp. It need not exist.
std::filesystem::path temporary_folder();
/// Makes a new folder among the temporary files, only for this user: BEGIN and six letters. Empty: none can be made.
/// error: why, if that is asked for.
std::filesystem::path make_temporary_folder(const std::string& begin, int* error = nullptr);

void remove_file(const std::filesystem::path& file);
/// Gives a file the place of another one, if there is one, at once. Returns 0, or the number of the error.
int replace_file(const std::filesystem::path& from, const std::filesystem::path& to);
/// std::fopen() for any name.
std::FILE* open_stream(const std::filesystem::path& file, const char* mode);
/// Why the system would take no file of this name, or one of another; "": it takes it.
std::string problem_of_name(const std::filesystem::path& file);

/// What changes with a file: which one it is, its size, and when its bytes, name or mode were changed last. Zeros where
/// there is no file.
using FileTrace = std::array<std::int64_t, 5>;
FileTrace trace_of(const std::filesystem::path& file);

/// The file that holds this code: the library where another program uses it, else the program.
std::filesystem::path own_file();
/// The user's own folder; empty: there is none.
std::filesystem::path home_folder();
/// Where programs keep what is one user's: such as ".config" in the home folder, %APPDATA% on Windows; empty: nowhere.
std::filesystem::path folder_of_user(const std::string& below_home);

/// Whether the link stands for a file that is open, not for a name: those of /proc/self/fd, which /dev/stdout leads to.
bool is_open_file(const std::filesystem::path& link);
/// What the file system lets nobody do with a file or folder (chattr +a and +i), as the end of "it may ..."; "":
/// nothing.
std::string protection_of(const std::filesystem::path& file);
/// Whether the file is another user's in a folder with the sticky bit, so that this user may not replace it.
bool is_kept_by_sticky_folder(const std::filesystem::path& file, const std::filesystem::path& folder);
/// 0, or the number of the error for which the file may not be written into.
int writing_error(const std::filesystem::path& file);

}  // namespace tyndall
