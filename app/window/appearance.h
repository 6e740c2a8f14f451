#pragma once
#include "app/window/panels/widgets.h"
#include "app/window/session.h"
#include "app/window/system/platform.h"
#include "app/window/system/preferences.h"

#include <cstdint>
#include <filesystem>
#include <vector>

/// How the window looks: theme, size of texts, and fonts for the names that the scene has.
namespace tyndall {

/// Puts into effect what the user chose, what the screen's density asks for, and what names need. For the main thread.
class Appearance {
 public:
  /// The arguments belong to the window and must outlive this.
  Appearance(Platform& platform, const Session& session, Ui& ui) : platform_(platform), session_(session), ui_(ui) {}

  /// To be called before Dear ImGui's frame begins. files: whose names are shown, too.
  void update(const Preferences& look, const std::vector<std::filesystem::path>& files);

 private:
  bool find_characters(const std::vector<std::filesystem::path>& files);

  Platform& platform_;
  const Session& session_;
  Ui& ui_;
  Theme theme_ = Theme::dark;
  Characters more_;                            ///< that the names have
  std::uint64_t changes_ = ~std::uint64_t{0};  ///< Editor::changes() when its names were looked at
  std::size_t files_ = 0;                      ///< how many were looked at
};

}  // namespace tyndall
