#include "experiment/statistics/scanpath_measures.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

using namespace overt;

namespace {

/// Fixations on a line.
FixationDistance on_line(const std::vector<double>& a, const std::vector<double>& b) {
    return [&a, &b](std::size_t i, std::size_t j) { return std::abs(a[i] - b[j]); };
}

std::vector<GazeStep> steps_on_line(const std::vector<double>& places) {
    std::vector<GazeStep> steps;
    for (std::size_t i = 1; i < places.size(); ++i)
        steps.push_back({std::abs(places[i] - places[i - 1]), places[i] - places[i - 1], 0.0, 0.0});
    return steps;
}

} // namespace

TEST_CASE("recurrence counts the pairs that are near, those that repeat a way, and how late they are",
          "[unit]") {
    // Places A B C A B D: A and B come back, three fixations later, one after the other. Of 15 pairs two.
    const std::vector<int> places{0, 1, 2, 0, 1, 3};
    const auto near = [&](const std::vector<int>& of) {
        return [&of](std::size_t i, std::size_t j) { return of[i] == of[j]; };
    };
    const auto found = recurrence(places.size(), near(places));
    REQUIRE(found);
    CHECK(found->recurrence == Approx(2.0 / 15.0));
    CHECK(*found->determinism == 1.0);
    CHECK(*found->return_distance == Approx(3.0 / 5.0));
    // A B A C: one pair, that repeats no way.
    const std::vector<int> back{0, 1, 0, 2};
    CHECK(recurrence(back.size(), near(back))->determinism == 0.0);
    CHECK(*recurrence(back.size(), near(back))->return_distance == Approx(2.0 / 3.0));
    // Nothing comes back.
    const std::vector<int> ever_new{0, 1, 2};
    CHECK(recurrence(ever_new.size(), near(ever_new))->recurrence == 0.0);
    CHECK_FALSE(recurrence(ever_new.size(), near(ever_new))->determinism);
    CHECK_FALSE(recurrence(1, near(ever_new)));
    // Always the same place: all pairs, all in diagonals but the single one from first to last.
    const std::vector<int> same(4, 0);
    CHECK(recurrence(same.size(), near(same))->recurrence == 1.0);
    CHECK(*recurrence(same.size(), near(same))->determinism == Approx(5.0 / 6.0));
}

TEST_CASE("ScanMatch is 1 for the same places as long, and counts order and duration", "[unit]") {
    const std::vector<double> a{0.0, 10.0, 20.0}, reversed{20.0, 10.0, 0.0}, far{1000.0, 1000.0, 1000.0};
    const std::vector<double> even{0.2, 0.2, 0.2}, longer{0.2, 0.2, 0.6};
    const double threshold = 5.0, bin_s = 0.1;
    CHECK(*scan_match(even, even, on_line(a, a), threshold, bin_s) == Approx(1.0));
    // Places the other way round: only one of three can be aligned, two bins of six.
    CHECK(*scan_match(even, even, on_line(a, reversed), threshold, bin_s) == Approx(1.0 / 3.0));
    // Far places are left to gaps, which cost nothing.
    CHECK(*scan_match(even, even, on_line(a, far), threshold, bin_s) == Approx(0.0));
    // One lasts three times as long: six bins of ten are aligned.
    CHECK(*scan_match(even, longer, on_line(a, a), threshold, bin_s) == Approx(0.6));
    // A fifth of the threshold away throughout.
    const std::vector<double> beside{1.0, 11.0, 21.0};
    CHECK(*scan_match(even, even, on_line(a, beside), threshold, bin_s) == Approx(0.8));
    CHECK(*scan_match(even, longer, on_line(a, beside), threshold, bin_s) ==
          Approx(*scan_match(longer, even, on_line(beside, a), threshold, bin_s)));
    // The shortest fixation counts once.
    CHECK(*scan_match(std::vector{0.001}, std::vector{0.1}, on_line(a, a), threshold, bin_s) == Approx(1.0));
    CHECK_FALSE(scan_match({}, even, on_line(a, a), threshold, bin_s));
}

TEST_CASE("MultiMatch tells shape, length, direction, position and duration apart", "[unit]") {
    const std::vector<double> places{0.0, 10.0, 20.0, 10.0}, durations{0.2, 0.2, 0.2, 0.2};
    const std::vector<GazeStep> steps = steps_on_line(places);
    const double extent = 40.0;
    const GazeWay way{durations, steps};
    const auto same = multi_match(way, way, on_line(places, places), extent);
    REQUIRE(same);
    for (const double one : {same->shape, same->length, same->direction, same->position, same->duration})
        CHECK(one == Approx(1.0));
    // The same way elsewhere: position alone differs, by a quarter of the extent.
    const std::vector<double> elsewhere{10.0, 20.0, 30.0, 20.0};
    const auto moved =
        multi_match(way, {durations, steps_on_line(elsewhere)}, on_line(places, elsewhere), extent);
    CHECK(moved->position == Approx(0.75));
    CHECK(moved->shape == Approx(1.0));
    CHECK(moved->direction == Approx(1.0));
    // Fixations twice as long.
    const std::vector<double> twice(4, 0.4);
    CHECK(multi_match(way, {twice, steps}, on_line(places, places), extent)->duration == Approx(0.5));
    // One step against one at a right angle, as long: the difference of both is root 2 of its length.
    const std::vector<GazeStep> one{{10.0, 10.0, 0.0, 0.0}}, aside{{10.0, 0.0, 10.0, 0.0}};
    const std::vector<double> two(2, 0.2);
    const auto turned = multi_match({two, one}, {two, aside}, on_line(places, places), extent);
    CHECK(turned->direction == Approx(0.5));
    CHECK(turned->length == Approx(1.0));
    CHECK(turned->shape == Approx(1.0 - std::numbers::sqrt2 * 10.0 / 80.0));
    // Twice as long a step.
    const std::vector<GazeStep> long_step{{20.0, 20.0, 0.0, 0.0}};
    CHECK(multi_match({two, one}, {two, long_step}, on_line(places, places), extent)->length == Approx(0.75));
    CHECK_FALSE(multi_match({two, one}, {std::vector{0.2}, {}}, on_line(places, places), extent));
}
