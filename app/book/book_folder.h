#pragma once
#include <filesystem>

/// This room takes scenes from programs: those of readers of "Ray Tracing in One Weekend", whose main() describes a
/// scene by the books' classes. It compiles them with headers of its own (tyndall/book), runs them, and takes the scene
/// that they write. What a reader has to know is in README.md.
namespace tyndall {

/// The folder of those headers: book in $TYNDALL_ASSETS, share/tyndall/book of the installation, or book beside the
/// program. Throws IoError if there is none.
std::filesystem::path book_folder();

}  // namespace tyndall
