/// The same seeds give the same session, whatever it is drawn with.
#include <catch2/catch.hpp>

#include "render/gl/headless_context.h"
#include "tests/app/session/exported_tables.h"
#include "tests/support/gl_contexts.h"
#include "tests/support/skip.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("the same seeds export the same bytes, other seeds do not", "[session]") {
    const SmallExperiment experiment(Cache::own);
    REQUIRE(experiment.run().exit_code == 0);
    // Drawn anew: nothing comes from the cache of the first.
    std::filesystem::remove_all(experiment.cache());
    REQUIRE(experiment.run().exit_code == 0);
    REQUIRE(experiment.run({"--seed", "8"}).exit_code == 0);
    const Tables first = exported(experiment, 1);
    CHECK(first.size() == 20);
    CHECK(differing(first, exported(experiment, 2)) == std::vector<std::string>{});

    const Tables other_order = exported(experiment, 3);
    for (const char* const table : {"trials.tsv", "samples.tsv", "responses.tsv"})
        CHECK(other_order.at(table) != first.at(table));
    CHECK(other_order.at("stimuli.tsv") == first.at("stimuli.tsv"));
}

TEST_CASE("another simulated observer looks elsewhere in the same order of trials", "[session]") {
    const SmallExperiment experiment;
    const std::vector<std::string> common{"run",
                                          experiment.protocol().string(),
                                          "--observer",
                                          "P01",
                                          "--seed",
                                          "7",
                                          "--virtual-time",
                                          "--context",
                                          "osmesa",
                                          "--trials",
                                          "3",
                                          "--sessions",
                                          experiment.sessions().string()};
    for (const char* const seed : {"5", "6"}) {
        std::vector<std::string> arguments = common;
        arguments.insert(arguments.end(), {"--simulate-observer", seed});
        REQUIRE(experiment.overt(arguments).exit_code == 0);
    }
    const Tables one = exported(experiment, 1), other = exported(experiment, 2);
    CHECK(one.at("samples.tsv") != other.at("samples.tsv"));
    CHECK(one.at("stimuli.tsv") == other.at("stimuli.tsv"));
}

TEST_CASE("sessions drawn with OSMesa and with EGL in software export the same bytes", "[session]") {
    if (!make_headless_context(ContextKind::egl)->description().is_software)
        OVERT_SKIP("EGL draws with a graphics processor here");
    const SmallExperiment experiment(Cache::own);
    // Mesa's EGL library keeps memory until the end of the process, and is unloaded before leaks are looked
    // for.
    const std::vector<std::string> lenient{"ASAN_OPTIONS=detect_leaks=0"};
    REQUIRE(experiment.run({"--context", "osmesa"}).exit_code == 0);
    std::filesystem::remove_all(experiment.cache());
    REQUIRE(experiment.run({"--context", "egl"}, lenient).exit_code == 0);
    CHECK(differing(exported(experiment, 1), exported(experiment, 2)) == std::vector<std::string>{});
}

TEST_CASE("maps drawn live and maps drawn before give the same gaze on the surface", "[session]") {
    const SmallExperiment experiment(Cache::own);
    REQUIRE(experiment.run({"--maps", "prepared"}).exit_code == 0);
    std::filesystem::remove_all(experiment.cache());
    REQUIRE(experiment.run({"--maps", "live"}).exit_code == 0);
    CHECK(differing(exported(experiment, 1), exported(experiment, 2)) == std::vector<std::string>{});
}
