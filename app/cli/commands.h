#pragma once
#include "app/cli/requests.h"

/// The commands. Each returns the program's exit code: 0 when done, 1 if a check failed, output_failed, or 130 and 143
/// if interrupted. For everything else they throw: UsageError, SceneError and MergeError where the user is at fault,
/// IoError and ImageFileError where input or output fails.
namespace tyndall {

/// The exit code of a command that computed a picture and could not write all of it.
inline constexpr int output_failed = 3;

int run(const ViewCommand& command);
int run(const RenderCommand& command);
int run(const SweepCommand& command);
int run(const AnimateCommand& command);
int run(const CompareCommand& command);
int run(const ChartCommand& command);
int run(const VerifyCommand& command);
int run(const MergeCommand& command);
int run(const DenoiseCommand& command);
int run(const InspectCommand& command);
int run(const ScenesCommand& command);
int run(const ConvertCommand& command);
int run(const PrintCommand& command);

}  // namespace tyndall
