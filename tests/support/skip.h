/// Leaving a test that cannot be done on this machine, so that everybody sees it: CTest counts it as skipped
/// and lists it at the end.
#pragma once

#include <cstdio>

namespace overt::test {

/// What a test program ends with when nothing failed and something was skipped, here and as CTest knows it
/// (cmake/DiscoverTests.cmake). Not some words of the output, for these would hide a failure beside them.
inline constexpr int skipped_exit_code = 77;

inline bool was_skipped = false;

} // namespace overt::test

/// `why` as a string literal; returns from the test case.
#define OVERT_SKIP(why)                                                                                      \
    do {                                                                                                     \
        std::puts("overt test skipped: " why);                                                               \
        std::fflush(stdout);                                                                                 \
        overt::test::was_skipped = true;                                                                     \
        return;                                                                                              \
    } while (false)
