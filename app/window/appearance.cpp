#include "app/window/main_window.h"

#include <algorithm>
#include <cmath>
#include <utility>

/// How the window looks: theme, size of texts, fonts for the names that the scene has, and where its parts are.
namespace tyndall {

/// Looks for characters that the fonts were not loaded for. Returns whether there are any.
bool MainWindow::find_characters() {
  const std::vector<std::filesystem::path>& files = gallery_.recent();
  const std::size_t before = more_characters_.size();
  add_characters(ui_.edit.text, more_characters_);
  add_characters(session_.messages.current().text, more_characters_);
  if (std::exchange(named_files_, files.size()) != files.size())
    for (const auto& file : files) add_characters(file.string(), more_characters_);
  if (const auto changes = session_.editor.changes(); std::exchange(named_changes_, changes) != changes) {
    const auto& [scene, origin] = session_.editor.document();
    add_characters(origin->title, more_characters_);
    for (const Material& material : scene.materials) add_characters(material.name, more_characters_);
    for (const Texture& texture : scene.textures) add_characters(texture.name, more_characters_);
    each_object(scene.objects, [&](const Object& object) { add_characters(object.name, more_characters_); });
  }
  return more_characters_.size() > before;
}

/// Puts into effect what the user chose, what the screen's density asks for, and what names need. To be called before
/// Dear ImGui's frame begins.
void MainWindow::update_look() {
  const Preferences& look = session_.preferences;
  const WindowSize size = platform_->size();
  const auto larger = static_cast<float>(look.text_size);
  const float pixels = larger * size.pixels, scale = larger * size.scale;
  const bool resized = pixels != ui_.pixels || scale != ui_.scale;
  if (resized || look.theme != theme_) set_style(scale, theme_ = look.theme);
  if (!find_characters() && !resized) return;
  ui_.fonts = load_fonts(pixels, scale, more_characters_);
  if (ui_.pixels != 0) platform_->renew_fonts();
  ui_.pixels = pixels;
  ui_.scale = scale;
  if (!ui_.log) return;
  const auto found = std::count_if(more_characters_.begin(), more_characters_.end(),
                                   [this](ImWchar c) { return ui_.fonts.body->FindGlyphNoFallback(c) != nullptr; });
  ui_.log->changed("fonts", std::to_string(found) + " of " + std::to_string(more_characters_.size()));
}

/// What the user changed about the window's look is remembered, once no button is held any more.
void MainWindow::use_preferences() {
  std::set<std::string>& folded = session_.preferences.folded;
  folded.clear();
  for (const Section& one : column_sections())
    if (!one.is(starts_folded) && ui_.folded.contains(one.heading)) folded.insert(one.heading);
  if (!read_mouse().any_down()) session_.keep_preferences();
}

/// Where things are for a picture of that shape.
Layout MainWindow::layout_for(const WindowSize& size, int image_width, int image_height) const {
  const float column = commands_.shows_panels() ? static_cast<float>(session_.preferences.column) : 0;
  const auto width = static_cast<float>(size.width), height = static_cast<float>(size.height);
  const float shown = std::min(std::round(column * ui_.scale), std::floor(width / 2));
  return make_layout(width, height, image_width, image_height, ui_.scale, column,
                     strip_.height(width - shown, image_width, image_height, ui_.scale) +
                         Timeline::height(session_.editor.scene(), ui_.scale));
}

/// Renders as many pixels as the window shows of the picture, where the user wants that.
void MainWindow::follow_window_size() {
  const Scene& scene = session_.editor.scene();
  const float dots = panels_.now.dots;
  const Rect image = layout_for(platform_->size(), scene.width, scene.height).image;
  const PictureSize shown{static_cast<int>(std::lround(image.width() * dots)),
                          static_cast<int>(std::lround(image.height() * dots))};
  const bool seen = shown.width > 0 && shown.height > 0;
  const bool follows = panels_.at_window && seen && !session_.shows_picture();
  session_.set_picture_size(follows ? std::optional(shown) : std::nullopt);
}

}  // namespace tyndall
