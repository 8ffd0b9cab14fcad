/// Objects side by side: each sample of gaze belongs to the one it fell on.
#include <catch2/catch.hpp>

#include <map>
#include <string>

#include "experiment/record/read/session_record.h"
#include "tests/app/session/exact_sitting.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;

namespace {

std::string side_by_side() {
    std::string text(small_protocol);
    for (const char* const task : {"id = \"face\"", "id = \"clothes\"", "id = \"free\""})
        text = with(text, task, std::string(task) + "\nslots = [\"left\", \"right\"]");
    text = with(text, "rate_hz = 1000", "rate_hz = 2000");
    return text + "\n[[slot]]\nid = \"left\"\nright_deg = -7\nsize_deg = 6.4\n"
                  "[[slot]]\nid = \"right\"\nright_deg = 7\nup_deg = 0.5\nsize_deg = 4.6\n";
}

/// Two intervals at one place, the second with another object beside it; and the first again at the end.
std::string in_intervals() {
    std::string text(small_protocol);
    for (const char* const task : {"id = \"face\"", "id = \"clothes\"", "id = \"free\""})
        text = with(text, task,
                    std::string(task) + "\nslots = [\"first\", \"second\", \"left\"]\nsteps = [\n"
                                        "  { fixation = 0.3 },\n"
                                        "  { show = \"first\", for_s = 1.2 },\n"
                                        "  { mask = \"scrambled\", for_s = 0.4, cell_deg = 0.5 },\n"
                                        "  { show = [\"second\", \"left\"], for_s = 1.5, id = \"test\" },\n"
                                        "  { show = \"first\", for_s = 0.5, frame = 3 },\n"
                                        "  { answer = \"spoken\" },\n]");
    text = with(text, "rate_hz = 1000", "rate_hz = 2000");
    return text + "\n[[slot]]\nid = \"first\"\nright_deg = 5\nsize_deg = 6.4\n"
                  "[[slot]]\nid = \"second\"\nright_deg = 5\nsize_deg = 6.4\n"
                  "[[slot]]\nid = \"left\"\nright_deg = -5\nsize_deg = 5.2\n";
}

} // namespace

TEST_CASE("of objects shown one after the other at one place each sample is on the one that was lit",
          "[session]") {
    ExactSitting sitting(in_intervals());
    for (Trial& trial : sitting.schedule.trials) {
        REQUIRE(trial.beside.size() == 2);
        trial.beside[0].stimulus.object = 1 - trial.stimulus.object;
    }
    const std::filesystem::path tables = sitting.run();
    const SessionRecord record(sitting.folder);
    const std::size_t trials = sitting.schedule.trials.size();
    const char* const ids[] = {"first", "second", "left"};

    // Steps, and from when to when each slot was lit.
    for (const TrialRecord& trial : record.trials()) {
        const std::vector<AttemptStep>& steps = trial.outcome.steps;
        REQUIRE(steps.size() == 6);
        CHECK(steps[1].places == std::vector<int>{0});
        CHECK(steps[3].places == std::vector<int>{1, 2});
        CHECK(steps[1].end == steps[2].begin);
        CHECK(steps[3].end == steps[4].begin); // directly
        CHECK(trial.outcome.presentation_onset == *steps[1].begin);
        CHECK(trial.outcome.presentation_end == *steps[4].end);
        CHECK(trial.outcome.shown_refreshes == 144 + 180 + 60);
        const TrialRecord second = trial.seen_in(1);
        CHECK(second.outcome.presentation_onset == *steps[3].begin);
        CHECK(second.outcome.presentation_end == *steps[3].end);
        CHECK(second.outcome.shown_refreshes == 180);
        CHECK(trial.seen_in(0).outcome.shown_refreshes == 144 + 60);
        CHECK(trial.seen_in(0).lit_spans().size() == 2);
        int lit[3] = {}, last_refresh = -1;
        for (int place = 0; place < 3; ++place) {
            last_refresh = -1;
            for (const FlipRecord& flip : record.flips(trial.seen_in(static_cast<std::size_t>(place)))) {
                CHECK(flip.refresh_in_trial > last_refresh);
                last_refresh = flip.refresh_in_trial;
                CHECK(flip.shown == flip.planned);
                lit[place] += flip.shown != no_frame;
            }
        }
        CHECK(lit[0] == 144 + 60);
        CHECK(lit[1] == 180);
        CHECK(lit[2] == 180);
        const auto ledger = record.ledger(trial);
        REQUIRE(ledger);
        CHECK(ledger->fit.missed_runs().empty());
    }

    const TsvFile samples(tables / "samples.tsv");
    std::map<std::string, int> on_surface;
    int elsewhere = 0, missing = 0, invented = 0, misplaced = 0, on_another_frame = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (!samples.has(i, "x_px"))
            continue;
        const TrackerTime sampled_at{TrackerClock::duration(samples.integer(i, "tracker_time_us"))};
        const GazeTruth truth = sitting.observer.truth_at(sitting.tracker.session_time_at(sampled_at));
        const bool is_lit = truth.slot && truth.frame;
        if (samples.has(i, "frame") != is_lit ||
            (is_lit && samples.integer(i, "frame") != truth.frame->value)) {
            ++on_another_frame;
            continue;
        }
        misplaced += is_lit && samples.text(i, "slot") != ids[*truth.slot];
        const bool has_surface = samples.has(i, "surface_x");
        missing += truth.surface && !has_surface;
        invented += !truth.surface && has_surface;
        if (!truth.surface || !has_surface)
            continue;
        ++on_surface[samples.text(i, "slot")];
        const glm::dvec3 exported(samples.number(i, "surface_x"), samples.number(i, "surface_y"),
                                  samples.number(i, "surface_z"));
        elsewhere += glm::distance(exported, truth.surface->position) > 1e-6;
    }
    for (const char* const id : ids)
        CHECK(on_surface[id] > 2000);
    CHECK(misplaced == 0);
    CHECK(elsewhere == 0);
    CHECK(missing == 0);
    CHECK(invented == 0);
    CHECK(on_another_frame <= static_cast<int>(samples.size()) / 1000);

    const TsvFile flips(tables / "flips.tsv");
    std::map<std::string, std::size_t> of_slot;
    for (std::size_t i = 0; i < flips.size(); ++i)
        ++of_slot[flips.text(i, "slot")];
    CHECK(of_slot["first"] == 204 * trials);
    CHECK(of_slot["second"] == 180 * trials);
    const TsvFile steps(tables / "steps.tsv");
    CHECK(steps.text(3, "slots") == "second left");
}

