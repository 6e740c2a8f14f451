#pragma once
#include "app/cli/requests.h"

/// The commands. Each returns the program's exit code: 0 when done, 1 if a check failed, output_failed, or 130 and 143
/// if interrupted. For everything else they throw: UsageError, SceneError and MergeError where the user is at fault,
/// IoError and ImageFileError where input or output fails.
namespace tyndall {

/// The exit code of a command that computed a picture and could not write all of it.
inline constexpr int output_failed = 3;

/// Runs the command that was read, or prints the text.
int run(const Command& command);

int run_view(const CommandRequest& request);
int run_render(const CommandRequest& request);
int run_sweep(const CommandRequest& request);
int run_animate(const CommandRequest& request);
int run_compare(const CommandRequest& request);
int run_chart(const CommandRequest& request);
int run_verify(const CommandRequest& request);
int run_merge(const CommandRequest& request);
int run_denoise(const CommandRequest& request);
int run_inspect(const CommandRequest& request);
int run_scenes(const CommandRequest& request);
int run_convert(const CommandRequest& request);

}  // namespace tyndall
