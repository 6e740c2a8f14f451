#include "app/manual/page.h"
#include "core/base/target.h"
#include "core/system/guard.h"

namespace tyndall {
namespace {

std::string compiler_text() {
#if defined(__clang__)
  const std::string name = "clang " __clang_version__;
#elif defined(__GNUC__)
  const std::string name = "GCC " __VERSION__;
#else
  const std::string name = "unknown compiler";
#endif
#if defined(_LIBCPP_VERSION)
  const std::string library = "libc++ " + std::to_string(_LIBCPP_VERSION / 1000);
#elif defined(__GLIBCXX__)
  const std::string library = "libstdc++ " + std::to_string(_GLIBCXX_RELEASE);
#else
  const std::string library = "unknown standard library";
#endif
  return name.substr(0, name.find_last_not_of(' ') + 1) + ", " + library + ", " TYNDALL_BUILD;
}

}  // namespace

std::string version_text() {
  const std::vector<Target> missing = missing_targets();
  return "tyndall " TYNDALL_VERSION "\ncompiler   " + compiler_text() + "\nkernels    " + names_of(built_targets()) +
         "; this CPU runs " + names_of(available_targets()) +
         (missing.empty() ? "" : ", and could run " + names_of(missing) + how_to_build(name_of(missing.back()))) +
         "\nguard      " + guard_text(available_guard()) + "\nlibraries  " TYNDALL_LIBRARIES "\n";
}

}  // namespace tyndall
