#pragma once
#include "core/shapes/box.h"
#include "core/shapes/disk.h"
#include "core/shapes/quad.h"
#include "core/shapes/sphere.h"
#include "core/shapes/triangle.h"
