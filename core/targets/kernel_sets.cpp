// The kernels that leave models out, for an instruction set that most processors have; compiled once for each, see
// core/base/lanes_target.h.
#include "core/base/lanes_target.h"
#include "core/targets/entry.h"

namespace tyndall {

void add_kernel_sets(TargetIs<Target::TYNDALL_TARGET>, Kernels& kernels) {
  const auto add = [&](KernelSet set, RenderTile render) { kernels.render[static_cast<int>(set)] = render; };
  using enum KernelSet;
  add(common_models, render_tile_entry<KernelLanes, common_models>);
  add(specular_paths_only, render_tile_entry<KernelLanes, specular_paths_only>);
  add(guided_paths_only, render_tile_entry<KernelLanes, guided_paths_only>);
  add(no_specular_paths, render_tile_entry<KernelLanes, no_specular_paths>);
  add(no_media_no_textures, render_tile_entry<KernelLanes, no_media_no_textures>);
}

}  // namespace tyndall
