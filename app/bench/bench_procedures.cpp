#include <fmt/format.h>

#include "app/bench/bench_clock.h"
#include "app/bench/bench_command.h"
#include "experiment/procedures/quest_plus.h"
#include "experiment/proving/coverage_study.h"
#include "experiment/proving/known_answers.h"

namespace overt {

namespace {

/// A choice among 41 levels on a grid of 492 points: case A of the known answers.
double quest_plus_choice_ms() {
    QuestPlusSettings settings;
    for (int i = -40; i <= 0; ++i) {
        settings.levels.push_back(i);
        settings.threshold.values.push_back(i);
    }
    settings.slope.values = {2, 3, 4, 5};
    settings.lapse.values = {0.0, 0.02, 0.04};
    settings.trials = 101;
    QuestPlus track(settings);
    const double begin = thread_seconds();
    for (int i = 0; i < 100; ++i)
        track.tell(-18.0, i % 4 == 0 ? TrackAnswer::no : TrackAnswer::yes);
    return 1000.0 * (thread_seconds() - begin) / 100.0;
}

} // namespace

BenchFigures bench_procedures(const BenchOptions&) {
    BenchFigures figures;
    for (const KnownAnswer& one : known_answers())
        figures.push_back(
            {one.what, one.ours, "", fmt::format("{:.9g} +- {:.0e}", one.known, one.tolerance), one.holds()});
    constexpr int studies = 200;
    for (const CoverageStudy& one : coverage_studies(studies, 1)) {
        const double percent = 100.0 * one.share();
        figures.push_back(
            {fmt::format("truth in an interval of 95 %, {} simulated studies: {}", studies, one.what),
             percent, "%", "92 to 98", percent >= 92.0 && percent <= 98.0});
        figures.push_back({fmt::format("bias in SD of the estimate: {}", one.what), one.bias, ""});
    }
    figures.push_back(
        {"QUEST+: an answer and the next choice, 41 levels, 492 points", quest_plus_choice_ms(), "ms"});
    return figures;
}

} // namespace overt
