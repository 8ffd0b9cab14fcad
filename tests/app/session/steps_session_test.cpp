/// Sessions whose trials have steps of their own: what is recorded of them, that a killed one goes on, and
/// that all comes out the same when it is presented again.
#include "tests/app/session/interrupted_run.h"

#include <algorithm>
#include <cmath>

#include "experiment/analysis/flip_history.h"
#include "experiment/base/whole_file.h"
#include "experiment/design/trial_plan.h"
#include "experiment/events/gaze_condition.h"
#include "tests/app/replay/replayed_session.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

constexpr std::string_view first_task = R"([[task]]
id = "face"
question = "Look at the face."
)";

/// The small experiment with one task, whose trials do this.
std::string stepped(std::string_view steps) {
    std::string text(small_protocol);
    text.resize(text.find("[[task]]"));
    return text + std::string(first_task) + "simulated_head_share = 1\nsteps = [\n" + std::string(steps) +
           "]\n";
}

constexpr std::string_view every_kind = R"(
  { text = "Next: {object}", id = "words", for_s = 0.5 },
  { fixation = { from = 0.3, to = 0.6 }, id = "jitter" },
  { fixation = { until = { gaze_within_deg = 1.5, for_s = 0.1, patience_s = 5 } }, id = "gate" },
  { show = "centre", for_s = 0.5 },
  { mask = 0.1 },
  { blank = [0.2, 0.4] },
  { answer = "spoken" },
  { feedback = { answered = "Thank you", missed = "Too slow" }, for_s = 0.3 },
)";

std::vector<std::string> step_kinds_of(const TrialRecord& trial) {
    std::vector<std::string> kinds;
    for (const AttemptStep& step : trial.outcome.steps)
        kinds.push_back(step.kind);
    return kinds;
}

constexpr double refresh_s = 1.0 / 120.0;

/// From the step's begin to its end, in refreshes.
double refreshes_lit(const AttemptStep& step) {
    return to_seconds(step.end.value() - step.begin.value()) / refresh_s;
}

} // namespace

TEST_CASE("each kind of step is recorded as it was planned and as it was lit", "[session]") {
    const SmallExperiment experiment(stepped(every_kind));
    const ProgramRun run = experiment.run();
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const SessionRecord record(experiment.session());
    REQUIRE(record.trials().size() == 4);
    std::vector<double> jitters;
    for (const TrialRecord& trial : record.trials()) {
        CHECK(trial.counts);
        CHECK(step_kinds_of(trial) == std::vector<std::string>{"text", "fixation", "fixation", "show", "mask",
                                                               "blank", "answer", "feedback"});
        const std::vector<AttemptStep>& steps = trial.outcome.steps;
        CHECK(steps[0].id == "words");
        CHECK(steps[0].planned_refreshes == 60);
        for (std::size_t i = 0; i < steps.size(); ++i) {
            CAPTURE(i, steps[i].kind);
            REQUIRE(steps[i].begin);
            REQUIRE(steps[i].end);
            if (i > 0)
                CHECK(*steps[i].begin >= *steps[i - 1].end);
            // A virtual display lights each step for the refreshes that were planned.
            if (steps[i].planned_refreshes && steps[i].kind != "feedback")
                CHECK(refreshes_lit(steps[i]) == Approx(*steps[i].planned_refreshes).margin(1e-3));
        }
        jitters.push_back(steps[1].drawn_s.value());
        CHECK(steps[1].planned_refreshes == refreshes_in(jitters.back(), 120.0));
        CHECK((jitters.back() >= 0.3 && jitters.back() < 0.6));
        CHECK(steps[1].ended_by == StepEnd::time);
        // Gaze is in the middle of the screen: the gate ends by the first piece that is long enough.
        CHECK(steps[2].ended_by == StepEnd::gaze);
        REQUIRE(steps[2].gaze_onset);
        CHECK(*steps[2].gaze_detected - *steps[2].gaze_onset == std::chrono::milliseconds(100));
        CHECK(steps[2].planned_refreshes == std::nullopt);
        // What follows in the recorded span follows without a dark refresh between.
        CHECK(*steps[3].begin == *steps[2].end);
        CHECK(*steps[4].begin == *steps[3].end);
        CHECK(*steps[3].begin == trial.outcome.presentation_onset);
        CHECK(*steps[3].end == trial.outcome.presentation_end);
        CHECK(trial.outcome.shown_refreshes == 60);
        CHECK(record.flips(trial).size() == 60);
        CHECK(steps[6].ended_by == StepEnd::answer);
        CHECK(*steps[6].end == trial.outcome.responded_at);
        CHECK((steps[5].drawn_s == 0.2 || steps[5].drawn_s == 0.4));
    }
    CHECK(std::ranges::adjacent_find(jitters) == jitters.end());
    // The plan of a presentation ends where its step does: nothing was off it.
    CHECK(experiment.overt({"verify", experiment.session().string()}).exit_code == 0);
    const ProgramRun again = replay(experiment);
    INFO(again.out << again.err);
    CHECK(again.exit_code == 0);
    CHECK_THAT(again.out, Contains("the replay is the same"));
    // A draw that was changed afterwards is named.
    change(experiment.session(), "UPDATE step SET drawn_s = drawn_s + 0.001 WHERE trial_id = 2 AND n = 2");
    CHECK(experiment.overt({"verify", experiment.session().string()}).exit_code == 1);
    const ProgramRun changed = replay(experiment);
    CHECK(changed.exit_code == 1);
    CHECK_THAT(changed.out, Contains("table step, trial 2"));
}

