#include "app/bench/bench_timing.h"

#include <algorithm>
#include <cmath>

#include "app/bench/fault_simulation.h"

namespace overt {

namespace {

constexpr std::uint64_t seed = 20191;
constexpr int scripts = 10000;
constexpr int sittings = 20;
constexpr int trials_of_sitting = 30;

void measure_reconstruction(BenchFigures& figures) {
    int given_back = 0, accounted = 0, misses = 0;
    for (int index = 0; index < scripts; ++index) {
        const FaultScript script = random_script(seed, static_cast<std::uint64_t>(index));
        const SimulatedPresentation presentation = simulate_presentation(script);
        given_back += gives_back(presentation, script, fit_of(presentation, script));
        accounted += accounts_for_all(presentation);
        for (const MissedRun& run : script.misses)
            misses += run.count;
    }
    figures.push_back(at_least("fault scripts given back exactly, of 10000", given_back, "", scripts));
    figures.push_back(
        at_least("presentations with a row for each refresh, of 10000", accounted, "", scripts));
    figures.push_back({"refreshes missed in these scripts", static_cast<double>(misses), ""});
}

/// A sitting of 30 trials at 120 Hz whose time stamps jitter by 1 ms.
void measure_onsets(BenchFigures& figures) {
    std::vector<double> onset_errors_ms, refresh_errors_ms;
    double covered = 0.0;
    for (int sitting = 0; sitting < sittings; ++sitting) {
        std::vector<SimulatedPresentation> simulated;
        std::vector<RefreshFit> lines;
        FaultScript script;
        script.faults.drift_ppm = 37.0;
        script.faults.jitter_sd_ms = 1.0;
        for (int trial = 0; trial < trials_of_sitting; ++trial) {
            script.faults.seed = static_cast<std::uint64_t>(sitting * trials_of_sitting + trial);
            simulated.push_back(simulate_presentation(script));
            lines.push_back(fit_of(simulated.back(), script).line());
        }
        const std::optional<KnownInterval> interval = common_interval(lines);
        for (const SimulatedPresentation& presentation : simulated) {
            const LedgerFit fit(presentation.flips, script.refresh_hz, interval);
            const auto error_ms = [&](std::size_t refresh) {
                return 1e3 * std::abs(to_seconds(fit.begin_of(static_cast<int>(refresh)).time -
                                                 presentation.begins[refresh]));
            };
            onset_errors_ms.push_back(error_ms(0));
            for (std::size_t refresh = 0; refresh < presentation.begins.size(); ++refresh)
                refresh_errors_ms.push_back(error_ms(refresh));
            covered += error_ms(0) <= 1e3 * to_seconds(fit.begin_of(0).uncertainty);
        }
    }
    const auto rms = [](const std::vector<double>& errors) {
        double squares = 0.0;
        for (const double error : errors)
            squares += error * error;
        return std::sqrt(squares / static_cast<double>(errors.size()));
    };
    std::sort(onset_errors_ms.begin(), onset_errors_ms.end());
    figures.push_back(
        at_most("onset with stamps of 1 ms jitter, RMS error", rms(onset_errors_ms), "ms", 0.1));
    figures.push_back(at_most("onset with stamps of 1 ms jitter, 99th percentile of errors",
                              onset_errors_ms[onset_errors_ms.size() * 99 / 100], "ms", 0.1));
    figures.push_back(
        at_most("any refresh with stamps of 1 ms jitter, RMS error", rms(refresh_errors_ms), "ms", 0.1));
    figures.push_back({"onsets within their stated uncertainty",
                       100.0 * covered / static_cast<double>(onset_errors_ms.size()), "%"});
}

} // namespace

void measure_timing(BenchFigures& figures) {
    measure_reconstruction(figures);
    measure_onsets(figures);
}

} // namespace overt
