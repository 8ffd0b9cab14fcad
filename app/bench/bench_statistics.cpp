#include <cmath>

#include <fmt/format.h>

#include "app/bench/bench_command.h"
#include "app/bench/statistics_studies.h"
#include "app/cli/progress_bar.h"

namespace overt {

namespace {

constexpr int all_studies = 500, quick_studies = 3;

BenchFigure figure_of(const StatisticsCount& count, const StatisticsSetting& setting, bool has_target) {
    const std::string of =
        fmt::format("{} observers, error {} deg, {}", setting.observers, setting.accuracy_deg,
                    setting.is_planted ? "odds of the head 1.8 in one material" : "materials alike");
    const double percent = 100.0 * count.share();
    if (count.is_p) {
        // With an effect of material, what finds it is power; what does not concern it is no error either.
        if (setting.is_planted)
            return {fmt::format("p <= 0.05: {}; {}", count.what, of), percent, "%"};
        const double error = 100.0 * std::sqrt(0.05 * 0.95 / count.studies);
        const double bound = 5.5 + 2.0 * error; // two standard errors of the simulation
        return has_target ? at_most(fmt::format("p <= 0.05: {}; {}", count.what, of), percent, "%", bound)
                          : BenchFigure{fmt::format("p <= 0.05: {}; {}", count.what, of), percent, "%"};
    }
    BenchFigure figure{fmt::format("truth in an interval of 95 %: {} (mean {:.4g}, truth {:.4g}); {}",
                                   count.what, count.mean, count.truth, of),
                       percent, "%"};
    if (has_target) {
        const double error = 100.0 * std::sqrt(0.05 * 0.95 / count.studies);
        figure.target = fmt::format("{:.1f} to {:.1f}", 92.0 - error, 98.0 + error);
        figure.holds = percent >= 92.0 - error && percent <= 98.0 + error;
    }
    return figure;
}

} // namespace

BenchFigures bench_statistics(const BenchOptions& options) {
    BenchFigures figures;
    const int studies = options.studies > 0 ? options.studies
                        : options.is_quick  ? quick_studies
                                            : all_studies;
    // Of a few studies bounds of two standard errors of the simulation mean nothing.
    constexpr int least_for_targets = 20;
    constexpr int settings = 8;
    ProgressBar bar;
    int done = 0;
    for (const int observers : {6, 12}) {
        for (const double accuracy_deg : {0.3, 0.6}) {
            for (const bool is_planted : {false, true}) {
                const StatisticsSetting setting{observers, accuracy_deg, is_planted};
                const auto counts = count_statistics(setting, studies, 1, [&](int of_setting) {
                    bar.update("studies", done + of_setting, settings * studies);
                });
                done += studies;
                for (const StatisticsCount& count : counts)
                    figures.push_back(figure_of(count, setting, studies >= least_for_targets));
            }
        }
    }
    bar.finish();
    return figures;
}

} // namespace overt
