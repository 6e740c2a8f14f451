#pragma once
#include "core/scene/scene.h"

#include <filesystem>
#include <string>
#include <string_view>

/// Scene files and snapshots: what is written where. No window.
namespace tyndall {

/// Whether a scene file's text has comments, // or /* */, outside of strings.
bool has_comments(std::string_view text);

/// Writes a scene file in normal form, whole or not at all. Throws IoError: one line.
void save_scene(const Scene& scene, const std::filesystem::path& file);

/// "showroom" of "showroom.json" or "showroom-003.png": what snapshots and copies are named after.
std::string stem_of(const std::string& title);

/// FOLDER/STEM-001, or with the first number from `least` on for which neither the PNG nor the EXR exists. Without its
/// ending.
std::filesystem::path snapshot_base(const std::filesystem::path& folder, const std::string& stem, int least);

/// The number in what snapshot_base gave.
int snapshot_number(const std::filesystem::path& base);

}  // namespace tyndall
