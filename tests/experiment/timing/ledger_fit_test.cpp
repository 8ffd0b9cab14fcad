#include "experiment/timing/ledger_fit.h"

#include <catch2/catch.hpp>

using namespace overt;
using namespace std::chrono_literals;

namespace {

constexpr SessionDuration blank_interval = 10ms;

/// Flips of a display that counts, each asked for and handed over so long before its refresh.
std::vector<FlipRecord> steady_flips(int count) {
    std::vector<FlipRecord> flips;
    for (int i = 0; i < count; ++i) {
        FlipRecord flip;
        flip.refresh_in_trial = i;
        flip.report.refresh = {1000 + i};
        flip.report.vertical_blank = SessionTime(1s) + i * blank_interval;
        flip.report.requested = flip.report.vertical_blank - 8ms;
        flip.report.swapped = flip.report.vertical_blank - 6ms;
        flip.report.source = VblankSource::virtual_display;
        flips.push_back(flip);
    }
    return flips;
}

/// The flip for refresh `aimed_at` comes `missed` refreshes late; it was asked for and handed over at these
/// times relative to the begin of the refresh that it was for.
std::vector<FlipRecord> with_a_late_one(int aimed_at, int missed, SessionDuration requested,
                                        SessionDuration swapped) {
    std::vector<FlipRecord> flips = steady_flips(60);
    flips.erase(flips.begin() + aimed_at, flips.begin() + aimed_at + missed);
    FlipRecord& late = flips[static_cast<std::size_t>(aimed_at)];
    const SessionTime due = SessionTime(1s) + aimed_at * blank_interval;
    late.missed_refreshes = missed;
    late.report.requested = due + requested;
    late.report.swapped = due + swapped;
    return flips;
}

} // namespace

TEST_CASE("a missed refresh has the cause that its times tell, and the margin to when it was due", "[unit]") {
    struct Case {
        SessionDuration requested, swapped;
        MissCause cause;
    };
    for (const Case& one : {Case{-8ms, -2ms, MissCause::shown_late}, Case{-8ms, 3ms, MissCause::drawn_late},
                            Case{12ms, 14ms, MissCause::asked_late}, Case{0ms, 1ms, MissCause::asked_late}}) {
        for (const int missed : {1, 3}) {
            const std::vector<FlipRecord> flips = with_a_late_one(20, missed, one.requested, one.swapped);
            const LedgerFit fit(flips, 100.0);
            REQUIRE(fit.missed_runs().size() == 1);
            const MissedRun run = fit.missed_runs().front();
            CHECK(run.refresh_in_trial == 20);
            CHECK(run.count == missed);
            CHECK(run.cause == one.cause);
            CHECK(run.margin == -one.swapped);
            CHECK(fit.begin_of(20).time == SessionTime(1s) + 20 * blank_interval);
        }
    }
    CHECK(LedgerFit(steady_flips(60), 100.0).missed_runs().empty());
}

TEST_CASE("what lies between two shows was not missed, by a display that counts no refreshes either",
          "[unit]") {
    std::vector<FlipRecord> flips = steady_flips(60);
    for (std::size_t i = 30; i < flips.size(); ++i) {
        flips[i].step = 3;
        flips[i].refresh_in_trial += 40;
        flips[i].report.vertical_blank += from_seconds(0.4);
        flips[i].report.requested += from_seconds(0.4);
        flips[i].report.swapped += from_seconds(0.4);
    }
    for (FlipRecord& flip : flips)
        flip.report.source = VblankSource::swap_return;
    CHECK(LedgerFit(flips, 100.0).missed_runs().empty());
    for (FlipRecord& flip : flips)
        flip.step = 1;
    CHECK(LedgerFit(flips, 100.0).missed_runs().size() == 1);
}
