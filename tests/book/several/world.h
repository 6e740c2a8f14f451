#ifndef WORLD_H
#define WORLD_H
#include "books.h"
hittable_list balls();
#endif
