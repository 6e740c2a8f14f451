#pragma once
// In the place of glad: browsers' OpenGL ES 3 has its functions by name.
#include <GLES3/gl3.h>

inline int gladLoadGL(void (*(*)(const char*))()) { return 1; }
