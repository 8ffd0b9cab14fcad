/// Whole sessions whose simulated eye tracker does wrong what a script says: what becomes of the trial, and
/// what the record and the program say.
#include <catch2/catch.hpp>

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "experiment/ports/event_kinds.h"
#include "experiment/record/read/session_record.h"
#include "tests/app/small_experiment.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

/// Two trials of a second at 1000 Hz, with these faults.
struct Faulted {
    explicit Faulted(const std::string& faults, const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments{"--trials", "2", "--no-pictures", "--faults",
                                           experiment.folder().file("faults.toml", faults).string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        run = experiment.run(arguments);
        CHECK(experiment.overt({"verify", experiment.session().string()}).exit_code == 0);
    }
    SessionRecord record() const { return SessionRecord(experiment.session()); }
    std::vector<std::string> said(std::string_view kind) const {
        std::vector<std::string> details;
        for (const RecordedEvent& event : record().events())
            if (event.kind == kind)
                details.push_back(event.detail);
        return details;
    }
    std::vector<std::string> notes_of(std::size_t attempt) const {
        const SessionRecord read = record();
        std::vector<std::string> texts;
        read.read_gaze_events(read.trials()[attempt], [&](const GazeEvent& event) {
            if (event.kind == GazeEvent::Kind::note)
                texts.push_back(event.text);
        });
        return texts;
    }
    SmallExperiment experiment;
    ProgramRun run;
};

std::string fault(std::string_view kind, std::string_view keys) {
    return fmt::format("[[tracker-fault]]\nkind = \"{}\"\n{}\n", kind, keys);
}

using Strings = std::vector<std::string>;

} // namespace

TEST_CASE("what an eye tracker loses, delays or doubles is in the record, and the trial goes on",
          "[session]") {
    const Faulted sound("");
    REQUIRE(sound.run.exit_code == 0);
    const SessionRecord all = sound.record();
    const std::size_t count = all.samples(all.trials()[0]).size();
    REQUIRE(count > 1000);
    struct Case {
        std::string faults;
        std::size_t samples;
        Strings struck, notes, tracker;
    };
    const Case cases[] = {
        {fault("gap", "trial = 1\nat_s = 0.5\ns = 0.1"),
         count - 100,
         {"gap for 0.1 s at 0.5 s"},
         {"data lost (connection): 100 samples"},
         {}},
        {fault("garbage", "trial = 1\nat_s = 0.5\ns = 0.1"),
         count - 100,
         {"garbage for 0.1 s at 0.5 s"},
         {"data lost (unreadable): 100 samples"},
         {}},
        {fault("doubled", "trial = 1\nat_s = 0.5\ns = 0.1"),
         count,
         {"doubled for 0.1 s at 0.5 s"},
         {},
         {"100 samples came twice and were left out the second time"}},
        {fault("stall", "trial = 1\nat_s = 0.3\ns = 0.4"), count, {"stall for 0.4 s at 0.3 s"}, {}, {}},
        {fault("slow-start", "trial = 1\ns = 0.25"), count - 250, {"slow-start by 0.25 s"}, {}, {}},
    };
    for (const Case& with : cases) {
        CAPTURE(with.faults);
        const Faulted faulted(with.faults);
        CHECK(faulted.run.exit_code == 0);
        CHECK_THAT(faulted.run.out, Contains("2 of 2 trials completed"));
        const SessionRecord record = faulted.record();
        REQUIRE(record.trials().size() == 2);
        CHECK(record.samples(record.trials()[0]).size() == with.samples);
        CHECK(faulted.said(tracker_fault_event) == with.struck);
        CHECK(faulted.notes_of(0) == with.notes);
        Strings told = faulted.said(tracker_event);
        told.erase(told.begin()); // which tracker it is
        CHECK(told == with.tracker);
        // Whatever came late or is missing, the samples are in their order.
        const std::vector<GazeSample> samples = record.samples(record.trials()[0]);
        CHECK(std::ranges::is_sorted(samples, {}, &GazeSample::sampled_at));
    }
}

