#pragma once
#include "app/cli/render_job.h"
#include "app/files/frame_list.h"

#include <filesystem>
#include <string>

/// What an earlier run has left of the pictures that a command is to make, so that a killed one goes on.
namespace tyndall {

enum class PictureState { nothing, unfinished, whole };

/// What there is of a job's picture in a PNG or EXR. Throws UsageError if the file is of something else: it holds no
/// picture of the same scene, settings and version. The job needs its scene, options and kernels.
PictureState look_at_picture(const std::filesystem::path& file, const RenderJob& job);

/// The same for formats that carry no settings, by a list beside them. mark: see picture_mark().
PictureState look_at_list(const std::filesystem::path& file, const FrameList& list, int frame, const std::string& mark);

/// 16 hexadecimal digits that differ with the job's scene, settings, version and instruction set.
std::string picture_mark(const RenderJob& job);
/// The same of any text.
std::string mark_of(const std::string& text);

}  // namespace tyndall
