#pragma once
#include "app/window/actions/actions.h"
#include "app/window/document/document.h"
#include "app/window/menus/menu.h"

#include <string>
#include <vector>

/// All that the palette offers, and which requests are about a scene.
namespace tyndall {

/// Actions, rows of the column, views, parts of the column and scenes. Rows that the column does not show while this
/// object is selected (an empty path: nothing is) come after those that it does, and say what to do first. scenes: what
/// can be opened, for load_scene.
std::vector<PaletteItem> palette_items(const Scene& scene, const ObjectPath& selected,
                                       const std::vector<std::string>& scenes);

/// Whether a request is about a scene, or about how one is rendered: a picture without one has nothing to answer.
bool requires_scene(const Request& request);

/// Whether a request is about rendering, of whatever samples: a picture that another program writes has nothing to
/// answer.
bool requires_rendering(const Request& request);

}  // namespace tyndall
