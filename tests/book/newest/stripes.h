#pragma once
// A header of the program's own, with a byte order mark; its includes lead to the books' headers, too.
#include "vec3.h"

const color stripes(0.5, 0.25, 0.125);