TEST_CASE("a killed session with steps goes on with the durations that it was drawn", "[session]") {
    const std::string long_ones =
        with(every_kind, "{ show = \"centre\", for_s = 0.5 }", "{ show = \"centre\", for_s = 20 }");
    const SmallExperiment experiment(stepped(long_ones)), whole(stepped(long_ones));
    REQUIRE(whole.run({"--trials", "3"}).exit_code == 0);
    make_interrupted_session(experiment, 1, {"--trials", "3"});
    REQUIRE(experiment.overt(run_arguments(experiment, "P01", {"--virtual-time", "--resume"})).exit_code ==
            0);
    const SessionRecord resumed(experiment.session()), uninterrupted(whole.session());
    CHECK(resumed.is_complete());
    for (const TrialRecord& trial : resumed.trials()) {
        if (!trial.counts)
            continue;
        const auto other = std::ranges::find_if(uninterrupted.trials(), [&](const TrialRecord& one) {
            return one.trial.index == trial.trial.index;
        });
        REQUIRE(step_kinds_of(trial) == step_kinds_of(*other));
        for (std::size_t i = 0; i < trial.outcome.steps.size(); ++i) {
            CHECK(trial.outcome.steps[i].drawn_s == other->outcome.steps[i].drawn_s);
            CHECK(trial.outcome.steps[i].planned_refreshes == other->outcome.steps[i].planned_refreshes);
        }
    }
    CHECK(experiment.overt({"verify", experiment.session().string()}).exit_code == 0);
    const ProgramRun again = replay(experiment);
    INFO(again.out << again.err);
    CHECK(again.exit_code == 0);
}

TEST_CASE("gaze on the head ends the presentation, and the record says the same of it", "[session]") {
    const SmallExperiment experiment(
        stepped("  { fixation = 0.3 },\n"
                "  { show = \"centre\", until = { gaze_on = \"head\", for_s = 0.05, patience_s = 0.9 } },\n"
                "  { answer = \"spoken\" },\n"));
    const ProgramRun run = experiment.run();
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const SessionRecord record(experiment.session());
    int by_gaze = 0;
    for (const TrialRecord& trial : record.trials()) {
        const AttemptStep& show = trial.outcome.steps[1];
        CHECK(trial.outcome.shown_refreshes == static_cast<int>(record.flips(trial).size()));
        if (show.ended_by != StepEnd::gaze) {
            CHECK(show.ended_by == StepEnd::patience);
            CHECK(trial.outcome.shown_refreshes == 108);
            continue;
        }
        ++by_gaze;
        CHECK(trial.counts);
        CHECK(trial.outcome.shown_refreshes < 108);
        // The step ended by the flip after the sample had come: at once, as trackers are late by
        // milliseconds.
        const SessionTime detected = record.clock_map(trial)->to_session(*show.gaze_detected).time;
        CHECK(*show.end > detected);
        CHECK(to_seconds(*show.end - detected) < 4 * refresh_s);
    }
    CHECK(by_gaze >= 3);
    CHECK(replay(experiment).exit_code == 0);
}

