/// Leaving a test that cannot be done on this machine, so that everybody sees it: CTest counts it as skipped
/// and lists it at the end.
#pragma once

#include <cstdio>

/// `why` as a string literal; returns from the test case.
#define OVERT_SKIP(why)                                                                                      \
    do {                                                                                                     \
        std::puts("overt test skipped: " why);                                                               \
        std::fflush(stdout);                                                                                 \
        return;                                                                                              \
    } while (false)
