#pragma once
#include <cstddef>
#include <string>

/// The fonts of the system, and the characters of a text.
namespace tyndall {

/// A font file's path in the first folder that has it, of those of Debian, Arch, Fedora and the user; "" if none has.
std::string find_font(const std::string& file);

/// The code of the character at a byte of a UTF-8 text, and the place of the next one; 0xfffd for what is broken.
unsigned next_character(const std::string& text, std::size_t& at);

}  // namespace tyndall
