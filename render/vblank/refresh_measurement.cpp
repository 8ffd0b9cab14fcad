#include "render/vblank/refresh_measurement.h"

#include <algorithm>
#include <cmath>

#include "experiment/timing/refresh_fit.h"

namespace overt {
namespace {

/// Not measured: a driver needs some pictures to fall into step.
constexpr int flips_to_fall_into_step = 12;

constexpr int swaps_in_a_row = 24;

/// A swap that took less of a refresh than this waited for nothing.
constexpr double share_of_no_wait = 0.25;

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::vector<double> time_swaps(WindowContext& window, const Clock& clock) {
    std::vector<double> seconds;
    for (int i = 0; i < swaps_in_a_row; ++i) {
        const SessionTime before = clock.now();
        window.gl().Clear(GL_COLOR_BUFFER_BIT);
        window.swap_buffers();
        seconds.push_back(to_seconds(clock.now() - before));
    }
    window.gl().Finish();
    return seconds;
}

} // namespace

RefreshMeasurement summarise_refreshes(std::span<const FlipReport> flips) {
    RefreshMeasurement measured;
    measured.flips = static_cast<int>(flips.size());
    if (flips.size() < 3)
        return measured;
    // A source that fell silent on the way leaves those flips that only know their swap's return.
    measured.source = flips.back().source;
    const bool counted =
        std::ranges::all_of(flips, [](const FlipReport& flip) { return counts_refreshes(flip.source); });
    std::vector<StampedRefresh> stamps;
    std::vector<double> intervals_ns;
    for (const FlipReport& flip : flips) {
        stamps.push_back({flip.refresh.value, flip.vertical_blank});
        if (stamps.size() < 2)
            continue;
        const auto& before = stamps[stamps.size() - 2];
        measured.intervals_ms.push_back(1e3 * to_seconds(stamps.back().stamp - before.stamp));
        const auto refreshes =
            counted ? std::max<std::int64_t>(1, stamps.back().refresh - before.refresh) : 1;
        intervals_ns.push_back(static_cast<double>((stamps.back().stamp - before.stamp).count()) /
                               static_cast<double>(refreshes));
    }
    const double typical_ns = std::max(1.0, median(intervals_ns));
    const RefreshFit fit(stamps, 1e9 / typical_ns, counted);
    const KnownInterval interval = fit.interval();
    measured.mean_hz = 1e9 / interval.ns;
    measured.mean_se_hz = 1e9 * interval.uncertainty_ns / (interval.ns * interval.ns);
    measured.outliers = fit.inconsistent_count();

    double squares = 0.0;
    int singles = 0;
    for (std::size_t i = 1; i < stamps.size(); ++i) {
        const std::int64_t refreshes = fit.refresh_of(i) - fit.refresh_of(i - 1);
        measured.missed += static_cast<int>(std::max<std::int64_t>(0, refreshes - 1));
        if (refreshes != 1 || fit.is_inconsistent(i) || fit.is_inconsistent(i - 1))
            continue;
        const double off = static_cast<double>((stamps[i].stamp - stamps[i - 1].stamp).count()) - interval.ns;
        squares += off * off;
        ++singles;
    }
    measured.interval_sd_ms = singles > 0 ? 1e-6 * std::sqrt(squares / singles) : 0.0;
    return measured;
}

SwapBehaviour judge_swaps(std::span<const double> swap_s, double interval_s) {
    const auto waited = std::ranges::find_if(
        swap_s, [&](double seconds) { return seconds >= share_of_no_wait * interval_s; });
    // One that took long for another reason is not yet a swap that waits: those after it do, too.
    const double rest_s = [&] {
        double sum = 0.0;
        for (auto swap = waited; swap != swap_s.end(); ++swap)
            sum += *swap;
        return sum;
    }();
    const auto left = static_cast<double>(swap_s.end() - waited);
    SwapBehaviour behaviour;
    behaviour.at_once = static_cast<int>(waited - swap_s.begin());
    behaviour.wait = left >= 2.0 && rest_s >= 0.5 * left * interval_s;
    if (!behaviour.wait)
        behaviour.at_once = static_cast<int>(swap_s.size());
    return behaviour;
}

TimingFacts measure_timing(WindowContext& window, WindowDisplay& display, Clock& clock, double seconds,
                           const std::function<void(int done, int total)>& progress) {
    for (int i = 0; i < flips_to_fall_into_step; ++i)
        display.present_dark();
    display.take_swap_modes(); // the first pictures may be copied while a window comes up
    const SessionTime start = clock.now();
    const auto passed_s = [&] { return to_seconds(clock.now() - start); };
    const int total = std::max(1, static_cast<int>(std::ceil(seconds)));
    std::vector<FlipReport> flips;
    for (int shown = -1; passed_s() < seconds && !display.closed();) {
        flips.push_back(display.present_dark());
        if (const int now = static_cast<int>(passed_s()); now != shown)
            progress(shown = std::min(now, total - 1), total);
    }
    progress(total, total);

    TimingFacts facts;
    facts.swap_modes = display.take_swap_modes();
    facts.system = examine_window_system();
    facts.is_software = window.description().is_software;
    facts.measured = summarise_refreshes(flips);
    facts.blanks_are_real = display.blanks_are_real();
    facts.refused_sources = display.refused_sources();
    facts.output = examine_output(window.native());
    const double interval_s = facts.measured.mean_hz > 0.0 ? 1.0 / facts.measured.mean_hz : 1.0 / 60.0;
    facts.swaps = judge_swaps(time_swaps(window, clock), interval_s);
    // What was queued is lit before anything else is asked for.
    clock.wait_until(clock.now() + from_seconds(4.0 * interval_s));
    return facts;
}

} // namespace overt
