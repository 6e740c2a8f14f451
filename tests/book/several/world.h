#ifndef WORLD_H
#define WORLD_H
#include "hittable_list.h"
hittable_list balls();
#endif
