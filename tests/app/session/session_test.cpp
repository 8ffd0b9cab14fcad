/// Whole sessions through the program, headless and in virtual time.
#include <catch2/catch.hpp>

#include "experiment/animation.h"
#include "experiment/record/read/session_record.h"
#include "tests/app/small_experiment.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;

namespace {

/// What a presentation of an animation has to be in the flip ledger: every refresh, in order, none missed,
/// each frame lit for as many refreshes as the rates say.
void check_ledger(const std::vector<FlipRecord>& flips, const Animation& animation, double refresh_hz) {
    const int held = refreshes_per_frame(animation.frame_rate_hz, refresh_hz);
    REQUIRE(flips.size() == static_cast<std::size_t>(animation.shown_frame_count() * held));
    int wrong = 0;
    for (std::size_t i = 0; i < flips.size(); ++i) {
        const FlipRecord& flip = flips[i];
        const int step = static_cast<int>(i) / held;
        const double since_onset_s = to_seconds(flip.report.vertical_blank - flips[0].report.vertical_blank);
        wrong += flip.refresh_in_trial != static_cast<int>(i) || flip.missed_refreshes != 0 ||
                 flip.report.refresh.value != flips[0].report.refresh.value + static_cast<std::int64_t>(i) ||
                 flip.shown != animation.frame_at_step(step) || flip.planned != flip.shown ||
                 std::abs(since_onset_s - static_cast<double>(i) / refresh_hz) > 2e-9;
    }
    CHECK(wrong == 0);
}

/// The samples of a trial are the ticks of the tracker's clock, without a gap, from before the presentation
/// to after it.
void check_samples(const SessionRecord& record, const TrialRecord& trial, double rate_hz, double duration_s) {
    const std::vector<GazeSample> samples = record.samples(trial);
    const std::optional<ClockMap> clock_map = record.clock_map(trial.sitting);
    REQUIRE(clock_map.has_value());
    int during = 0, gaps = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const SessionTime at = clock_map->to_session(samples[i].sampled_at).time;
        during += at >= trial.outcome.presentation_onset && at < trial.outcome.presentation_end;
        gaps += i > 0 && samples[i].sampled_at - samples[i - 1].sampled_at !=
                             TrackerClock::duration(static_cast<int>(1e6 / rate_hz));
    }
    CHECK(std::abs(during - rate_hz * duration_s) <= 2.0);
    CHECK(gaps == 0);
    // A tenth of a second before and after.
    CHECK(static_cast<double>(samples.size()) > rate_hz * (duration_s + 0.19));
}

} // namespace

TEST_CASE("a session records every trial, every refresh and every gaze sample", "[session]") {
    const SmallExperiment experiment;
    const ProgramRun run = experiment.run();
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(run.out.find("10 of 10 trials completed, 0 refreshes missed") != std::string::npos);

    const SessionRecord record(experiment.session());
    CHECK(record.damages() == std::vector<std::string>{});
    CHECK(record.closed_in_order());
    REQUIRE(record.trials().size() == small_trials);
    for (std::size_t i = 0; i < record.trials().size(); ++i) {
        const TrialRecord& trial = record.trials()[i];
        CHECK(trial.trial == record.header().schedule.trials[i]);
        CHECK(trial.status == TrialRecord::Status::completed);
        CHECK(trial.outcome.missed_refreshes == 0);
        CHECK(trial.outcome.drift.has_value());
        CHECK_FALSE(trial.outcome.answer.empty());
        check_ledger(record.flips(trial), record.header().animations[0], 120.0);
        check_samples(record, trial, 1000.0, 1.0);
    }
}

