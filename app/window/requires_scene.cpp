#include "app/window/requires_scene.h"

#include "app/window/accuracy/views.h"
#include "app/window/menus/row_list.h"
#include "app/window/panels/panels.h"

namespace tyndall {

bool requires_scene(const Request& request) {
  if (is_addition(request.action)) return true;
  switch (request.action) {
    case Action::frame:
    case Action::reset_camera:
    case Action::pause:
    case Action::restart:
    case Action::save:
    case Action::save_as:
    case Action::clean:
    case Action::clean_beside_raw:
    case Action::split:
    case Action::grab:
    case Action::add:
    case Action::duplicate:
    case Action::remove:
    case Action::rename:
    case Action::own_material:
    case Action::replay:
    case Action::refine_first:
    case Action::store_camera:
    case Action::next_camera:
    case Action::render_reference:
      return true;
    case Action::view:
      return view_entry(request.number).view != View::beauty;
    case Action::section:
      return is_part_of_scene(column_tabs()[static_cast<std::size_t>(request.number)].name);
    case Action::row: {
      const RowEntry& row = row_entries()[static_cast<std::size_t>(request.number)];
      return is_part_of_scene(row.part) || row.label == "Clean";
    }
    default:
      return false;
  }
}

}  // namespace tyndall
