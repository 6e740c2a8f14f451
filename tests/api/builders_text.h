#pragma once
#include <string>

/// The library's structs of materials, textures and objects, made from the lists of fields that reading and writing
/// use: core/api/tyndall/builders.h is this text. Write it anew with
///
///   TYNDALL_WRITE_BUILDERS=1 build/release/tests/core_tests -tc='builders*'
namespace tyndall::test {

std::string builders_text();

}  // namespace tyndall::test
