#pragma once
#include "core/image/picture_file.h"

/// stb's decoder, for the readers of BMP and TGA.
namespace tyndall {

/// The pixels of a BMP or TGA whose header has been checked: its size is believed, and all pixels are in the file.
/// 4 channels where the file has alpha, else 3.
Samples decode_stb(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

}  // namespace tyndall