TEST_CASE("gaze that does not come leads to a drift check, or ends the attempt, as the step says",
          "[session]") {
    // Nobody looks there.
    const std::string elsewhere =
        "  { fixation = { until = { gaze_within_deg = 0.5, patience_s = 0.3, otherwise = "
        "\"OTHERWISE\" } }, right_deg = 12, id = \"gate\" },\n  { show = \"centre\" },\n";
    // The simulated observer looks at targets: it is sent there too late to wait.
    const auto outcome = [&](const std::string& otherwise) {
        const SmallExperiment experiment(stepped(with(elsewhere, "OTHERWISE", otherwise)));
        const ProgramRun run = experiment.run({"--trials", "1"});
        INFO(run.err);
        CHECK(run.exit_code == 0);
        return SessionRecord(experiment.session()).trials();
    };
    const std::vector<TrialRecord> going_on = outcome("continue");
    REQUIRE(going_on.size() == 1);
    CHECK(going_on[0].counts);
    CHECK(step_kinds_of(going_on[0]) == std::vector<std::string>{"fixation", "show"});
    CHECK(going_on[0].outcome.steps[0].ended_by == StepEnd::patience);
    CHECK(refreshes_lit(going_on[0].outcome.steps[0]) == Approx(36).margin(1e-3));

    const std::vector<TrialRecord> aborted = outcome("abort");
    CHECK(aborted.size() > 1);
    CHECK(aborted[0].outcome.failure == "rejected");
    CHECK(step_kinds_of(aborted[0]) == std::vector<std::string>{"fixation"});

    const std::vector<TrialRecord> checked = outcome("drift-check");
    const std::vector<std::string> kinds = step_kinds_of(checked[0]);
    REQUIRE(kinds.size() >= 3);
    CHECK(kinds[0] == "fixation");
    CHECK(kinds[1] == "drift_check");
    CHECK(kinds[2] == "fixation");
}

TEST_CASE("exports have a row and a message for each step, and none for the paper's trial", "[session]") {
    const SmallExperiment experiment(stepped(every_kind)), paper;
    REQUIRE(experiment.run({"--trials", "2"}).exit_code == 0);
    REQUIRE(paper.run({"--trials", "1"}).exit_code == 0);
    const auto exported = [](const SmallExperiment& of, const std::string& format) {
        const fs::path folder = of.folder().path() / format;
        const ProgramRun run =
            of.overt({"export", of.session().string(), "--format", format, "--out", folder.string()});
        INFO(run.err);
        CHECK(run.exit_code == 0);
        std::string all;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
            if (entry.path().filename().string().ends_with("_events.tsv") ||
                entry.path().extension() == ".asc")
                all += read_whole_file(entry.path());
        return all;
    };
    const std::string asc = exported(experiment, "asc");
    for (const char* const message :
         {"STEP fixation jitter", "STEP fixation gate", "STEP mask", "STEP blank", "STEP feedback"})
        CHECK_THAT(asc, Contains(message));
    CHECK_THAT(exported(paper, "asc"), !Contains("STEP"));
    const std::string events = exported(experiment, "bids");
    for (const char* const row : {"\tfixation\t", "\tmask\t", "\tblank\t", "\tfeedback\t", "\tpresentation\t",
                                  "\tresponse\t", "\tgate\t"})
        CHECK_THAT(events, Contains(row));
    const std::string of_paper = exported(paper, "bids");
    CHECK_THAT(of_paper, !Contains("\tfixation\t") && !Contains("\ttext\t") && !Contains("\tdrift_check\t"));
}

TEST_CASE("a step that shows one frame shows it still", "[session]") {
    const SmallExperiment experiment(stepped("  { show = \"centre\", frame = 7, for_s = 1.5 },\n"));
    REQUIRE(experiment.run({"--trials", "1"}).exit_code == 0);
    const SessionRecord record(experiment.session());
    const TrialRecord& trial = record.trials().front();
    const std::vector<FlipRecord> flips = record.flips(trial);
    CHECK(flips.size() == 180);
    for (const FlipRecord& flip : flips) {
        CHECK(flip.shown == AnimationFrameIndex{7});
        CHECK(flip.planned == AnimationFrameIndex{7});
    }
    CHECK(trial.outcome.steps.front().still_frame == 7);
    // The plan that readers go by is the step's: no gaze is off it.
    const FlipHistory history = record.flip_history(trial, record.ledger(trial));
    CHECK_FALSE(
        history.is_off_plan(trial.outcome.presentation_onset + std::chrono::milliseconds(1400), 90.0));
    CHECK(replay(experiment).exit_code == 0);
}

TEST_CASE("check tells the steps of each task, and where what they wait for is not there", "[session]") {
    const SmallExperiment experiment(stepped(every_kind));
    const ProgramRun run = experiment.overt({"check", experiment.protocol().string()});
    INFO(run.err);
    CHECK(run.exit_code == 0);
    CHECK_THAT(run.out,
               Contains("steps of task face:") &&
                   Contains("2. fixation jitter: a target to be looked at; 0.3 s (36 refreshes, 300.0 ms) "
                            "to 0.6 s (72 refreshes, 600.0 ms), drawn"));
    const SmallExperiment without(
        stepped("  { show = \"centre\", until = { gaze_on = \"tail\", patience_s = 1 } },\n"));
    const ProgramRun refused = without.overt({"check", without.protocol().string()});
    CHECK(refused.exit_code == 2);
    CHECK_THAT(refused.err, Contains("gaze_on: object \"bust\" has no area \"tail\"") &&
                                Contains("gaze_on: object \"tall\" has no area \"tail\"") &&
                                Contains("small.toml:64:42"));
}
