#pragma once
#include "parts/omp.h"
