/// Whole sessions in real time with an eye tracker through a vendor's library, in whose place stands one made
/// for the tests.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <set>

#include "app/session/crash_guard.h"
#include "experiment/record/read/session_record.h"
#include "tests/app/small_experiment.h"
#include "tests/support/hurried_observer.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

/// The stand-in's display area is that of the protocol.
const std::vector<std::string> tobii = {fmt::format("OVERT_TOBII_LIBRARY={}", OVERT_STAND_IN_TOBII),
                                        "STAND_IN_TOBII_width_mm=272", "STAND_IN_TOBII_height_mm=96",
                                        "STAND_IN_TOBII_fault_at=3"};

ProgramRun run_with(const std::string& tracker, const SmallExperiment& experiment,
                    const std::vector<std::string>& arguments, std::vector<std::string> environment) {
    std::vector<std::string> all{"run",
                                 experiment.protocol().string(),
                                 "--observer",
                                 "P01",
                                 "--sessions",
                                 experiment.sessions().string(),
                                 "--seed",
                                 "7",
                                 "--context",
                                 "osmesa",
                                 "--tracker",
                                 tracker,
                                 "--trials",
                                 "2",
                                 "--simulate-observer",
                                 "5"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    for (std::string& option : hurried(2))
        all.push_back(std::move(option));
    return experiment.overt(all, std::move(environment));
}

ProgramRun run_with_tobii(const SmallExperiment& experiment, const std::vector<std::string>& arguments,
                          std::vector<std::string> environment = tobii) {
    return run_with("tobii", experiment, arguments, std::move(environment));
}

/// Of a host at which somebody calibrates.
const std::vector<std::string> eyelink = {fmt::format("OVERT_EYELINK_LIBRARY={}", OVERT_STAND_IN_EYELINK),
                                          "STAND_IN_EYELINK_operated=1"};

} // namespace

TEST_CASE(
    "each sitting of a session with an EyeLink leaves a file of its own, in the session and on the host",
    "[session][waits]") {
    const SmallExperiment experiment;
    const ProgramRun first =
        run_with("eyelink", experiment, {"--simulate-operator", "task screen@2+0=abort,yes"}, eyelink);
    INFO(first.out << first.err);
    REQUIRE(first.exit_code == 1);
    const ProgramRun second = run_with("eyelink", experiment, {"--resume"}, eyelink);
    INFO(second.out << second.err);
    REQUIRE(second.exit_code == 0);

    std::set<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(experiment.session()))
        if (entry.path().extension() == ".edf")
            files.insert(entry.path().stem().string());
    REQUIRE(files.size() == 2);
    for (const std::string& name : files) {
        CHECK(name.size() == 8);
        CHECK(name.substr(0, 2) == "01");
        // The operator is told the name on the host when the sitting begins.
        CHECK_THAT(first.out + second.out, Contains("its file " + name + ".EDF"));
    }
    CHECK(experiment.overt({"verify", experiment.session().string()}).exit_code == 0);
}

TEST_CASE("a library that crashes leaves a closed record, is named, and the session goes on",
          "[session][waits]") {
    const std::string when = GENERATE("crashes_recording", "crashes_in_transfer", "crashes_closing");
    CAPTURE(when);
    const SmallExperiment experiment;
    std::vector<std::string> crashing = eyelink;
    crashing.push_back("STAND_IN_EYELINK_" + when + "=1");
    crashing.push_back("OVERT_STATE=" + (experiment.folder().path() / "state").string());
    const ProgramRun crashed = run_with("eyelink", experiment, {}, crashing);
    INFO(crashed.out << crashed.err);
    CHECK(crashed.exit_code == 128 + SIGSEGV);
    const std::string library = std::filesystem::path(OVERT_STAND_IN_EYELINK).filename().string();
    CHECK_THAT(crashed.err,
               Contains("the program crashed: a segmentation fault in the vendor's library " + library));
    CHECK_FALSE(std::filesystem::exists(experiment.session() / "session.sqlite-wal"));
    const ProgramRun verified = experiment.overt({"verify", experiment.session().string(), "--json"});
    INFO(verified.out);
    CHECK(verified.exit_code == 0);
    CHECK_THAT(verified.out, Contains("\"state\": \"closed\"") && Contains("\"notes\": []"));
    CHECK_THAT(experiment.overt({"show", experiment.session().string()}).out,
               Contains("program crashed: a segmentation fault"));
    {
        const SessionRecord record(experiment.session());
        CHECK(record.closed_in_order());
        CHECK(record.damages() == std::vector<std::string>{});
        if (when == "crashes_recording") {
            REQUIRE_FALSE(record.trials().empty());
            CHECK(record.trials().back().status == TrialRecord::Status::interrupted);
        }
    }
    std::vector<std::string> sound = eyelink;
    sound.push_back(crashing.back());
    const ProgramRun resumed = run_with("eyelink", experiment, {"--resume"}, sound);
    INFO(resumed.out << resumed.err);
    // A file that was open or on its way is noted, and comes when the host is next reached.
    if (when != "crashes_closing") {
        CHECK_THAT(crashed.err, Contains("overt tracker fetch brings it"));
        const ProgramRun fetched = experiment.overt({"tracker", "fetch"}, sound);
        INFO(fetched.out << fetched.err);
        CHECK(fetched.exit_code == 0);
        CHECK_THAT(fetched.out, Contains(".edf, 100000 bytes"));
    }
    // All trials were done before a crash at the end; then there is nothing to go on with.
    CHECK(resumed.exit_code == (when == "crashes_recording" ? 0 : 2));
    CHECK(SessionRecord(experiment.session()).is_complete());
    CHECK(experiment.overt({"verify", experiment.session().string()}).exit_code == 0);
}

