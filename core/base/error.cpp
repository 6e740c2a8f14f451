#include "core/base/error.h"

#include "core/base/text.h"

namespace tyndall {

SceneError::SceneError(const std::string& file, const std::string& where, const std::string& found,
                       const std::string& expected)
    : runtime_error(printable(file) + ": " + printable(where) + ": found " + printable(found) + ", expected " +
                    printable(expected, 600)) {}

SceneError::SceneError(const std::string& file, const std::string& found, const std::string& expected)
    : runtime_error(printable(file) + ": found " + printable(found) + ", expected " + printable(expected, 600)) {}

}  // namespace tyndall
