/// `overt bench tracker`: no sample is lost or doubled, and its figures are there for programs.
#include <catch2/catch.hpp>

#include <map>

#include <nlohmann/json.hpp>

#include "tests/support/program.h"

using namespace overt::test;

TEST_CASE("the benchmark of the eye tracker finds each sample once, in virtual and in real time",
          "[session]") {
    const ProgramRun run =
        run_overt({"bench", "tracker", "--seconds", "1", "--context", "osmesa", "--size", "64", "--json"});
    INFO(run.err);
    const auto json = nlohmann::json::parse(run.out);
    std::map<std::string, double> figures;
    std::string group;
    for (const auto& figure : json["figures"]) {
        std::string name = figure["figure"];
        if (name.ends_with(", samples"))
            group = name;
        else if (name.starts_with("the same"))
            name = group + name;
        figures[name] = figure["value"];
    }
    const std::string virtual_time = "10 minutes of virtual time at 2000 Hz, samples";
    const std::string real_time = "1 s of real time at 2000 Hz beside a presentation, samples";
    CHECK(figures.at(virtual_time) >= 1'199'999);
    CHECK(figures.at(real_time) > 0); // how many are due depends on how long a busy machine presents
    for (const std::string& of : {virtual_time, real_time})
        for (const char* const what : {"the same, lost samples", "the same, doubled samples"})
            CHECK(figures.at(of + what) == 0.0);
    CHECK(figures.count("refreshes missed beside the tracker") == 1);
    CHECK(figures.count("refreshes missed without it") == 1);
}
