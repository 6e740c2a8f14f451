#pragma once
#include "core/scene/check.h"

#include <cstddef>
#include <string_view>

/// What users are told about a text that is not JSON.
namespace tyndall {

/// Says what is wrong with a text that is not JSON as a person would, at "line L, column C".
/// end: bytes that the parser had read when it gave up, the offending one included; above the text's size at its end.
/// reason: the parser's own message.
ParseError syntax_error(std::string_view text, std::size_t end, std::string_view reason);

}  // namespace tyndall