TEST_CASE("of two objects side by side each sample is on the surface it fell on", "[session]") {
    ExactSitting sitting(side_by_side());
    // Another object at the right, and in some trials another material.
    for (Trial& trial : sitting.schedule.trials) {
        REQUIRE(trial.beside.size() == 1);
        trial.beside[0].stimulus.object = 1 - trial.stimulus.object;
        trial.beside[0].stimulus.material = trial.index % 2;
    }
    const std::filesystem::path tables = sitting.run();
    const TsvFile samples(tables / "samples.tsv");
    REQUIRE(samples.size() > 20000);
    const SessionRecord record(sitting.folder);
    // The record has the trials as they were planned, and what was shown.
    CHECK(record.header().schedule.trials == sitting.schedule.trials);
    for (const TrialRecord& trial : record.trials())
        CHECK(trial.trial == sitting.schedule.trials[static_cast<std::size_t>(trial.trial.index)]);

    int all_on_surface = 0, elsewhere = 0, missing = 0, invented = 0, misplaced = 0, on_another_frame = 0;
    std::map<std::string, int> on_surface;
    double last_s = -1.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const TrackerTime sampled_at{TrackerClock::duration(samples.integer(i, "tracker_time_us"))};
        const GazeTruth truth = sitting.observer.truth_at(sitting.tracker.session_time_at(sampled_at));
        CHECK(samples.number(i, "time_s") > last_s); // each once, in the order of time
        last_s = samples.number(i, "time_s");
        all_on_surface += samples.has(i, "surface_x");
        const auto number = static_cast<std::size_t>(samples.integer(i, "trial") - 1);
        const Trial& trial = sitting.schedule.trials.at(number);
        if (!samples.has(i, "x_px"))
            continue;
        const bool has_frame = samples.has(i, "frame");
        const bool is_in_slot = truth.shown.has_value() && truth.frame.has_value();
        if (has_frame != is_in_slot || (has_frame && samples.integer(i, "frame") != truth.frame->value)) {
            ++on_another_frame;
            continue;
        }
        if (truth.shown) {
            const PlacedStimulus shown = trial.shown(*truth.shown);
            const char* const slot = shown.slot == 0 ? "left" : "right";
            const char* const object = shown.stimulus.object == 0 ? "bust" : "tall";
            misplaced += samples.text(i, "slot") != slot || samples.text(i, "object") != object;
        } else if (truth.frame) {
            misplaced += samples.has(i, "slot") || samples.has(i, "object");
        }
        const bool has_surface = samples.has(i, "surface_x");
        missing += truth.surface && !has_surface;
        invented += !truth.surface && has_surface;
        if (!truth.surface || !has_surface)
            continue;
        ++on_surface[samples.text(i, "slot")];
        const glm::dvec3 exported(samples.number(i, "surface_x"), samples.number(i, "surface_y"),
                                  samples.number(i, "surface_z"));
        elsewhere += glm::distance(exported, truth.surface->position) > 1e-6;
    }
    CHECK(on_surface["left"] > 4000);
    CHECK(on_surface["right"] > 4000);
    CHECK(misplaced == 0);
    CHECK(elsewhere == 0);
    CHECK(missing == 0);
    CHECK(invented == 0);
    CHECK(on_another_frame <= static_cast<int>(samples.size()) / 1000);

    // A row for each presentation, and for each flip in each slot.
    const TsvFile presentations(tables / "presentations.tsv");
    REQUIRE(presentations.size() == 2 * sitting.schedule.trials.size());
    std::int64_t on_object = 0;
    for (std::size_t i = 0; i < presentations.size(); ++i) {
        CHECK(presentations.text(i, "slot") == (i % 2 == 0 ? "left" : "right"));
        on_object += presentations.integer(i, "samples_on_object");
    }
    CHECK(on_object == all_on_surface);
    const TsvFile flips(tables / "flips.tsv");
    std::map<std::string, int> of_slot;
    for (std::size_t i = 0; i < flips.size(); ++i)
        ++of_slot[flips.text(i, "slot")];
    CHECK(of_slot["left"] > 1000);
    CHECK(of_slot["left"] == of_slot["right"]);

    // A fixation lies in a slot or in none, and stands in the table once.
    const TsvFile events(tables / "gaze_events.tsv");
    int fixations = 0, in_slots = 0;
    for (std::size_t i = 0; i < events.size(); ++i) {
        if (events.text(i, "kind") != "fixation")
            continue;
        ++fixations;
        in_slots += events.has(i, "slot");
        if (events.has(i, "slot"))
            CHECK(events.text(i, "slot") == (events.number(i, "x_px") < 272.0 ? "left" : "right"));
    }
    CHECK(in_slots > 10);
    CHECK(in_slots < fixations);
}
