#include "tests/support/paths.h"

namespace tyndall {

std::filesystem::path tests_folder() { return TYNDALL_TESTS_DIR; }
std::filesystem::path scratch_folder() { return TYNDALL_SCRATCH_DIR; }
std::filesystem::path references_folder() { return TYNDALL_REFERENCES_DIR; }

}  // namespace tyndall
