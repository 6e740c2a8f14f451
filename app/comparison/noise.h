#pragma once
#include "core/accuracy/noise_test.h"

#include <filesystem>

/// The noise that files of pictures carry.
namespace tyndall {

/// Reads a picture with its noise: an EXR with the film of Tyndall, else with a layer "Variance"; or a PFM, FILE.pfm,
/// with its standard errors beside it in FILE.error.pfm. place: where its pixels lie, of its size. Throws UsageError,
/// which says what to pass, for all others, and for a film with fewer than 2 samples in a pixel; ImageFileError.
NoisyImage read_noisy_image(const std::filesystem::path& name, const Region& place);

}  // namespace tyndall
