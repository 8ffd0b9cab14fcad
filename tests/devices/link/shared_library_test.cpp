// Which files a vendor's library is looked for in, and what is told of it.
#include "devices/link/shared_library.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <catch2/catch.hpp>

#include "devices/triggers/marker_device.h"
#include "experiment/base/error.h"
#include "tests/devices/lsl/lsl_bench.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("a library is that which is named, else the environment's, else one of the usual names", "[unit]") {
    const VendorLibrary& lsl = vendor_library("lsl");
    unsetenv(lsl.variable);
    std::vector<std::string> usual;
    for (const char* const name : lsl.usual_names)
        if (name)
            usual.emplace_back(name);
    REQUIRE_FALSE(usual.empty());
    CHECK(library_candidates("", lsl) == usual);
    CHECK(library_candidates("one.so", lsl) == std::vector<std::string>{"one.so"});
    setenv(lsl.variable, "", 1);
    CHECK(library_candidates("", lsl) == usual);
    setenv(lsl.variable, "other.so", 1);
    CHECK(library_candidates("", lsl) == std::vector<std::string>{"other.so"});
    CHECK(library_candidates("one.so", lsl) == std::vector<std::string>{"one.so"});
    unsetenv(lsl.variable);
}

TEST_CASE("the first file that can be loaded is, and is told of by its place; else each one's reason is",
          "[unit]") {
    const TemporaryFolder folder;
    const auto link = folder.path() / "link.so";
    std::filesystem::create_symlink(OVERT_FAKE_LIBLSL, link);
    const std::string real = std::filesystem::canonical(OVERT_FAKE_LIBLSL).string();
    const auto count = [&] {
        const auto all = loaded_vendor_libraries();
        return std::ranges::count(all, real);
    };
    const auto before = count();
    const SharedLibrary library({"/nowhere/a.so", link.string(), "/nowhere/b.so"}, "The library", "Get it.");
    CHECK(library.file() == link.string());
    CHECK(count() == before + 1);
    int (*there)() = nullptr;
    std::vector<std::string> missing;
    library.require(there, "lsl_library_version", missing);
    CHECK(there);
    library.require(there, "no such function", missing);
    CHECK_FALSE(there);
    CHECK(missing == std::vector<std::string>{"no such function"});
    CHECK_THROWS_WITH(SharedLibrary({"/nowhere/a.so", "/nowhere/b.so"}, "The library", "Get it."),
                      Catch::StartsWith("The library cannot be loaded: /nowhere/a.so: ") &&
                          Catch::Contains("; /nowhere/b.so: ") && Catch::EndsWith(". Get it."));
    CHECK(count() == before + 1);
}

TEST_CASE("the row of streams of marks says whether their library is there, and sends by it", "[unit]") {
    const LslBench bench;
    const MarkerDevice device = marker_device_of<kind_called<MarkerOutputKind>("lsl")>();
    const VendorLibrary& lsl = vendor_library("lsl");
    setenv(lsl.variable, OVERT_FAKE_LIBLSL, 1);
    CHECK(device.look_for() ==
          std::vector<std::string>{"Lab Streaming Layer: its library is there, kind lsl"});
    SteadyClock clock;
    const std::string session = "s07";
    const MarkerOutputSettings settings;
    const auto output = device.open({settings, clock, session});
    CHECK(output->send({clock.now(), 3, "ONSET"}));
    REQUIRE(bench.fake().sent.size() == 1);
    CHECK(bench.fake().sent.front()->source == "overt s07");
    setenv(lsl.variable, "/nowhere/liblsl.so", 1);
    const auto lines = device.look_for();
    REQUIRE(lines.size() == 1);
    CHECK_THAT(lines[0], Catch::StartsWith("Lab Streaming Layer: ") && Catch::Contains("/nowhere/liblsl.so"));
    CHECK_THROWS_AS(device.open({settings, clock, session}), DeviceError);
    unsetenv(lsl.variable);
}
