#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/support/program.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("the doctor finds the latency of a simulated light sensor again", "[session]") {
    const ProgramRun run = run_overt({"doctor", "--photodiode", "--sensor", "simulated", "--context",
                                      "osmesa", "--seconds", "20", "--json"},
                                     {});
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    const auto report = nlohmann::json::parse(run.out);
    CHECK(report["source"] == "virtual display");
    const auto figure = [&](const std::string& name) {
        for (const auto& entry : report["figures"])
            if (entry["figure"] == name)
                return entry["value"].get<double>();
        return -1.0;
    };
    // 20 s at 120 Hz, a change every six refreshes, but for the first.
    CHECK(figure("changes") == Approx(399).margin(1));
    CHECK(figure("seen") == figure("changes"));
    CHECK(figure("latency") == Approx(5.0).margin(0.05));
    CHECK(figure("standard deviation of the latency") == Approx(0.2).epsilon(0.2));
}

TEST_CASE("a sensor of light at a display that is not there, or a port that is none, is refused",
          "[session]") {
    const ProgramRun run =
        run_overt({"doctor", "--photodiode", "--sensor", "/dev/null", "--context", "osmesa"}, {});
    CHECK(run.exit_code == 2);
    CHECK(run.err.find("a sensor has nothing to see of a display that is not there") != std::string::npos);
    CHECK(run.out.empty());
}
