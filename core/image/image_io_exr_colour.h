#pragma once
#include <OpenEXR/ImfForward.h>

#include <OpenEXR/ImfChromaticities.h>

#include <filesystem>
#include <vector>

/// What an EXR's header says of its colours: for the files of this folder that include OpenEXR.
namespace tyndall {

/// The shares of red, green and blue in the luminance, by the attribute "chromaticities"; without it those of Rec.709.
/// Throws ImageFileError for chromaticities that span no colours.
Imath::V3f luminance_weights(const std::filesystem::path& file, const Imf::Header& header);

/// Converts linear RGB, 3 floats a pixel, by the attribute "chromaticities" to the Rec.709 RGB of the same CIE XYZ.
/// The white of the file is converted like any other colour, unless the attribute "adoptedNeutral" says which
/// chromaticity is to look neutral: that one becomes the white of Rec.709, by a linear Bradford transform. Values of
/// files in Rec.709 stay as they are, bit for bit. Throws ImageFileError for chromaticities that span no colours.
void convert_to_rec709(const std::filesystem::path& file, const Imf::Header& header, std::vector<float>& rgb);

}  // namespace tyndall
