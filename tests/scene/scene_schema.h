#pragma once
#include <string>

/// The JSON Schema of scene files, made from the lists that reading and writing use: assets/scene.schema.json is this
/// text, for editors. Write it anew with
///
///   TYNDALL_WRITE_SCHEMA=1 build/release/tests/core_tests -tc='schema*'
namespace tyndall::test {

std::string scene_schema();

}  // namespace tyndall::test
