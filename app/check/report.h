#pragma once
#include "app/check/explain.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tyndall {

/// What is found about a picture, in lines for a table.
std::string verdict_text(const Findings& verdict);
/// The same for scripts.
nlohmann::ordered_json verdict_json(const Findings& verdict);

}  // namespace tyndall
