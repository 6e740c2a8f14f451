#pragma once
#include <string>

namespace tyndall {

/// What keeps a program from changing anything outside one folder, whatever it calls and starts. Each layer is enough
/// by itself, as far as the kernel has it.
struct GuardLayers {
  /// Namespaces (Linux 5.12): all files read-only but the folder, no devices, own processes, own IPC, no network. They
  /// alone leave a named pipe that somebody reads open to be written to.
  bool namespaces = false;
  /// The version of Landlock (1: Linux 5.13); 0: none. What it lets through a filter of system calls refuses.
  int landlock = 0;

  bool any() const { return namespaces || landlock > 0; }
};

/// The layers that this system grants this process, tried at the first call.
const GuardLayers& available_guard();

/// "namespaces and Landlock", "namespaces", "Landlock" or "none".
std::string guard_text(const GuardLayers& layers);

// A process puts itself under guard between fork() and exec(), by functions that are safe there. folder: a whole path
// without links. Both return the number of an error, 0: done.

/// Enters the namespaces, if that layer acts. All processes that this process starts from then on end when it ends, or
/// closes `life`. It keeps the rights over the namespaces itself, so it must not run foreign code.
int enter_namespaces(const GuardLayers& layers, const char* folder, int& life);
/// Takes all further rights from this process, which is to run the program.
int restrict_self(const GuardLayers& layers, const char* folder);

}  // namespace tyndall
