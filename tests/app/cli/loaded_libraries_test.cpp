#include <catch2/catch.hpp>

#include "tests/support/program.h"

using namespace overt::test;

TEST_CASE("a command that draws nothing loads no OpenGL that is drawn by the processor", "[unit]") {
    // The loader names each library that it looks for.
    const ProgramRun run = run_overt({"--version"}, {"LD_DEBUG=libs"});
    REQUIRE(run.exit_code == 0);
    CHECK(run.err.find("libsqlite3") != std::string::npos);
    CHECK(run.err.find("libOSMesa") == std::string::npos);
    CHECK(run.err.find("libLLVM") == std::string::npos);
}
