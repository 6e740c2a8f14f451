#pragma once
#include "core/base/vec.h"

#include <string>
#include <vector>

namespace tyndall_book {
using vector = tyndall::Vec3d;
}
#include "app/book/tyndall/book/functions.h"

/// The part of the house that is linked to a reader's program, as a library: it watches his loop, opens his files,
/// reads his world and serves his samples.
namespace tyndall_book {

/// The program's ray through the point.
ray_parts ray_at(double x, double y);
/// The class of that name as C++ writes it.
std::string class_name(const char* mangled);

/// The last file that was read before a texture was made; "": none.
std::string file_of(const void* texture);
/// Names of files that were not found.
std::vector<std::string> missing_files();
/// Reads the size at the head of the picture that the program has begun to write; false: it has not yet.
bool read_head(picture_told& picture);

/// What the program that goes on alone shows of itself, if it ends within a fifth of a second, or else so far: a
/// sentence each.
std::vector<std::string> seen_alone();

/// Sends to the house, or ends with it.
void tell(char letter, const void* bytes, std::size_t size);
inline void tell(char letter, const std::string& text) { tell(letter, text.data(), text.size()); }
[[noreturn]] void give_up(const std::string& why);
/// The bytes of the next message.
std::string next_message();

}  // namespace tyndall_book
