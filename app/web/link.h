#pragma once
#include <string>

/// Scenes in the address of a page.
namespace tyndall {

/// What an address may have after its #, and what that may become, bytes.
inline constexpr std::size_t max_link = std::size_t(64) << 10, max_linked_scene = std::size_t(1) << 20;

/// A scene's text as it follows the # of an address: "z=" and the text deflated, in base64 for addresses (RFC 4648).
/// Throws IoError, one line, if the address or the text would be too long.
std::string link_of_scene(const std::string& text);

/// The scene's text, from what follows the #. Throws SceneError for what link_of_scene() has not written.
std::string scene_of_link(const std::string& link);

}  // namespace tyndall
