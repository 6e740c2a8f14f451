#pragma once
#include "app/cli/requests.h"

/// The commands. Each returns the program's exit code (0: done, 1: a check failed, 130 and 143: interrupted) and throws
/// for everything else: UsageError, SceneError, MergeError (the user's fault), or what input and output throw.
namespace tyndall {

int run(const ViewCommand& command);
int run(const RenderCommand& command);
int run(const CompareCommand& command);
int run(const ChartCommand& command);
int run(const VerifyCommand& command);
int run(const MergeCommand& command);
int run(const InspectCommand& command);
int run(const ScenesCommand& command);
int run(const ConvertCommand& command);
int run(const PrintCommand& command);

}  // namespace tyndall
