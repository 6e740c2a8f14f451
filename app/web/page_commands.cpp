// What only the page can be asked for.
#include "app/web/link.h"
#include "app/window/commands.h"

#include <emscripten/em_js.h>
#include <imgui.h>

#include <cstdlib>
#include <exception>
#include <memory>

EM_JS(char*, page_address, (), { return stringToNewUTF8(location.href.split('#')[0]); });

namespace tyndall {
namespace {

std::string link_to(const Document& document) {
  const std::unique_ptr<char, decltype(&std::free)> page(page_address(), &std::free);
  const Scene scene = move_textures(document.scene, document.origin->folder, assets_folder() / "scenes");
  return page.get() + ("#" + link_of_scene(write_scene(scene)));
}

}  // namespace

std::vector<Command> Commands::table_of_page() {
  return {{"copy a link",
           "share, url, address, send the scene",
           {},
           0,
           [](Commands& c, auto&) {
             try {
               ImGui::SetClipboardText(link_to(c.session_.editor.document()).c_str());
               c.session_.messages.say("copied a link to this page with the scene as it is now");
             } catch (const std::exception& error) {
               c.session_.messages.say(error.what(), true);
             }
           },
           requires_scene,
           "to this page, with the edited scene"}};
}

}  // namespace tyndall
