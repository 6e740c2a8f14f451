#include "core/base/environment.h"

#include "core/base/error.h"
#include "core/base/text.h"

#include <cstdlib>
#include <string>

namespace tyndall {

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

bool is_on(const char* variable) {
  const std::string given = is_set(variable) ? std::getenv(variable) : "", value = lower_case(given);
  if (value == "1" || value == "yes" || value == "true" || value == "on") return true;
  if (value.empty() || value == "0" || value == "no" || value == "false" || value == "off") return false;
  throw UsageError(std::string(variable) + ": found " + in_quotes(given) +
                   ", expected 1, yes, true or on, or 0, no, false, off or nothing");
}

}  // namespace tyndall
