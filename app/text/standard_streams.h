#pragma once
#include <string>
#include <string_view>

/// Standard input, output and error of the process.
namespace tyndall {

/// Writes data to standard output. Throws IoError unless all of it got there.
void write_standard_output(const std::string& text);

/// "tyndall: TEXT" on standard error, as one line: what would break it, as in the name of a file, is written as \n.
void complain(std::string_view text);

}  // namespace tyndall
