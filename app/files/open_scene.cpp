#include "app/files/open_scene.h"

#include "app/text/standard_streams.h"
#include "core/base/error.h"
#include "core/scene/check.h"

#include <algorithm>
#include <system_error>

namespace tyndall {
namespace {

/// Programs name images by whole paths, as they run elsewhere. Those below the folder are named from there, so that the
/// scene can be moved with them.
void name_textures_from(const std::filesystem::path& folder, Scene& scene) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::canonical(folder, error);
  if (error) return;
  each_picture(scene, [&](auto& picture) {
    const std::filesystem::path below = std::filesystem::path(picture.file).lexically_relative(whole);
    if (!below.empty() && *below.begin() != "..") picture.file = below.string();
  });
}

/// Colours that this thread has been given before they are asked for, the next one last.
thread_local std::vector<Vec3d> ahead;

/// The scene that a program describes, or its own samples.
LoadedScene load_program_scene(const SceneRequest& request, OwnSamples& own) {
  const std::filesystem::path file = request.what, folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!request.program.allowed)
    throw SceneError(
        request.what, "a program",
        "a scene file or an image; a program is compiled and run only where it is named on the command line");
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw SceneError(request.what, "no such file", "a C++ source file");
  ProgramTask parts = request.program;
  parts.sources.files.insert(parts.sources.files.begin(), file);
  parts.watch_signals = !parts.go_on;
  const ProgramScene made = load_program(parts);
  for (const std::string& note : made.notes)
    if (!request.program.told) complain(note);
  LoadedScene loaded;
  std::string reason = made.reason;
  if (!made.json.empty()) {
    loaded = load_scene_text(made.json, request.what, folder, request.overrides);
    name_textures_from(folder, loaded.scene);
    if (request.program.differs && request.overrides.empty()) reason = request.program.differs(loaded.scene, made);
  }
  if (!reason.empty()) {
    loaded = LoadedScene{};
    loaded.name = request.what, loaded.folder = folder, loaded.is_picture = true;
    loaded.scene.width = made.picture.width, loaded.scene.height = made.picture.height;
    loaded.scene.render.spp = made.picture.samples;
    loaded.scene.render.seed = own.take(made.own, request.what + ": " + reason);  // another program, another picture
  }
  loaded.sources = made.files;
  loaded.files.insert(loaded.files.begin(), made.files.begin(), made.files.end());
  return loaded;
}

/// Applies the options to a scene, and checks it again.
void apply_options(const SceneRequest& request, LoadedScene& loaded) {
  if (request.size) loaded.scene.width = request.size->width, loaded.scene.height = request.size->height;
  apply(request.render, loaded.scene.render);
  apply(request.display, loaded.scene.display);
  if (const auto error = check(loaded.scene))
    throw SceneError(loaded.name, error->where, error->found, error->expected);
}

}  // namespace

OwnSamples::OwnSamples()
    : function_(std::make_shared<WatchedFunction>(
          [its = held_](double x, double y, std::uint64_t, double rgb[3]) {
            if (const auto program = its->current(); ahead.empty() && program) ahead = program->samples({{x, y}});
            if (ahead.empty()) return;
            rgb[0] = ahead.back().x, rgb[1] = ahead.back().y, rgb[2] = ahead.back().z;
            ahead.pop_back();
          },
          [its = held_](const std::vector<Pair<double>>& points) {
            ahead.clear();
            const auto program = its->current();
            if (!program || !program->is_quick()) return;
            std::vector<tyndall_book::pixel_place> places;
            for (const Pair<double>& one : points) places.push_back({one.x, one.y});
            try {
              ahead = program->samples(places);
              std::reverse(ahead.begin(), ahead.end());
            } catch (const IoError&) {  // which is told where single samples are asked for
            }
          })) {}

std::uint32_t OwnSamples::take(std::shared_ptr<OwnProgram> program, const std::string& reason) {
  const std::lock_guard lock(held_->mutex);
  held_->taken += program ? 1 : 0;
  held_->program.swap(program);
  held_->reason = reason;
  return held_->taken;
}

std::string OwnSamples::reason() const {
  const std::lock_guard lock(held_->mutex);
  return held_->reason;
}

LoadedScene open_scene_or_samples(const SceneRequest& request, OwnSamples& own) {
  own.take(nullptr, "");
  LoadedScene loaded =
      is_program(request.what) ? load_program_scene(request, own) : load_scene(request.what, request.overrides);
  if (loaded.is_picture && !request.overrides.empty())
    throw UsageError(own.reason() + "; --set changes scenes, and these are samples of its own");
  apply_options(request, loaded);
  if (loaded.is_picture) complain(own.reason() + "; these are your own samples");
  if (request.program.told || loaded.is_picture) return loaded;
  for (const std::string& remark : texture_remarks(loaded.scene)) complain(remark);
  if (const std::string remark = contents_remark(loaded); !remark.empty()) complain(remark);
  return loaded;
}

LoadedScene open_scene(const SceneRequest& request) {
  OwnSamples own;
  LoadedScene loaded = open_scene_or_samples(request, own);
  if (loaded.is_picture)
    throw UsageError(request.what +
                     " is no scene, but a program whose own samples can be shown, by tyndall render and tyndall view");
  return loaded;
}

LoadedScene open_variant(const LoadedScene& opened, const SceneRequest& request, const std::vector<Override>& more,
                         const std::string& name) {
  std::vector<Override> overrides = request.overrides;
  overrides.insert(overrides.end(), more.begin(), more.end());
  LoadedScene loaded = opened;
  loaded.scene = load_scene_text(opened.text, name, opened.folder, overrides).scene;
  if (!opened.sources.empty()) name_textures_from(opened.folder, loaded.scene);
  loaded.name = name;
  apply_options(request, loaded);
  loaded.name = opened.name;
  return loaded;
}

LoadedScene at_frame(LoadedScene loaded, const FramePlan& plan, int frame) {
  try {
    loaded.scene = frame_scene(loaded.scene, plan, frame);
  } catch (const ParseError& error) {
    throw SceneError(loaded.name + ": frame " + std::to_string(frame), error.where, error.found, error.expected);
  }
  return loaded;
}

}  // namespace tyndall
