#include "app/window/appearance.h"

#include "app/window/tools/selection.h"

#include <algorithm>

namespace tyndall {
namespace {

/// "2 of 3": how many of the characters the fonts have.
std::string found_text(const Fonts& fonts, const Characters& more) {
  const auto found =
      std::count_if(more.begin(), more.end(), [&](ImWchar c) { return fonts.body->FindGlyphNoFallback(c) != nullptr; });
  return std::to_string(found) + " of " + std::to_string(more.size());
}

}  // namespace

/// Looks for characters that the fonts were not loaded for. Returns whether there are any.
bool Appearance::find_characters(const std::vector<std::filesystem::path>& files) {
  bool added = add_characters(ui_.edit.text, more_);
  added = add_characters(session_.messages.current().text, more_) || added;
  if (files.size() != files_)
    for (const auto& file : files) added = add_characters(file.string(), more_) || added;
  files_ = files.size();
  if (session_.editor.changes() == changes_) return added;
  changes_ = session_.editor.changes();
  const Scene& scene = session_.editor.scene();
  added = add_characters(session_.editor.document().origin->title, more_) || added;
  for (const Material& material : scene.materials) added = add_characters(material.name, more_) || added;
  for (const Texture& texture : scene.textures) added = add_characters(texture.name, more_) || added;
  each_object(scene.objects, [&](const Object& object) { added = add_characters(object.name, more_) || added; });
  return added;
}

void Appearance::update(const Preferences& look, const std::vector<std::filesystem::path>& files) {
  const WindowSize size = platform_.size();
  const auto larger = static_cast<float>(look.text_size);
  const float pixels = larger * size.pixels, scale = larger * size.scale;
  const bool resized = pixels != ui_.pixels || scale != ui_.scale;
  if (resized || look.theme != theme_) set_style(scale, theme_ = look.theme);
  if (!find_characters(files) && !resized) return;
  ui_.fonts = load_fonts(pixels, scale, more_);
  if (ui_.pixels != 0) platform_.renew_fonts();
  ui_.pixels = pixels;
  ui_.scale = scale;
  if (ui_.log) ui_.log->changed("fonts", found_text(ui_.fonts, more_));
}

}  // namespace tyndall
