#pragma once
#include <string>

namespace tyndall {

/// Makes descriptors 0 to 2 exist, so that no file of ours takes the place of a standard stream that was closed;
/// writing to a stream that was closed still fails.
void keep_standard_streams();

/// Writes data to standard output. Throws IoError unless all of it got there.
void write_standard_output(const std::string& text);

/// "tyndall: TEXT" on standard error.
void complain(const std::string& text);

}  // namespace tyndall
