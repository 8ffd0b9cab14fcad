#include "experiment/record/read/timing_report.h"

#include <catch2/catch.hpp>

using namespace overt;

namespace {

TrialTiming timing_of(std::vector<double> intervals_ms, bool counts) {
    TrialTiming timing;
    timing.intervals_ms = std::move(intervals_ms);
    timing.counts = counts;
    return timing;
}

} // namespace

TEST_CASE("intervals between flips are counted about whole refreshes, of the trials that count alone",
          "[unit]") {
    TimingReport report;
    report.nominal_interval_ms = 10.0;
    CHECK(interval_histogram(report).empty());
    report.trials = {timing_of({9.9, 10.1, 20.0}, true), timing_of({400.0}, false), timing_of({1e6}, true)};
    const std::vector<IntervalBin> bins = interval_histogram(report, 4);
    REQUIRE(bins.size() == 4 * 8 - 8 + 1); // from one interval to four
    for (std::size_t i = 0; i < bins.size(); ++i)
        CHECK(bins[i].count == (i == 0 ? 2 : i == 8 || i == 24 ? 1 : 0));
    for (const std::size_t whole : {0u, 8u, 24u})
        CHECK((bins[whole].from_ms + bins[whole].to_ms) / 2.0 ==
              Approx(10.0 + 10.0 * static_cast<double>(whole) / 8.0));
    CHECK(bins[1].from_ms == bins[0].to_ms);
}
