#include "core/scene/source_assets.h"

namespace tyndall {

const char* source_assets() { return TYNDALL_ASSETS_DIR; }

}  // namespace tyndall
