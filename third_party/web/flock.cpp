// Emscripten declares flock and has none. A page's files have no other users.
#include <sys/file.h>

int flock(int file, int operation) {
  (void)file, (void)operation;
  return 0;
}
