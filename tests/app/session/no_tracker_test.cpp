/// A session without an eye tracker: everything but gaze is recorded, and everything can be exported.
#include <catch2/catch.hpp>

#include "experiment/record/read/session_record.h"
#include "tests/app/small_experiment.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

TEST_CASE("a session without an eye tracker is recorded, verified and exported without gaze", "[session]") {
    const SmallExperiment experiment(with(small_protocol, "rate_hz = 1000", "kind = \"none\""));
    CHECK(experiment.overt({"check", experiment.protocol().string()}).exit_code == 0);
    const ProgramRun run = experiment.run({"--trials", "2"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("tracker: none") && Contains("2 of 2 trials completed"));
    CHECK_THAT(run.err, !Contains("drift check"));

    const std::string session = experiment.session().string();
    {
        const SessionRecord record(session);
        CHECK(record.header().tracker.name == "none");
        CHECK_FALSE(record.clock_map(1));
        for (const TrialRecord& trial : record.trials()) {
            CHECK(trial.counts);
            CHECK_FALSE(trial.outcome.drift);
            CHECK(record.samples(trial).empty());
            CHECK_FALSE(record.flips(trial).empty());
        }
        long calibrations = 0, validations = 0;
        for (const RecordedEvent& event : record.events()) {
            calibrations += event.kind == "calibration";
            validations += event.kind == "validation";
        }
        CHECK(calibrations == 1);
        CHECK(validations == 0);
    }
    CHECK(experiment.overt({"verify", session}).exit_code == 0);
    for (const std::string format : {"tsv", "csv", "jsonl", "bids", "asc"}) {
        const ProgramRun exported =
            experiment.overt({"export", session, "--format", format, "--out",
                              (experiment.folder().path() / ("export_" + format)).string()});
        CAPTURE(format, exported.err);
        // ASC holds nothing but gaze.
        CHECK(exported.exit_code == (format == "asc" ? 2 : 0));
        if (format == "asc")
            CHECK_THAT(exported.err, Contains("has neither gaze samples nor a tracker's own events"));
    }
}