TEST_CASE("an eye that is not found is a loss of gaze, by which the protocol may repeat a trial",
          "[session]") {
    const Faulted faulted(fault("no-eye", "trial = 1\nat_s = 0.2\ns = 0.9"));
    CHECK(faulted.run.exit_code == 0);
    const SessionRecord record = faulted.record();
    const std::vector<GazeSample> samples = record.samples(record.trials()[0]);
    CHECK(std::ranges::count_if(samples, [](const GazeSample& sample) { return !sample.gaze; }) >= 900);
}

TEST_CASE("a trial without gaze says so where it counts, and comes again where the protocol repeats for it",
          "[session]") {
    struct Case {
        std::string faults;
        double share; ///< of its gaze that came, of a second and two leads
    };
    for (const Case& with : {Case{fault("no-eye", "trial = 1\nat_s = 0\ns = 30"), 0.0},
                             Case{fault("gap", "trial = 1\nat_s = 0.02\ns = 30"), 0.02},
                             Case{fault("garbage", "trial = 1\nat_s = 0.02\ns = 30"), 0.02}}) {
        CAPTURE(with.faults);
        const Faulted faulted(with.faults);
        CHECK(faulted.run.exit_code == 0);
        CHECK_THAT(faulted.run.err, Contains("eye tracker: gaze lost (trial 1)"));
        const SessionRecord record = faulted.record();
        REQUIRE(record.trials().size() == 2);
        CHECK(record.trials()[0].counts);
        CHECK(record.trials()[0].outcome.failure == "gaze lost");
        REQUIRE(record.trials()[0].outcome.gaze);
        CHECK(record.trials()[0].outcome.gaze->share() == Approx(with.share).margin(0.02));
        CHECK(record.trials()[1].outcome.gaze->share() > 0.7); // but for blinks
        const ProgramRun shown = faulted.experiment.overt({"show", faulted.experiment.session().string()});
        CHECK_THAT(shown.out, Contains("completed, gaze lost") && Contains("what went wrong: eye tracker"));
        CHECK_THAT(shown.out, Contains("THE EYE TRACKER'S FAULTS WERE SIMULATED"));
        CHECK_THAT(shown.out, !Contains("THE DISPLAY'S FAULTS"));
    }
    // The rule for lost gaze sees samples that never came, as it sees those without an eye.
    SmallExperiment repeats(
        with(small_protocol, "[screens]\n", "[repeat]\ngaze_lost = \"now\"\n\n[screens]\n"));
    const std::string file =
        repeats.folder().file("faults.toml", fault("gap", "trial = 1\nat_s = 0.1\ns = 30")).string();
    REQUIRE(repeats.run({"--trials", "2", "--no-pictures", "--faults", file}).exit_code == 0);
    const SessionRecord record(repeats.session());
    REQUIRE(record.trials().size() == 3);
    CHECK_FALSE(record.trials()[0].counts);
    CHECK(record.trials()[0].outcome.failure == "gaze lost");
}

TEST_CASE("a tracker that is lost ends the attempt, is connected and calibrated, and the trial comes again",
          "[session]") {
    struct Case {
        std::string faults;
        Strings lost;
    };
    for (const Case& with :
         {Case{fault("unplug", "trial = 1\nat_s = 0.5\nrefusals = 1"),
               {"", "the simulated eye tracker is unplugged"}},
          Case{fault("unplug", "trial = 1\nat_s = 0"), {"the simulated eye tracker is unplugged"}},
          Case{fault("stall", "trial = 1\nat_s = 0.1\ns = 30"), {""}}}) {
        CAPTURE(with.faults);
        const Faulted faulted(with.faults);
        CHECK(faulted.run.exit_code == 0);
        CHECK_THAT(faulted.run.out, Contains("2 of 2 trials completed"));
        CHECK(faulted.said(tracker_lost_event) == with.lost);
        CHECK(faulted.said(tracker_regained_event).size() == 1);
        CHECK(faulted.said(validation_event).size() == 2);
        const SessionRecord record = faulted.record();
        REQUIRE(record.trials().size() == 3);
        CHECK_FALSE(record.trials()[0].counts);
        CHECK(record.trials()[0].outcome.failure == "eye tracker lost");
        CHECK(record.trials()[1].counts);
        CHECK(record.trials()[2].counts);
        CHECK_THAT(faulted.run.err, Contains("eye tracker: ") && Contains("eye tracker lost (trial 1)"));
        const ProgramRun shown = faulted.experiment.overt({"show", faulted.experiment.session().string()});
        CHECK_THAT(shown.out,
                   Contains("  eye tracker lost  ") && !Contains("rejected") && !Contains("DISPLAY"));
    }
}

