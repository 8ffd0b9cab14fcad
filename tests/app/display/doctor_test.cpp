#include <filesystem>
#include <fstream>
#include <map>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "app/display/machine_doctor.h"
#include "tests/app/small_experiment.h"
#include "tests/support/program.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/virtual_screen.h"

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

TEST_CASE("the light of a square is measured in the mode and the corner of the session's protocol",
          "[session]") {
    const SmallExperiment experiment(
        with(small_protocol, "output = \"color++\"\n",
             "output = \"color++\"\nphotodiode = \"bottom-right\"\nphotodiode_px = 20\n"));
    const ProgramRun run = run_overt({"doctor", "--photodiode", "--sensor", "simulated", "--context",
                                      "osmesa", "--seconds", "2", experiment.protocol().string(), "--json"},
                                     {});
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    const auto report = nlohmann::json::parse(run.out);
    CHECK(report["mode"] == "color++");
    std::map<std::string, double> figures;
    for (const auto& entry : report["figures"])
        figures[entry["figure"]] = entry["value"];
    // The square stands at the bottom: its first row is sent after all above it.
    // The protocol's screen has 192 rows at 120 Hz.
    CHECK(figures["scan-out above the square"] == Approx(1e3 * (192 - 20) / (192 * 120.0)));
    CHECK(figures["latency of the first row"] ==
          Approx(figures["latency"] - figures["scan-out above the square"]));

    const ProgramRun wrong = run_overt({"doctor", "--photodiode", "--context", "osmesa",
                                        (experiment.protocol().parent_path() / "none.toml").string()},
                                       {});
    CHECK(wrong.exit_code == 2);
    CHECK(wrong.err.find("none.toml") != std::string::npos);
}

TEST_CASE("a sensor of light at a display that is not there, or a port that is none, is refused",
          "[session]") {
    const ProgramRun run =
        run_overt({"doctor", "--photodiode", "--sensor", "/dev/null", "--context", "osmesa"}, {});
    CHECK(run.exit_code == 2);
    CHECK(run.err.find("a sensor has nothing to see of a display that is not there") != std::string::npos);
    CHECK(run.out.empty());

    const auto screen = VirtualScreen::start(640, 360, 24);
    const ProgramRun none =
        run_overt({"doctor", "--photodiode", "--sensor", "/dev/null", "--window"}, x_server_alone);
    CHECK(none.exit_code == 1);
    CHECK(none.err.find("/dev/null is not a serial port") != std::string::npos);
}

TEST_CASE("the doctor writes what it found as a page with pictures, and replaces none", "[session]") {
    const TemporaryFolder folder;
    const std::filesystem::path page = folder.path() / "rig.md";
    const std::vector<std::string> call = {"doctor",    "--report",  page.string(), "--photodiode",
                                           "--sensor",  "simulated", "--context",   "osmesa",
                                           "--seconds", "3"};
    const ProgramRun run = run_overt(call, {});
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    const std::string text = text_of(page);
    for (const char* const words :
         {"# What this rig is", "## What is missing", "## What there is", "| processors |", "overt 0.",
          "| changes shown | 59 |", "](rig_latency.svg)", "`[display] latency_ms = 5.0"}) {
        CAPTURE(words);
        CHECK(text.find(words) != std::string::npos);
    }
    CHECK(text_of(folder.path() / "rig_latency.svg").find("<svg") != std::string::npos);
    CHECK(text.find("The screen's refreshes") == std::string::npos); // was not asked for

    const ProgramRun again = run_overt(call, {});
    CHECK(again.exit_code == 2);
    CHECK(again.err.find("is there already") != std::string::npos);
    CHECK(text_of(page) == text);
    const ProgramRun nowhere =
        run_overt({"doctor", "--report", (folder.path() / "no" / "rig.md").string()}, {});
    CHECK(nowhere.exit_code == 2);
    CHECK(nowhere.err.find("there is no folder") != std::string::npos);
}

TEST_CASE("the doctor's page has a screen's refreshes, flip by flip", "[session]") {
    const TemporaryFolder folder;
    const auto screen = VirtualScreen::start(640, 360, 24, folder.path().string());
    const std::filesystem::path page = folder.path() / "rig.md";
    const ProgramRun run =
        run_overt({"doctor", "--report", page.string(), "--window", "--seconds", "1"}, x_server_alone);
    INFO(run.out << run.err);
    REQUIRE(std::filesystem::exists(page)); // whatever it found there
    const std::string text = text_of(page);
    CHECK(text.find("## The screen's refreshes") != std::string::npos);
    CHECK(text.find("| vertical blank |") != std::string::npos);
    CHECK(text.find("](rig_refreshes.svg)") != std::string::npos);
    CHECK(std::filesystem::exists(folder.path() / "rig_refreshes.svg"));
}

TEST_CASE("the doctor names what is missing with what mends it", "[unit]") {
    const TemporaryFolder folder;
    const auto rules = folder.path() / "rules.d", cpus = folder.path() / "cpu";
    CHECK(udev_finding({rules}).remedy.find("sudo cp") == 0);
    std::filesystem::create_directories(rules);
    std::ofstream(rules / "70-overt.rules") << "#\n";
    CHECK(udev_finding({folder.path(), rules}).remedy.empty());

    CHECK(governor_findings(cpus).empty());
    const auto set = [&](const char* cpu, const char* governor) {
        std::filesystem::create_directories(cpus / cpu / "cpufreq");
        std::ofstream(cpus / cpu / "cpufreq/scaling_governor") << governor << "\n";
    };
    set("cpu0", "performance");
    REQUIRE(governor_findings(cpus).size() == 1);
    CHECK(governor_findings(cpus).front().remedy.empty());
    set("cpu1", "powersave");
    CHECK(governor_findings(cpus).front().finding == "performance, powersave");
    CHECK(governor_findings(cpus).front().remedy.find("cpupower") != std::string::npos);
}
