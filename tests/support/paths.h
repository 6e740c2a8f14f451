#pragma once
#include <filesystem>

/// Folders that tests read from and write to. Functions, so that tests themselves are compiled without any path of this
/// machine and compiler caches can share them between checkouts.
namespace tyndall {

std::filesystem::path assets_folder();   ///< assets/ of the source tree, the same as in core/scene/load.h
std::filesystem::path tests_folder();    ///< tests/ of the source tree
std::filesystem::path scratch_folder();  ///< where tests may write
/// Where slow tests keep what takes long to make: build/references of the source tree.
std::filesystem::path references_folder();

}  // namespace tyndall