TEST_CASE("what the tracker's host asks for becomes of the trial, in words", "[session]") {
    const Faulted repeated(fault("repeat", "trial = 1\nat_s = 0.5"));
    CHECK(repeated.run.exit_code == 0);
    CHECK(repeated.record().trials().size() == 3);
    CHECK_THAT(repeated.said(operator_event),
               Catch::VectorContains(std::string("repeats the trial, at the eye tracker")));

    const Faulted skipped(fault("skip", "trial = 1\nat_s = 0.5"));
    CHECK_THAT(skipped.run.out, Contains("1 of 2 trials completed"));
    CHECK_THAT(skipped.said(operator_event),
               Catch::VectorContains(std::string("skips the trial, at the eye tracker")));

    const Faulted aborted(fault("abort", "trial = 1\nat_s = 0.5"));
    CHECK(aborted.run.exit_code == 1);
    CHECK(aborted.said(session_aborted_event) == Strings{"aborted at the eye tracker"});
}

TEST_CASE("a failed calibration is repeated, and another rate than the wished one is said", "[session]") {
    const Faulted faulted("[tracker]\ngranted_rate_hz = 500\n" + fault("calibration", "number = 1"));
    CHECK(faulted.run.exit_code == 0);
    CHECK(faulted.said(calibration_failed_event) == Strings{"the simulated eye tracker found no eye"});
    CHECK_THAT(faulted.run.err,
               Contains("the eye tracker samples at 500 Hz where the protocol wishes 1000 Hz"));
    CHECK(faulted.record().header().tracker.sample_rate_hz == 500.0);
}

TEST_CASE("a jump of the tracker's clock costs the attempt, and leaves the times of all others exact",
          "[session]") {
    const Faulted sound(""), faulted(fault("clock-jump", "trial = 1\nat_s = 0.5\nms = 300"));
    CHECK(faulted.run.exit_code == 0);
    const Strings said = faulted.said(tracker_clock_jumped_event);
    REQUIRE(said.size() == 1);
    // As far as two clocks of different rates are apart after some seconds.
    CHECK_THAT(said.front(), Catch::StartsWith("by +") && Catch::EndsWith("ms in the trial"));
    CHECK(std::stod(said.front().substr(3)) == Approx(300.0).margin(0.1));
    const SessionRecord record = faulted.record();
    REQUIRE(record.trials().size() == 3);
    CHECK_FALSE(record.trials()[0].counts);
    for (std::size_t i = 1; i < 3; ++i) {
        const auto map = record.clock_map(record.trials()[i]);
        const auto span = record.sample_span(record.trials()[i]);
        REQUIRE((map && span));
        const MappedTime first = map->to_session(span->first);
        CHECK(first.uncertainty < std::chrono::milliseconds(2));
        // Recording begins before the presentation, by the lead of the protocol.
        const TrialOutcome& outcome = record.trials()[i].outcome;
        CHECK(first.time < outcome.presentation_onset);
        CHECK(to_seconds(outcome.presentation_onset - first.time) < 0.3);
        CHECK(map->to_session(span->second).time > outcome.presentation_end);
    }
}

TEST_CASE("faults of a tracker that is not simulated are refused", "[session]") {
    const SmallExperiment experiment;
    const std::string faults =
        experiment.folder().file("faults.toml", fault("gap", "at_s = 0\ns = 1")).string();
    const ProgramRun run = experiment.run({"--trials", "1", "--faults", faults, "--tracker", "none"});
    CHECK(run.exit_code == 2);
    CHECK_THAT(run.err, Contains("simulated with one that is no hardware, and not with \"none\""));
}