TEST_CASE("the library that was at work is the first one on the way to the fault", "[unit]") {
    const std::string maps =
        "1000-2000 r-xp 0 0:0 1 /usr/bin/overt\n3000-4000 r-xp 0 0:0 2 /lib/libc.so.6\n"
        "5000-6000 r-xp 0 0:0 3 /opt/a maker/libeyelink_core.so\n"
        "6000-7000 rw-p 0 0:0 3 /opt/a maker/libeyelink_core.so\n8000-9000 r-xp 0 0:0 0\n";
    const std::vector<std::string> vendors{"/opt/a maker/libeyelink_core.so"};
    CHECK(library_at_work(maps, {0x5001}, vendors) == vendors.front());
    // In the C library, called by the vendor's; data of the vendor's are no caller.
    CHECK(library_at_work(maps, {0x3001, 0x6100, 0x5fff, 0x1001}, vendors) == vendors.front());
    CHECK(library_at_work(maps, {0x3001, 0x6100, 0x1001}, vendors) == "/lib/libc.so.6");
    CHECK(library_at_work(maps, {0x0}, vendors).empty());
    CHECK(library_at_work(maps, {0x7000}, {}).empty());
    CHECK(library_at_work("nonsense", {}, vendors).empty());
}

TEST_CASE("a session with a Tobii is calibrated, recorded, verified and exported", "[session][waits]") {
    const SmallExperiment experiment(
        fmt::format("{}\n[calibration]\npoints = 3\n",
                    with(small_protocol, "rate_hz = 1000", "rate_hz = 300\neye = \"both\"")));
    const ProgramRun run = run_with_tobii(experiment, {});
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out + run.err, Contains("the tracker tells of a fault: the camera is hot"));

    const SessionRecord record(experiment.session());
    CHECK(record.header().tracker.name == "tobii");
    CHECK(record.header().tracker.sample_rate_hz == 300.0);
    CHECK_THAT(record.header().tracker.model, Contains("Glass 9000 SER1"));
    REQUIRE(record.trials().size() == 2);
    for (const TrialRecord& trial : record.trials()) {
        const auto samples = record.samples(trial);
        // 1 s and twice the lead of 0.1 s, at 300 Hz of two eyes.
        REQUIRE(std::abs(static_cast<double>(samples.size()) - 720.0) < 60.0);
        std::size_t valid = 0;
        for (const GazeSample& sample : samples)
            if (sample.gaze) {
                ++valid;
                CHECK(*sample.gaze == (sample.eye == Eye::left ? ScreenPoint{0.25 * 544, 0.75 * 192}
                                                               : ScreenPoint{272.0, 96.0}));
            }
        CHECK(valid * 100 > samples.size() * 90);
    }
    CHECK(experiment.overt({"verify", experiment.session().string()}).exit_code == 0);
    const ProgramRun shown = experiment.overt({"tracker", "show", experiment.session().string()});
    CHECK_THAT(shown.out, Contains("tracker, 3 points"));
    const std::filesystem::path out = experiment.folder().path() / "tables";
    CHECK(
        experiment.overt({"export", experiment.session().string(), "--format", "tsv", "--out", out.string()})
            .exit_code == 0);
}

TEST_CASE("a session with a Tobii whose screen is another, or that is not there, does not begin",
          "[session]") {
    const SmallExperiment experiment;
    const ProgramRun other = run_with_tobii(experiment, {}, {tobii.front()});
    CHECK(other.exit_code == 1);
    CHECK_THAT(other.err, Contains("698 x 393 mm") && Contains("272 x 96 mm"));
    std::vector<std::string> none = tobii;
    none.emplace_back("STAND_IN_TOBII_devices=0");
    const ProgramRun absent = run_with_tobii(experiment, {}, none);
    CHECK(absent.exit_code == 1);
    CHECK_THAT(absent.err, Contains("No eye tracker of Tobii's is found"));
    CHECK_FALSE(std::filesystem::exists(experiment.session()));
}
