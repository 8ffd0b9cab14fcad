// What nearly every test includes; see cmake/Effort.cmake. An assertion that throws names the test case, not
// itself: code that would name it is a tenth of what a test compiles to.
#pragma once

#include "cmake/precompiled.h"

#define CATCH_CONFIG_FAST_COMPILE
#include <catch2/catch.hpp>
