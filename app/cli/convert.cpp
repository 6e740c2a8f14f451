#include "app/cli/commands.h"
#include "app/files/open_scene.h"
#include "app/files/outputs.h"
#include "app/text/standard_streams.h"

namespace tyndall {

int run(const ConvertCommand& command) {
  const LoadedScene loaded = open_scene(command.scene);
  const bool to_standard_output = command.output == "-";
  const std::filesystem::path folder = to_standard_output ? "" : command.output.parent_path();
  const std::string text = write_scene(move_textures(loaded.scene, loaded.folder, folder));
  if (to_standard_output) {
    write_standard_output(text);
  } else {
    check_outputs({{"--output", command.output}}, loaded.files);
    check_can_write(command.output);
    write_text_or_rescue(command.output, text);
  }
  return 0;
}

}  // namespace tyndall