TEST_CASE("a presentation of the paper's animation is 240 frames, 960 refreshes and 8 s", "[session]") {
    std::string text = with(small_protocol, "frame_count = 31", "frame_count = 61");
    text = with(text, "duration_s = 1", "duration_s = 8");
    text = with(text, "rate_hz = 1000", "rate_hz = 2000");
    const SmallExperiment experiment(text);
    const ProgramRun run = experiment.run({"--trials", "2"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const SessionRecord record(experiment.session());
    const Animation& animation = record.header().animations[0];
    CHECK(animation.shown_frame_count() == 240);
    CHECK(record.header().poses.angles.size() == 31);
    REQUIRE(record.trials().size() == 2);
    for (const TrialRecord& trial : record.trials()) {
        const std::vector<FlipRecord> flips = record.flips(trial);
        CHECK(flips.size() == 960);
        check_ledger(flips, animation, 120.0);
        check_samples(record, trial, 2000.0, 8.0);
        CHECK(to_seconds(trial.outcome.presentation_end - trial.outcome.presentation_onset) ==
              Approx(8.0).margin(1e-8));
        // Each frame but the last, which only closes the loop, is shown once in each of four periods.
        std::vector<int> refreshes(61);
        for (const FlipRecord& flip : flips)
            ++refreshes[static_cast<std::size_t>(flip.shown.value)];
        CHECK(std::count(refreshes.begin(), refreshes.begin() + 60, 16) == 60);
        CHECK(refreshes[60] == 0);
    }
}

TEST_CASE("what a session says when it is shown and exported is what it holds", "[session]") {
    const SmallExperiment experiment;
    REQUIRE(experiment.run({"--trials", "3"}).exit_code == 0);
    const std::string session = experiment.session().string();
    const std::filesystem::path tables = experiment.folder().path() / "tables";

    const ProgramRun exported = experiment.overt({"export", session, "--out", tables.string()});
    INFO(exported.err);
    REQUIRE(exported.exit_code == 0);
    const TsvFile trials(tables / "trials.tsv"), flips(tables / "flips.tsv"), samples(tables / "samples.tsv");
    REQUIRE(trials.size() == 3);
    CHECK(flips.size() == 3 * 120);
    long sample_count = 0;
    for (std::size_t i = 0; i < trials.size(); ++i) {
        CHECK(trials.text(i, "status") == "completed");
        CHECK(trials.integer(i, "shown_refreshes") == 120);
        CHECK(trials.integer(i, "missed_refreshes") == 0);
        CHECK(trials.integer(i, "samples_off_plan") == 0);
        CHECK(trials.integer(i, "samples_on_object") > 500);
        sample_count += trials.integer(i, "samples");
    }
    CHECK(static_cast<long>(samples.size()) == sample_count);

    const ProgramRun again = experiment.overt({"export", session, "--out", tables.string()});
    CHECK(again.exit_code == 2);
    CHECK(experiment.overt({"export", session, "--out", tables.string(), "--overwrite"}).exit_code == 0);

    const ProgramRun shown = experiment.overt({"show", session, "--json"});
    CHECK(shown.exit_code == 0);
    CHECK(shown.out.find("\"shown_refreshes\": 120") != std::string::npos);
    const std::filesystem::path picture = experiment.folder().path() / "trial.png";
    CHECK(experiment.overt({"show", session, "--trial", "2", "--picture", picture.string()}).exit_code == 0);
    CHECK(std::filesystem::file_size(picture) > 10000);
}

TEST_CASE("sessions of one observer are numbered, and none is overwritten", "[session]") {
    const SmallExperiment experiment;
    const std::vector<std::string> one_trial{"--trials", "1"};
    CHECK(experiment.run(one_trial).exit_code == 0);
    CHECK(experiment.run(one_trial).exit_code == 0);
    CHECK(std::filesystem::exists(experiment.session(2) / "session.sqlite"));
    const std::string before = text_of(experiment.session(2) / "session.sqlite");
    const ProgramRun taken = experiment.run({"--trials", "1", "--session", "2"});
    CHECK(taken.exit_code == 2);
    CHECK(taken.err.find("exists already") != std::string::npos);
    CHECK(text_of(experiment.session(2) / "session.sqlite") == before);
}
