#include "experiment/procedures/staircase.h"
#include "experiment/proving/known_table.h"

#include <fmt/format.h>

#include "known_answer_tables.h"

namespace overt {

namespace {

struct StaircaseCase {
    std::string_view name;
    StaircaseSettings settings;
    double last_six, next; ///< mean of the last six reversals, arithmetic; level after the trace
};

std::vector<StaircaseCase> staircase_cases() {
    const auto settings = [](double start, int up, int down, std::vector<double> steps, int trials) {
        StaircaseSettings made;
        made.start = start;
        made.up_after = up;
        made.down_after = down;
        made.steps = std::move(steps);
        made.trials = trials + 1; // one more than the trace, so that its next level can be asked for
        return made;
    };
    std::vector<StaircaseCase> cases{{"S1", settings(0.5, 1, 3, {8, 4, 4, 2}, 25), 0.012813, 0.0125893},
                                     {"S2", settings(20, 1, 2, {4, 2, 1}, 30), 2.0, 1.0},
                                     {"S3", settings(20, 1, 3, {2}, 30), 18.666667, 18.0},
                                     {"S4", settings(4, 1, 1, {2}, 22), 2.666667, 0.0},
                                     {"S5", settings(10, 2, 2, {1}, 22), 9.333333, 9.0}};
    cases[0].settings.scale = StepScale::db;
    cases[0].settings.lowest = 0.01;
    cases[0].settings.highest = 1.0;
    cases[1].settings.lowest = 0.0;
    cases[1].settings.highest = 40.0;
    cases[2].settings.initial_rule = cases[4].settings.initial_rule = false;
    cases[3].settings.lowest = 0.0;
    cases[3].settings.highest = 6.0;
    return cases;
}

} // namespace

KnownAnswers known_staircases() {
    KnownAnswers answers;
    const KnownTable traces(embedded::staircase_traces_csv);
    for (const StaircaseCase& one : staircase_cases()) {
        Staircase staircase(one.settings);
        WorstAnswer levels(fmt::format("staircase {}: level", one.name), 1e-9);
        WorstAnswer reversals(fmt::format("staircase {}: reversal or none", one.name), 0.0);
        std::vector<double> turned;
        for (std::size_t row = 0; row < traces.size(); ++row) {
            if (traces.text(row, "case") != one.name)
                continue;
            const double level = staircase.next().value_or(NAN);
            levels.add(traces.number(row, "level"), level);
            staircase.tell(level, traces.number(row, "response") > 0.5 ? TrackAnswer::yes : TrackAnswer::no);
            reversals.add(traces.number(row, "reversal"), staircase.state().has_reversed ? 1.0 : 0.0);
            if (staircase.state().has_reversed)
                turned.push_back(level);
        }
        answers.push_back(levels.answer());
        answers.push_back(reversals.answer());
        double sum = 0.0;
        for (std::size_t i = turned.size() - std::min<std::size_t>(turned.size(), 6); i < turned.size(); ++i)
            sum += turned[i] / 6.0;
        answers.push_back(
            {fmt::format("staircase {}: mean of the last 6 reversals", one.name), one.last_six, sum, 5e-7});
        answers.push_back({fmt::format("staircase {}: next level", one.name), one.next,
                           staircase.next().value_or(NAN), 5e-8});
        if (one.name == "S1")
            answers.push_back({"staircase S1: geometric mean of the last 6 reversals", 0.012589,
                               staircase.mean_of_reversals().value_or(NAN), 5e-7});
    }
    constexpr double targets[3][4] = {{0.5, 0.707107, 0.793701, 0.840896},
                                      {0.292893, 0.5, 0.604450, 0.668260},
                                      {0.206299, 0.395550, 0.5, 0.567329}};
    WorstAnswer equal("up-down target, n up m down, equal steps", 1e-6);
    for (int up = 1; up <= 3; ++up)
        for (int down = 1; down <= 4; ++down)
            equal.add(targets[up - 1][down - 1], staircase_target(up, down, 1.0, 1.0));
    answers.push_back(equal.answer());
    WorstAnswer unequal("up-down target, unequal steps", 1e-6);
    constexpr double ratios[4] = {0.2845, 0.5488, 0.7393, 0.8415};
    constexpr double reached[4] = {0.778513, 0.803530, 0.831525, 0.858434};
    for (int down = 1; down <= 4; ++down)
        unequal.add(reached[down - 1], staircase_target(1, down, 1.0, ratios[down - 1]));
    answers.push_back(unequal.answer());
    answers.push_back(
        {"weighted up-down target, steps 3 to 1", 0.75, staircase_target(1, 1, 3.0, 1.0), 1e-9});
    return answers;
}

} // namespace overt
