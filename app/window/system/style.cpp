#include "app/window/system/style.h"

#include "app/report/contact_sheet.h"
#include "core/system/files.h"

#include <filesystem>
#include <map>
#include <vector>

namespace tyndall {
namespace {

/// Like Dear ImGui's style there is one for the program; the main thread's.
Theme current_theme = Theme::dark;

ImVec4 faded(Tone tone, float alpha) {
  tone.w *= alpha;
  return tone;
}

namespace fs = std::filesystem;

/// Latin, Greek, Cyrillic and the signs that the panels use.
constexpr ImWchar usual_ranges[] = {0x0020, 0x017f, 0x0370, 0x045f, 0x2010, 0x2026, 0x2070, 0x209c, 0x2190, 0x2193,
                                    0x2212, 0x2212, 0x221e, 0x221e, 0x2248, 0x2248, 0x2264, 0x2265, 0};

bool is_always_loaded(ImWchar c) {
  for (const ImWchar* range = usual_ranges; *range != 0; range += 2)
    if (c >= range[0] && c <= range[1]) return true;
  return c < 0x20;
}

/// All font files below a folder, by their names.
void find_fonts(const fs::path& folder, std::map<std::string, fs::path>& out) {
  std::error_code error;
  fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    const std::string ending = at->path().extension().string();
    if (ending == ".ttf" || ending == ".ttc" || ending == ".otf")
      out.emplace(at->path().filename().string(), at->path());
  }
}

/// The installed fonts in which characters are looked for that the first ones do not have, best first.
std::vector<std::string> further_fonts() {
  static constexpr const char* names[] = {"NotoSansCJK-Regular.ttc",
                                          "NotoSansCJK-VF.otf.ttc",
                                          "NotoSansCJKsc-Regular.otf",
                                          "SourceHanSans-Regular.ttc",
                                          "wqy-microhei.ttc",
                                          "wqy-zenhei.ttc",
                                          "DroidSansFallbackFull.ttf",
                                          "DroidSansFallback.ttf",
                                          "ipagp.ttf",
                                          "fonts-japanese-gothic.ttf",
                                          "NanumGothic.ttf",
                                          "uming.ttc",
                                          "NotoSans-Regular.ttf",
                                          "DejaVuSans.ttf",
                                          "FreeSans.ttf",
                                          "unifont.ttf"};
  std::map<std::string, fs::path> installed;
  for (const char* folder : {"/usr/share/fonts", "/usr/local/share/fonts", "/Library/Fonts", "C:/Windows/Fonts"})
    find_fonts(folder, installed);
  if (const fs::path home = home_folder(); !home.empty()) find_fonts(home / ".local/share/fonts", installed);
  std::vector<std::string> files;
  for (const char* name : names)
    if (const auto found = installed.find(name); found != installed.end()) files.push_back(found->second.string());
  return files;
}

/// Pairs of first and last, and a 0 at the end, as Dear ImGui takes them.
std::vector<ImWchar> ranges_of(const Characters& characters) {
  std::vector<ImWchar> ranges;
  for (const ImWchar c : characters) {
    if (!ranges.empty() && ranges.back() + 1 == c)
      ranges.back() = c;
    else
      ranges.insert(ranges.end(), {c, c});
  }
  ranges.push_back(0);
  return ranges;
}

/// What the fonts beyond the first ones are loaded for.
struct Further {
  std::vector<std::string> files;
  std::vector<ImWchar> ranges;
};

/// A font of a size, and into it what the further ones have.
ImFont* add_font(const std::string& file, float size, const Further& further) {
  ImFontAtlas* atlas = ImGui::GetIO().Fonts;
  ImFontConfig usual, built_in;
  usual.OversampleH = 2;
  usual.OversampleV = 1;
  built_in.SizePixels = size;
  ImFont* font = file.empty() ? nullptr : atlas->AddFontFromFileTTF(file.c_str(), size, &usual, usual_ranges);
  if (!font) font = atlas->AddFontDefault(&built_in);
  for (const std::string& more : further.files) {
    ImFontConfig config;
    config.MergeMode = true;
    config.OversampleH = 1;
    atlas->AddFontFromFileTTF(more.c_str(), size, &config, further.ranges.data());
  }
  return font;
}

}  // namespace

