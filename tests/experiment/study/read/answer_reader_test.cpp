/// Times that steps draw from a list are levels of a factor of the answers.
#include "experiment/study/read/answer_reader.h"

#include <catch2/catch.hpp>

using namespace overt;

namespace {

StudyAnswer answer_of(int session, int trial, const std::string& task = "match") {
    StudyAnswer answer;
    answer.task = task;
    answer.session = session;
    answer.trial = trial;
    return answer;
}

AttemptStep step_of(const std::string& kind, std::optional<double> drawn_s) {
    AttemptStep step;
    step.kind = kind;
    step.drawn_s = drawn_s;
    return step;
}

} // namespace

TEST_CASE("a step that takes a few times gives a factor, by session and trial", "[unit]") {
    std::vector<StudyAnswer> answers;
    StepsOfTrials steps;
    // Two sessions of four trials, whose numbers are the same and whose times are not.
    for (int session = 0; session < 2; ++session)
        for (int trial = 1; trial <= 4; ++trial) {
            const double blank = (trial + session) % 2 == 0 ? 0.5 : 8.0, second = trial <= 2 ? 1.0 : 2.0;
            answers.push_back(answer_of(session, trial));
            steps[{session, trial}] = {step_of("fixation", 0.5), step_of("blank", blank), step_of("show", {}),
                                       step_of("blank", second), step_of("mask", 0.1 * trial + session)};
        }
    add_drawn_times(answers, steps);
    CHECK(answers[0].level("blank_s") == "8");
    CHECK(answers[1].level("blank_s") == "0.5");
    CHECK(answers[4].level("blank_s") == "0.5");
    CHECK(answers[0].level("blank_s_2") == "1");
    CHECK(answers[3].level("blank_s_2") == "2");
    // One time alone is no factor, nor are times of which each comes once, as from a range.
    CHECK(answers[0].level("fixation_s").empty());
    CHECK(answers[0].level("mask_s").empty());
    CHECK(answers[0].levels.size() == 2);
}

TEST_CASE("times of one task are none of another, and an answer twice in a trial is of one trial", "[unit]") {
    std::vector<StudyAnswer> answers{answer_of(0, 1), answer_of(0, 1), answer_of(0, 2), answer_of(0, 2),
                                     answer_of(0, 3, "other")};
    const StepsOfTrials steps{{{0, 1}, {step_of("blank", 1.0)}},
                              {{0, 2}, {step_of("blank", 2.0)}},
                              {{0, 3}, {step_of("blank", 1.0)}}};
    add_drawn_times(answers, steps);
    // Each time was drawn for one trial only.
    for (const StudyAnswer& one : answers)
        CHECK(one.levels.empty());
}
