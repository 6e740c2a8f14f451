#pragma once
#include <filesystem>

/// This room shows what programs of readers of "Ray Tracing in One Weekend" show. It compiles them with their own
/// headers and a few calls in their functions, runs them, and reads the world that they have built, by headers of its
/// own (tyndall/book); what is no scene is shown by samples that they compute. What a reader has to know is in
/// README.md.
namespace tyndall {

/// The folder of those headers: book in $TYNDALL_ASSETS, share/tyndall/book of the installation, or book beside the
/// program. Throws IoError if there is none.
std::filesystem::path book_folder();

}  // namespace tyndall
