#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include "tests/support/skip.h"

/// Ends with 0, with 1 if something failed, or with what stands for skipped.
int main(int argc, char* argv[]) {
    if (Catch::Session().run(argc, argv) != 0)
        return 1;
    return overt::test::was_skipped ? overt::test::skipped_exit_code : 0;
}
