/// What was looked at before answers: known by hand, planted, and nothing where nothing is.
#include "experiment/study/answer_gaze.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/experiment/study/painted_study.h"

using namespace overt;
using namespace overt::test;

namespace {

/// Trials with two balls side by side, in front of which gaze is in the left one and behind in the right one;
/// what is chosen is told by `choose`, and looked at for `of_chosen` seconds at a time, the other for
/// `of_other`.
struct ChosenBalls {
    PaintedStudy study;

    ChosenBalls(int observers, int trials, const std::function<bool(int observer, int trial)>& is_left,
                double of_chosen, double of_other)
        : study(
              observers, 2, 6,
              [](int, int level, RandomStream& random) {
                  return near(level == 0 ? front : back, 0.15, random);
              },
              1, "rough", trials) {
        StudyResults& results = study.results;
        for (std::size_t t = 0; t < results.trials.size(); ++t) {
            StudyTrial& trial = results.trials[t];
            const int number = static_cast<int>(t) % trials + 1, place = static_cast<int>(t) / trials % 2;
            trial.number = number;
            trial.keys.push_back({"slot", place == 0 ? "left" : "right"});
            const bool is_chosen = is_left(trial.session, number) == (place == 0);
            for (std::size_t i = 0; i < trial.fixations; ++i) {
                StudyFixation& fixation = results.fixations[trial.first_fixation + i];
                // By turns on either side, the right one first.
                fixation.onset_s = 0.5 * (2.0 * static_cast<double>(i) + (place == 0 ? 1.0 : 0.0)) + 0.01;
                fixation.duration_s = is_chosen ? of_chosen : of_other;
            }
        }
        for (int observer = 0; observer < observers; ++observer)
            for (int number = 1; number <= trials; ++number) {
                StudyAnswer answer;
                answer.observer = results.sessions[static_cast<std::size_t>(observer)].observer;
                answer.task = "which";
                answer.answer = "glossier";
                answer.kind = "choice";
                answer.session = observer;
                answer.trial = number;
                answer.is_missed = false;
                answer.value = is_left(observer, number) ? "left" : "right";
                for (const char* const slot : {"left", "right"})
                    answer.shown.push_back({slot, {}, {}, 5.0});
                results.answers.given.push_back(std::move(answer));
            }
    }

    const GazeChoiceRow& choice(const std::string& measure, const std::string& area = "") {
        results().answers.gaze = answer_gaze(results());
        results().answers.gaze_choices = gaze_choices(results(), study.options);
        const auto found =
            std::ranges::find_if(results().answers.gaze_choices, [&](const GazeChoiceRow& row) {
                return row.of.observer.empty() && row.measure == measure && row.area == area;
            });
        REQUIRE(found != results().answers.gaze_choices.end());
        return *found;
    }
    StudyResults& results() { return study.results; }
};

/// Left in every other trial; which of them differs between observers.
bool by_turns(int observer, int trial) { return (observer + trial) % 2 == 0; }

} // namespace

TEST_CASE("what was looked at before an answer is told to the millisecond, and not what came after it",
          "[unit]") {
    ChosenBalls balls(
        1, 2, [](int, int) { return true; }, 0.4, 0.2);
    StudyResults& results = balls.results();
    // The press comes 0.1 s into the right ball's third fixation, at 2.01 s.
    for (AnsweredStimulus& shown : results.answers.given[0].shown)
        shown.until_answer_s = 2.11;
    results.answers.given[1].is_missed = true;
    const std::vector<AnswerGazeRow> rows = answer_gaze(results);
    // Of each ball the whole, the body and the head; of the missed answer nothing.
    REQUIRE(rows.size() == 6);
    const auto of = [&](const std::string& slot, const std::string& area) {
        return *std::ranges::find_if(
            rows, [&](const AnswerGazeRow& row) { return row.slot == slot && row.area == area; });
    };
    // Left: 0.51 and 1.51 s, 0.4 s each. Right: 0.01 and 1.01 s, 0.2 s each, and 0.1 s of the last.
    const AnswerGazeRow left = of("left", ""), right = of("right", "");
    CHECK(left.dwell_s == Approx(0.8));
    CHECK(right.dwell_s == Approx(0.5));
    CHECK(left.dwell_share.value() == Approx(0.8 / 1.3));
    // The last second begins at 1.11: 0.1 s of the right ball's second fixation, the left's second, and 0.1
    // s.
    CHECK(left.last_second_share.value() == Approx(0.4 / 0.6));
    CHECK(left.visits == 2);
    CHECK(right.visits == 3);
    CHECK(right.is_first);
    CHECK(right.is_last);
    CHECK_FALSE(left.is_first);
    CHECK(left.first_arrival_s.value() == Approx(0.51));
    CHECK(left.is_chosen.value());
    CHECK_FALSE(right.is_chosen.value());
    CHECK(of("left", "body").dwell_s == Approx(0.8));
    CHECK(of("left", "head").dwell_s == 0.0);
    CHECK_FALSE(of("left", "head").first_arrival_s);
    // Trials that are excluded tell nothing.
    for (StudyTrial& trial : results.trials)
        trial.excluded = true;
    CHECK(answer_gaze(results).empty());
}

