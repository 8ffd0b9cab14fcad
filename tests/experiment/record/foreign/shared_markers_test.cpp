#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/clock_map.h"
#include "experiment/record/foreign/shared_markers.h"

using namespace overt;

namespace {

/// The presenter's clock is 1000 s ahead and 50 ppm slower than the tracker's, which a marker reaches
/// `late_us` later.
struct TwoClocks {
    TrialLog log;
    GazeSurvey gaze;
};
TwoClocks two_clocks(const std::vector<int>& late_us) {
    TwoClocks clocks;
    clocks.gaze.first = tracker_time(5'000'000);
    clocks.gaze.last = tracker_time(405'000'000);
    for (std::size_t i = 0; i < late_us.size(); ++i) {
        const std::int64_t at_us = 10'000'000 + 40'000'000 * static_cast<std::int64_t>(i);
        const LogTime logged(1'000'000'000'000 + at_us * 1000 - at_us / 20); // 50 ns less in each millisecond
        clocks.log.markers.push_back(
            {fmt::format("log.csv:{}", i + 2), fmt::format("onset {}", i + 1), logged});
        clocks.gaze.marks.push_back(
            {tracker_time(at_us + late_us[i]), fmt::format("onset {}", i + 1), false});
        LoggedTrial trial;
        trial.onset = logged;
        clocks.log.trials.push_back(trial);
    }
    return clocks;
}

double bound_ms(const ClockRelation& relation) { return 1e-6 * static_cast<double>(relation.bound.count()); }

} // namespace

TEST_CASE("markers in both files relate a presenter's clock with the tracker's, and say how closely",
          "[unit]") {
    const TwoClocks exact = two_clocks({0, 0, 0, 0, 0, 0, 0, 0});
    const ClockRelation relation = relate_clocks(exact.log, exact.gaze, "log.csv");
    CHECK(bound_ms(relation) < 0.01);
    const ClockMap map(relation.pairs);
    // At 100 s of the tracker the presenter's clock showed this.
    const LogTime logged(1'000'000'000'000 + 100'000'000'000 - 5'000'000);
    CHECK(std::abs((map.to_session(tracker_time(100'000'000)).time - relation.session(logged)).count()) <
          5000);
    CHECK(map.to_session(exact.gaze.first).time > SessionTime());
    CHECK(relation.remarks.back().find("8 shared markers relate the clocks, which run apart by -50.0 ppm") ==
          0);
}

TEST_CASE("one marker that came late widens the bound, and is named", "[unit]") {
    const TwoClocks late = two_clocks({0, 0, 0, 9000, 0, 0, 0, 0});
    const ClockRelation relation = relate_clocks(late.log, late.gaze, "log.csv");
    // The line gives way by about an eighth of the 9 ms.
    CHECK(bound_ms(relation) > 7.0);
    CHECK(bound_ms(relation) < 9.0);
    CHECK(relation.remarks.back().find("(log.csv:5)") != std::string::npos);
    const ClockMap map(relation.pairs);
    CHECK(map.run_count() == 1);
    const MappedTime at = map.to_session(late.gaze.marks[6].at);
    const SessionDuration off = at.time - relation.session(late.log.markers[6].at);
    CHECK(std::abs(off.count()) < at.uncertainty.count());
}

TEST_CASE("markers of one text are paired in their order, and only where both files have as many", "[unit]") {
    TwoClocks clocks = two_clocks({0, 0, 0, 0});
    for (std::size_t i = 0; i < 4; ++i) {
        clocks.log.markers[i].text = i < 2 ? "go" : "stop";
        clocks.gaze.marks[i].text = i < 2 ? "KeyboardEvent go" : "stop"; // as Tobii puts the event before it
    }
    clocks.gaze.marks.push_back({tracker_time(399'000'000), "stop", false});
    const ClockRelation relation = relate_clocks(clocks.log, clocks.gaze, "log.csv");
    REQUIRE(relation.pairs.size() == 2);
    CHECK(relation.pairs[1].other == clocks.gaze.marks[1].at);
    CHECK(relation.remarks[0] ==
          "The marker \"stop\" is 2 times in the log and 3 times in the recording: it relates no times.");
    clocks.log.markers.resize(1); // "go" once, and twice in the recording
    CHECK_THROWS_AS(relate_clocks(clocks.log, clocks.gaze, "log.csv"), InputError);
}

TEST_CASE("a log without markers has the tracker's clock, or is refused", "[unit]") {
    TwoClocks clocks = two_clocks({0, 0, 0, 0});
    clocks.log.markers.clear();
    CHECK_THROWS_AS(relate_clocks(clocks.log, clocks.gaze, "log.csv"), InputError);
    for (std::size_t i = 0; i < 4; ++i)
        clocks.log.trials[i].onset = LogTime(clocks.gaze.marks[i].at.time_since_epoch());
    ClockRelation relation = relate_clocks(clocks.log, clocks.gaze, "log.csv");
    CHECK(ClockMap(relation.pairs).to_session(tracker_time(50'000'000)).time ==
          relation.session(LogTime(50'000'000'000)));
    // Onsets that count from the first sample, as those of BIDS.
    clocks.log.zero = clocks.gaze.first;
    for (LoggedTrial& trial : clocks.log.trials)
        trial.onset -= LogTime(clocks.gaze.first.time_since_epoch());
    relation = relate_clocks(clocks.log, clocks.gaze, "log.csv");
    CHECK(ClockMap(relation.pairs).to_session(tracker_time(50'000'000)).time ==
          relation.session(LogTime(45'000'000'000)));
    CHECK(relation.remarks.front() == "Times of log.csv count from the recording's first sample.");
    clocks.gaze.columns.start_s = -2.5;
    CHECK(relate_clocks(clocks.log, clocks.gaze, "log.csv").remarks.front() ==
          "Times of log.csv count so that the recording's first sample is at -2.5 s (StartTime).");
}
