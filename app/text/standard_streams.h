#pragma once
#include <string>
#include <string_view>

/// Standard input, output and error of the process.
namespace tyndall {

/// Call first. Where the caller closed one of the descriptors 0 to 2, the next file that the program opens would get
/// its number, and messages would end up in that file. This opens /dev/null in its place; writing to it still fails.
void keep_standard_streams();

/// Writes data to standard output. Throws IoError unless all of it got there.
void write_standard_output(const std::string& text);

/// "tyndall: TEXT" on standard error, as one line: what would break it, as in the name of a file, is written as \n.
void complain(std::string_view text);

}  // namespace tyndall
