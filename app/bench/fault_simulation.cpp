#include "app/bench/fault_simulation.h"

#include <algorithm>
#include <cmath>

#include "devices/host/clocks.h"
#include "experiment/base/random.h"
#include "experiment/timing/refresh_ledger.h"
#include "experiment/timing/virtual_refresh.h"

namespace overt {

namespace {

constexpr double rates_hz[] = {60.0, 90.0, 120.0, 144.0, 240.0};

/// Frames a second that go into each of the rates.
double frame_rate_for(double refresh_hz) { return refresh_hz == 144.0 ? 36.0 : 30.0; }

/// A time that is no multiple of the interval: within a tenth of it, on which side it fell would be chance.
double between_refreshes_ms(RandomStream& random, double interval_ms) {
    const int whole = static_cast<int>(random.below(6));
    return (whole + random.uniform(0.1, 0.9)) * interval_ms;
}

/// Adds one fault to a script, and to what a true ledger says of it.
void add_fault(FaultScript& script, RandomStream& random, int refresh, double interval_ms) {
    DisplayFault fault{static_cast<DisplayFault::Kind>(random.below(4)), std::nullopt, refresh};
    switch (fault.kind) {
    case DisplayFault::Kind::late:
    case DisplayFault::Kind::stall: {
        fault.amount_ms = between_refreshes_ms(random, interval_ms);
        const auto missed = static_cast<int>(fault.amount_ms / interval_ms);
        if (missed > 0)
            script.misses.push_back(
                {refresh, missed,
                 fault.kind == DisplayFault::Kind::late ? MissCause::drawn_late : MissCause::asked_late});
        break;
    }
    case DisplayFault::Kind::skip:
        fault.refreshes = 1 + static_cast<int>(random.below(5));
        script.misses.push_back({refresh, fault.refreshes, MissCause::shown_late});
        break;
    case DisplayFault::Kind::stamp:
        // Beyond doubt: jitter ends at three standard deviations, and six count as wrong.
        fault.amount_ms = 0.1 + 12.0 * script.faults.jitter_sd_ms + random.uniform(0.0, 30.0);
        if (random.below(2) == 0)
            fault.amount_ms = -fault.amount_ms;
        script.wrong_stamps.push_back(refresh);
        break;
    }
    script.faults.given.push_back(fault);
}

} // namespace

FaultScript random_script(std::uint64_t seed, std::uint64_t index) {
    RandomStream random(seed, "fault script", index);
    FaultScript script;
    script.refresh_hz = rates_hz[random.below(5)];
    script.when_late = random.below(2) == 0 ? WhenLate::drop : WhenLate::stretch;
    script.faults.seed = index;
    script.faults.drift_ppm = random.uniform(-300.0, 300.0);
    script.faults.counts_refreshes = random.below(2) == 0;
    const double interval_ms = 1e3 / (script.refresh_hz * (1.0 + 1e-6 * script.faults.drift_ppm));
    // Without a count a stamp that is off by half an interval says another refresh: no more than 0.42.
    const double most_ms = script.faults.counts_refreshes ? 1.0 : std::min(1.0, 0.14 * interval_ms);
    script.faults.jitter_sd_ms = random.below(4) == 0 ? 0.0 : random.uniform(0.0, most_ms);
    // Farther apart than the most refreshes that pass because of one fault.
    int refresh = 0;
    for (int count = static_cast<int>(random.below(13)); count > 0; --count) {
        refresh += 12 + static_cast<int>(random.below(22));
        add_fault(script, random, refresh, interval_ms);
    }
    return script;
}

SimulatedPresentation simulate_presentation(const FaultScript& script) {
    Animation animation;
    animation.frame_rate_hz = frame_rate_for(script.refresh_hz);
    animation.when_late = script.when_late;
    SimulatedPresentation presentation;
    presentation.plan = make_page_cycle(animation, script.refresh_hz);
    VirtualClock clock;
    VirtualRefresh display(clock, script.refresh_hz, script.faults);
    RefreshLedger ledger(presentation.plan, script.when_late);
    clock.wait_until(clock.now() + std::chrono::milliseconds(1234));
    display.presentation_begins({}, 0);
    ledger.begin(0);
    std::int64_t onset = 0;
    while (!ledger.is_complete()) {
        const AnimationFrameIndex frame = ledger.next().frame;
        const AnimationFrameIndex before =
            presentation.flips.empty() ? frame : presentation.flips.back().shown;
        const FlipRecord& flip = ledger.enter(display.next());
        for (int i = 0; i < ledger.missed_count(); ++i)
            presentation.missed.push_back(ledger.missed(i));
        presentation.flips.push_back(flip);
        if (presentation.lit.empty())
            onset = display.last_lit();
        while (static_cast<std::int64_t>(presentation.lit.size()) < display.last_lit() - onset) {
            presentation.begins.push_back(
                display.time_of(onset + static_cast<std::int64_t>(presentation.lit.size())));
            presentation.lit.push_back(before);
        }
        presentation.begins.push_back(display.time_of(display.last_lit()));
        presentation.lit.push_back(frame);
    }
    return presentation;
}

LedgerFit fit_of(const SimulatedPresentation& presentation, const FaultScript& script) {
    return LedgerFit(presentation.flips, script.refresh_hz);
}

bool gives_back(const SimulatedPresentation& presentation, const FaultScript& script, const LedgerFit& fit) {
    const auto same_run = [](const MissedRun& a, const MissedRun& b) {
        return a.refresh_in_trial == b.refresh_in_trial && a.count == b.count && a.cause == b.cause;
    };
    if (!std::equal(fit.missed_runs().begin(), fit.missed_runs().end(), script.misses.begin(),
                    script.misses.end(), same_run))
        return false;
    std::vector<int> wrong;
    std::size_t refresh = 0;
    AnimationFrameIndex shown = fit.flips().front().shown;
    for (std::size_t i = 0; i < fit.flips().size(); ++i) {
        const FlipRecord& flip = fit.flips()[i];
        if (!fit.times()[i].is_consistent)
            wrong.push_back(flip.refresh_in_trial);
        for (; refresh < static_cast<std::size_t>(flip.refresh_in_trial); ++refresh) {
            if (refresh >= presentation.lit.size() || presentation.lit[refresh] != shown)
                return false;
        }
        shown = flip.shown;
        if (refresh >= presentation.lit.size() || presentation.lit[refresh++] != shown)
            return false;
    }
    return refresh == presentation.lit.size() && wrong == script.wrong_stamps;
}

bool accounts_for_all(const SimulatedPresentation& presentation) {
    std::vector<int> rows(static_cast<std::size_t>(presentation.plan.total_refreshes));
    const auto count = [&](int refresh) {
        if (refresh >= 0 && refresh < presentation.plan.total_refreshes)
            ++rows[static_cast<std::size_t>(refresh)];
    };
    for (const FlipRecord& flip : presentation.flips)
        count(flip.refresh_in_trial);
    for (const MissedRefresh& missed : presentation.missed)
        count(missed.refresh_in_trial);
    return std::all_of(rows.begin(), rows.end(), [](int row) { return row == 1; });
}

} // namespace overt
