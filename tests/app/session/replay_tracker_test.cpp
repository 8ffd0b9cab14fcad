/// Sessions whose eye tracker plays a recording back.
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "experiment/ports/event_kinds.h"
#include "experiment/record/read/session_record.h"
#include "tests/app/small_experiment.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

std::vector<std::string> said(const SessionRecord& record, std::string_view kind) {
    std::vector<std::string> details;
    for (const RecordedEvent& event : record.events())
        if (event.kind == kind)
            details.push_back(event.detail);
    return details;
}

/// Where the gaze of each sample of a trial was, on the screen and on the surface.
struct GazeTable {
    GazeTable(const SmallExperiment& experiment, const std::filesystem::path& session,
              const std::string& name)
        : folder(experiment.folder().path() / name) {
        REQUIRE(experiment.overt({"export", session.string(), "--out", folder.string()}).exit_code == 0);
    }
    std::filesystem::path folder;
};

} // namespace

TEST_CASE("a session with the gaze of another has its samples, its validation and its surface points",
          "[session]") {
    const SmallExperiment experiment;
    REQUIRE(experiment.run({"--trials", "3"}).exit_code == 0);
    const std::string source = experiment.session().string();
    // The digits of an observer's name are the number in the schedule: the same stimuli in the same order.
    const ProgramRun run =
        experiment.run({"--trials", "3", "--observer", "Q01", "--tracker", "replay", "--address", source});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(experiment.overt({"verify", experiment.session(1, "Q01").string()}).exit_code == 0);

    const SessionRecord first(source), second(experiment.session(1, "Q01"));
    CHECK(second.header().tracker.name == "replay");
    CHECK(second.header().tracker.sample_rate_hz == first.header().tracker.sample_rate_hz);
    REQUIRE(second.trials().size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::vector<GazeSample> a = first.samples(first.trials()[i]),
                                      b = second.samples(second.trials()[i]);
        REQUIRE(a.size() == b.size());
        const auto moved = b.front().sampled_at - a.front().sampled_at;
        std::size_t different = 0;
        for (std::size_t k = 0; k < a.size(); ++k)
            different +=
                a[k].sampled_at + moved != b[k].sampled_at || a[k].eye != b[k].eye ||
                a[k].gaze.has_value() != b[k].gaze.has_value() || a[k].pupil_area != b[k].pupil_area ||
                (a[k].gaze && (a[k].gaze->x_px != b[k].gaze->x_px || a[k].gaze->y_px != b[k].gaze->y_px));
        CHECK(different == 0);
        CHECK(first.trials()[i].outcome.drift->value == second.trials()[i].outcome.drift->value);
    }
    REQUIRE(second.calibrations(1).size() == 1);
    CHECK(second.calibrations(1)[0].validation.mean_error.value ==
          first.calibrations(1)[0].validation.mean_error.value);
    CHECK_THAT(said(second, tracker_event).front(), Contains("replay, gaze of sub-P01_ses-01"));

    // Each sample met the same frame, and so the same place on the surface.
    const GazeTable one(experiment, source, "one"), other(experiment, experiment.session(1, "Q01"), "other");
    const TsvFile a(one.folder / "samples.tsv"), b(other.folder / "samples.tsv");
    REQUIRE(a.size() == b.size());
    long elsewhere = 0, on_surface = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        on_surface += a.text(i, "surface_x") != "n/a";
        for (const char* const column : {"frame", "surface_x", "surface_y", "surface_z"})
            elsewhere += a.text(i, column) != b.text(i, column);
    }
    CHECK(on_surface > 1000);
    CHECK(elsewhere == 0);
}

TEST_CASE("a recording without the trial, or with another stimulus, is said at the end", "[session]") {
    const SmallExperiment experiment;
    REQUIRE(experiment.run({"--trials", "1", "--no-pictures"}).exit_code == 0);
    const ProgramRun run = experiment.run({"--trials", "3", "--no-pictures", "--observer", "P03", "--tracker",
                                           "replay", "--address", experiment.session().string()});
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.out, Contains("2 trials of the recording had no gaze to be played back: 2, 3"));
    const SessionRecord record(experiment.session(1, "P03"));
    CHECK(record.samples(record.trials()[1]).empty());

    const ProgramRun unlike =
        experiment.run({"--trials", "1", "--no-pictures", "--observer", "P04", "--seed", "8", "--tracker",
                        "replay", "--address", experiment.session().string()});
    const SessionRecord seven(experiment.session()), eight(experiment.session(1, "P04"));
    REQUIRE(seven.header().schedule.trials[0].stimulus != eight.header().schedule.trials[0].stimulus);
    CHECK_THAT(unlike.out, Contains("1 trial showed another stimulus than the recording's: 1."));
}

TEST_CASE("an EyeLink recording is played back, with its own events", "[session]") {
    const SmallExperiment experiment;
    REQUIRE(experiment.run({"--trials", "2", "--no-pictures"}).exit_code == 0);
    const std::filesystem::path out = experiment.folder().path() / "asc";
    REQUIRE(
        experiment.overt({"export", experiment.session().string(), "--format", "asc", "--out", out.string()})
            .exit_code == 0);
    std::filesystem::path asc;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(out))
        if (entry.path().extension() == ".asc")
            asc = entry.path();
    REQUIRE_FALSE(asc.empty());
    const ProgramRun run = experiment.run({"--trials", "2", "--no-pictures", "--observer", "P03", "--tracker",
                                           "replay", "--address", asc.string()});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const SessionRecord first(experiment.session()), second(experiment.session(1, "P03"));
    for (std::size_t i = 0; i < 2; ++i) {
        const std::vector<GazeSample> a = first.samples(first.trials()[i]),
                                      b = second.samples(second.trials()[i]);
        // The new session may have stopped a refresh sooner or later than the recording.
        CHECK(std::abs(static_cast<long>(a.size()) - static_cast<long>(b.size())) < 20);
        std::size_t alike = 0;
        for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
            alike += a[k].gaze.has_value() == b[k].gaze.has_value() &&
                     (!a[k].gaze || std::abs(a[k].gaze->x_px - b[k].gaze->x_px) < 0.051);
        CHECK(alike == std::min(a.size(), b.size()));
        long fixations = 0;
        second.read_gaze_events(second.trials()[i], [&](const GazeEvent& event) {
            fixations += event.kind == GazeEvent::Kind::fixation;
        });
        CHECK(fixations > 0);
    }
    CHECK(second.event_origin(1).from == SessionRecord::EventOrigin::From::tracker);

    const ProgramRun none =
        experiment.run({"--trials", "1", "--no-pictures", "--observer", "P05", "--tracker", "replay",
                        "--address", experiment.protocol().string()});
    CHECK(none.exit_code == 2);
}