ThemeTone::operator Tone() const { return current_theme == Theme::dark ? dark : light; }

ImU32 shade(Tone colour, float alpha) { return ImGui::ColorConvertFloat4ToU32(faded(colour, alpha)); }

void set_style(float scale, Theme theme) {
  current_theme = theme;
  ImGuiStyle style;
  style.WindowRounding = 0;
  style.FrameRounding = style.GrabRounding = style.PopupRounding = 4;
  style.ChildRounding = 6;
  style.WindowBorderSize = style.PopupBorderSize = 0;
  style.WindowPadding = {16, 12};
  style.FramePadding = {8, 4};
  style.ItemSpacing = {8, 6};
  style.ScrollbarSize = 10;
  style.ScrollbarRounding = 5;
  ImVec4* c = style.Colors;
  theme == Theme::dark ? ImGui::StyleColorsDark(&style) : ImGui::StyleColorsLight(&style);
  c[ImGuiCol_WindowBg] = palette::panel;
  c[ImGuiCol_ChildBg] = {0, 0, 0, 0};
  c[ImGuiCol_PopupBg] = palette::field;
  c[ImGuiCol_Text] = palette::text;
  c[ImGuiCol_TextDisabled] = palette::dim;
  c[ImGuiCol_TextSelectedBg] = faded(palette::blue, 0.35f);
  c[ImGuiCol_FrameBg] = palette::field;
  c[ImGuiCol_FrameBgHovered] = palette::field_hovered;
  c[ImGuiCol_FrameBgActive] = palette::field_active;
  c[ImGuiCol_SliderGrab] = palette::blue;
  c[ImGuiCol_SliderGrabActive] = palette::amber;
  c[ImGuiCol_CheckMark] = palette::blue;
  c[ImGuiCol_Button] = palette::field;
  c[ImGuiCol_ButtonHovered] = faded(palette::chosen, 0.8f);
  c[ImGuiCol_ButtonActive] = palette::blue;
  c[ImGuiCol_Header] = faded(palette::blue, 0.22f);
  c[ImGuiCol_HeaderHovered] = faded(palette::veil, 0.06f);
  c[ImGuiCol_HeaderActive] = faded(palette::veil, 0.09f);
  c[ImGuiCol_Separator] = palette::line;
  c[ImGuiCol_Border] = palette::line;
  c[ImGuiCol_ScrollbarBg] = {0, 0, 0, 0};
  c[ImGuiCol_ScrollbarGrab] = faded(palette::veil, 0.10f);
  c[ImGuiCol_ScrollbarGrabHovered] = faded(palette::veil, 0.18f);
  c[ImGuiCol_ScrollbarGrabActive] = faded(palette::veil, 0.25f);
  c[ImGuiCol_ModalWindowDimBg] = {0.04f, 0.05f, 0.06f, 0.6f};
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

bool add_characters(const std::string& text, Characters& more) {
  constexpr std::size_t maximum = 4000;  // more would make the atlas too large for some displays
  bool added = false;
  for (std::size_t at = 0; at < text.size() && more.size() < maximum;) {
    const std::uint32_t code = next_letter(text, at);
    if (code > 0xffff || code == 0xfffd || is_always_loaded(static_cast<ImWchar>(code))) continue;
    added = more.insert(static_cast<ImWchar>(code)).second || added;
  }
  return added;
}

Fonts load_fonts(float pixels, float scale, const Characters& more) {
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  const std::string regular = find_font("Roboto-Regular.ttf"), medium = find_font("Roboto-Medium.ttf"),
                    mono = find_font("JetBrainsMono-Regular.ttf");
  const Further further{more.empty() ? std::vector<std::string>() : further_fonts(), ranges_of(more)};
  Fonts fonts;
  fonts.body = add_font(regular, 16 * pixels, further);
  fonts.small = add_font(regular, 13 * pixels, further);
  fonts.strong = add_font(medium, 16 * pixels, further);
  fonts.mono = add_font(mono, 14 * pixels, further);
  io.FontGlobalScale = scale / pixels;
#if IMGUI_VERSION_NUM < 19200
  io.Fonts->Build();           // now, while the ranges live
  io.Fonts->ClearInputData();  // the files may be large
#endif
  return fonts;
}

}  // namespace tyndall