TEST_CASE("observers who look longer at what they choose are found, and others are not", "[unit]") {
    ChosenBalls longer(8, 10, by_turns, 0.4, 0.2);
    const GazeChoiceRow found = longer.choice("dwell share");
    CHECK(found.value.value.value() == Approx(2.0 / 3.0).margin(0.02));
    CHECK(found.chance == Approx(0.5).margin(0.02));
    CHECK(found.p.value() == Approx(2.0 / 256.0));
    CHECK(found.observers == 8);
    CHECK(found.trials == 80);
    // Both stimuli of an answer are of one answer.
    CHECK(longer.choice("share of the time on the stimulus", "head").trials == 80);
    ChosenBalls alike(8, 10, by_turns, 0.3, 0.3);
    CHECK(alike.choice("dwell share").p.value() > 0.05);
    // Who always chooses one side, and always looks at it longer, says nothing of what goes with what.
    ChosenBalls one_side(
        8, 10, [](int, int) { return true; }, 0.4, 0.2);
    const GazeChoiceRow& side = one_side.choice("dwell share");
    CHECK(side.value.value.value() == Approx(2.0 / 3.0).margin(0.02));
    CHECK(side.chance == Approx(side.value.value.value()));
    CHECK(side.p.value() == 1.0);
}

TEST_CASE("maps before answers differ where gaze before them does, and nowhere else", "[unit]") {
    // The left ball, of which the front is looked at, is the chosen one in all trials but one of each
    // observer.
    ChosenBalls balls(
        8, 4, [](int, int trial) { return trial != 1; }, 0.3, 0.3);
    const ObjectFixationMaps maps = fixation_maps(balls.results(), balls.study.surfaces);
    const std::vector<DifferenceMap> found = answer_maps(balls.results(), maps, balls.study.options);
    REQUIRE(found.size() == 1);
    CHECK(found[0].column == "glossier");
    CHECK(found[0].a == "chosen");
    CHECK(found[0].b == "not chosen");
    CHECK(found[0].observers == 8);
    const auto significant = [](const DifferenceMap& map, double side) {
        return std::ranges::any_of(map.clusters, [&](const DifferenceMap::Cluster& cluster) {
            return cluster.p < 0.05 && cluster.centroid_mm.y * side > 50.0 && cluster.difference * side < 0.0;
        });
    };
    CHECK(significant(found[0], -1.0)); // the front more before chosen
    CHECK(significant(found[0], 1.0));  // the back less
    // Chosen by turns, whatever is looked at.
    ChosenBalls null(8, 4, by_turns, 0.3, 0.3);
    const ObjectFixationMaps null_maps = fixation_maps(null.results(), null.study.surfaces);
    const std::vector<DifferenceMap> none = answer_maps(null.results(), null_maps, null.study.options);
    REQUIRE(none.size() == 1);
    for (const DifferenceMap::Cluster& cluster : none[0].clusters)
        CHECK(cluster.p > 0.05);
    // Fixations after the answer have no part in it.
    for (StudyAnswer& answer : null.results().answers.given)
        for (AnsweredStimulus& shown : answer.shown)
            shown.until_answer_s = 0.005;
    CHECK(answer_maps(null.results(), null_maps, null.study.options).empty());
}
