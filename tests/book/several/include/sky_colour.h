#pragma once
#include "books.h"
inline const color sky_colour(0.125, 0.25, 0.5);
