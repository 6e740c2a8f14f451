#pragma once
/// The names of "Ray Tracing in One Weekend", "The Next Week" and "The Rest of Your Life", all editions, by which a
/// reader's main() describes its scene. Nothing here traces a ray: camera::render(), or the loop in main() of editions
/// 1 to 3, hands the scene to Tyndall. app/book/README.md says what works. C++17, no other files needed.
#include "parts/loop.h"
#include "parts/names.h"
#include "parts/omp.h"

// What the books' own headers include, and main() may rely on.
#include <algorithm>
#include <cctype>
#include <cfloat>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <vector>
