#pragma once
#include "app/window/panels/panels.h"

/// The rows of materials, textures and colours.
namespace tyndall {

/// Puts a prefix before the names of controls in the log, and makes them distinct, as long as it lives.
class Scope {
 public:
  Scope(Ui& ui, const std::string& name);
  ~Scope();
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;

 private:
  Ui& ui_;
  std::string before_;
};

/// The values of a material. brief: without the line that tells what its colour does.
void material_rows(Ui& ui, PanelState& state, int index, bool brief);
/// Which type and which material the object at a path has, and a material of its own. May change the path, where fog
/// goes that stood before the object.
void surface_rows(Ui& ui, PanelState& state, ObjectPath& path);
/// Texture, or colour, of a material or medium, with the fields of the texture. saved: in the scene's file; may be
/// null.
void colour_rows(Ui& ui, PanelState& state, ColourOrTexture& colour, const ColourOrTexture* saved, Row row);

}  // namespace tyndall
