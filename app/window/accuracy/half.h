#pragma once

/// Names for the two pictures of a split view.
namespace tyndall {

/// The halves of a split view: on the right `current`, the scene as it is edited; on the left `kept`, the same scene
/// with the render settings that it had when the view was split. Without a split view all is `current`.
enum class Half { current, kept };

}  // namespace tyndall
