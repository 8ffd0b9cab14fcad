#include "experiment/analysis/flip_history.h"

#include <vector>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "tests/support/motion_of.h"

using namespace overt;

namespace {

constexpr SessionDuration refresh_interval = std::chrono::milliseconds(10);
const ScanOut scan_out{std::chrono::microseconds(1700), 100.0, 600.0};
const SessionTime onset(SessionDuration(5'000'000'123));

/// 20 Hz on 100 Hz: each frame lasts five refreshes.
PageCycle plan_of_three_seconds() { return make_page_cycle(motion_of(61, 20.0, 3.0), 100.0); }

/// A presentation in which, before some refreshes, others went by: (refresh, how many).
struct Miss {
    int refresh, count;
};
std::vector<FlipRecord> present(const PageCycle& plan, const std::vector<Miss>& misses = {}) {
    std::vector<FlipRecord> flips;
    for (int refresh = 0; refresh < plan.total_refreshes;) {
        const PageCycleEntry& entry = plan.entry_at(refresh);
        int missed = 0;
        for (const Miss& miss : misses)
            missed += miss.refresh == refresh ? miss.count : 0;
        const int lit = refresh + missed;
        FlipRecord flip{4, lit, {}, entry.frame, entry.pose, {}};
        flip.report.refresh = {1000 + lit};
        flip.report.vertical_blank = onset + lit * refresh_interval;
        flip.missed_refreshes = missed;
        flips.push_back(flip);
        refresh = lit + 1;
    }
    return flips;
}

SessionDuration row_delay(double row_px) { return from_seconds(row_px / scan_out.screen_rows * 0.01); }

} // namespace

TEST_CASE("a sample lies on the frame whose light was on its row", "[unit]") {
    const PageCycle plan = plan_of_three_seconds();
    const auto flips = present(plan, {{17, 1}, {60, 4}, {61, 1}, {299, 1}});
    const FlipHistory history(flips, scan_out, plan);
    RandomStream random(1, "flip history test");
    int on_frame = 0;
    for (int i = 0; i < 20'000; ++i) {
        const SessionTime time = onset + from_seconds(random.uniform(-0.2, 3.3));
        const double row = random.uniform(0.0, 600.0);
        const auto found = history.frame_shown_at(time, row);
        const FlipRecord* lit = nullptr;
        for (std::size_t k = 0; k < flips.size(); ++k) {
            const SessionDuration delay = scan_out.latency + row_delay(row);
            const SessionTime from = flips[k].report.vertical_blank + delay;
            const SessionTime until =
                k + 1 < flips.size() ? flips[k + 1].report.vertical_blank + delay : from + refresh_interval;
            if (time >= from && time < until)
                lit = &flips[k];
        }
        REQUIRE(found.has_value() == (lit != nullptr));
        if (lit) {
            REQUIRE(found->frame == lit->shown);
            REQUIRE(found->pose == lit->pose);
            REQUIRE(found->refresh == lit->report.refresh);
            ++on_frame;
        }
    }
    CHECK(on_frame > 10'000);
}

TEST_CASE("the top row changes a refresh's light earlier than the bottom row", "[unit]") {
    const PageCycle plan = plan_of_three_seconds();
    const FlipHistory history(present(plan), scan_out, plan);
    const SessionTime change = onset + 5 * refresh_interval + scan_out.latency; // frame 1 comes up
    CHECK(history.frame_shown_at(change - SessionDuration(1), 0.0)->frame.value == 0);
    CHECK(history.frame_shown_at(change, 0.0)->frame.value == 1);
    CHECK(history.frame_shown_at(change, 300.0)->frame.value == 0);
    CHECK(history.frame_shown_at(change + refresh_interval / 2, 300.0)->frame.value == 1);
    CHECK(history.frame_shown_at(change + refresh_interval / 2, 599.0)->frame.value == 0);
}

TEST_CASE("gaze above and below the screen goes by the first and the last row", "[unit]") {
    const PageCycle plan = plan_of_three_seconds();
    const FlipHistory history(present(plan), scan_out, plan);
    for (int ms = 0; ms < 200; ++ms) {
        const SessionTime time = onset + std::chrono::milliseconds(ms);
        const auto frame = [&](double row) {
            const auto lit = history.frame_shown_at(time, row);
            return lit ? lit->frame.value : -1;
        };
        CHECK(frame(-500.0) == frame(0.0));
        CHECK(frame(5000.0) == frame(600.0));
    }
}

TEST_CASE("nothing is lit before the onset, after the end, or without flips", "[unit]") {
    const PageCycle plan = plan_of_three_seconds();
    const FlipHistory history(present(plan), scan_out, plan);
    const SessionTime first = onset + scan_out.latency;
    CHECK_FALSE(history.frame_shown_at(first - SessionDuration(1), 0.0));
    CHECK(history.frame_shown_at(first, 0.0));
    const SessionTime end = first + std::chrono::seconds(3);
    CHECK(history.frame_shown_at(end - SessionDuration(1), 0.0));
    CHECK_FALSE(history.frame_shown_at(end, 0.0));
    CHECK_FALSE(FlipHistory({}, scan_out, plan).frame_shown_at(first, 0.0));
    CHECK_FALSE(FlipHistory({}, scan_out, plan).is_off_plan(first, 0.0));
}

TEST_CASE("without a miss the plan agrees everywhere; with one exactly where the old frame stayed",
          "[unit]") {
    const PageCycle plan = plan_of_three_seconds();
    const auto off_plan_ms = [&](const std::vector<Miss>& misses) {
        const FlipHistory history(present(plan, misses), scan_out, plan);
        int count = 0;
        for (int i = 0; i < 3200; ++i)
            count += history.is_off_plan(onset + std::chrono::microseconds(1000 * i + 137), 250.0);
        return count;
    };
    CHECK(off_plan_ms({}) == 0);
    CHECK(off_plan_ms({{17, 1}}) == 0);  // in the middle of a frame: the same picture stays
    CHECK(off_plan_ms({{20, 1}}) == 10); // the old frame stays for one refresh more
    CHECK(off_plan_ms({{20, 3}}) == 30);
    // Late by a whole frame: frame 4 comes up when 5 is due, stays for one refresh, and 5 follows.
    CHECK(off_plan_ms({{20, 5}}) == 60);
    CHECK(off_plan_ms({{20, 1}, {100, 2}}) == 30);
}

TEST_CASE("blanks that are late by less than a microsecond are no deviation from the plan", "[unit]") {
    const PageCycle plan = plan_of_three_seconds();
    auto flips = present(plan);
    for (std::size_t i = 1; i < flips.size(); ++i)
        flips[i].report.vertical_blank += SessionDuration(i % 2 == 0 ? 900 : -900);
    const FlipHistory history(flips, scan_out, plan);
    for (int i = 1; i < 300; ++i) {
        const SessionTime change = onset + i * refresh_interval + scan_out.latency;
        for (int ns = -950; ns <= 950; ns += 50)
            CHECK_FALSE(history.is_off_plan(change + SessionDuration(ns), 0.0));
    }
}

TEST_CASE("between two shows nothing is lit, and each follows its own plan", "[unit]") {
    const PageCycle plan = plan_of_three_seconds(), still = cut_to(plan, 20, AnimationFrameIndex{7});
    const auto first = present(cut_to(plan, 100, {}));
    auto second = present(still);
    for (FlipRecord& flip : second) {
        flip.refresh_in_trial += 150;
        flip.report.vertical_blank += 150 * refresh_interval;
    }
    const FlipHistory::Show shows[] = {{first, cut_to(plan, 100, {})}, {second, still}};
    const FlipHistory history(shows, scan_out);
    const auto at = [&](int refresh) {
        return onset + refresh * refresh_interval + refresh_interval / 2 + scan_out.latency;
    };
    CHECK_FALSE(history.frame_shown_at(at(-1), 0.0));
    CHECK(history.frame_shown_at(at(99), 0.0)->frame == plan.entry_at(99).frame);
    CHECK_FALSE(history.frame_shown_at(at(100), 0.0));
    CHECK_FALSE(history.frame_planned_at(at(149), 0.0));
    CHECK_FALSE(history.is_off_plan(at(120), 0.0));
    CHECK(history.frame_shown_at(at(150), 0.0)->frame.value == 7);
    CHECK(history.frame_planned_at(at(169), 0.0)->value == 7);
    CHECK_FALSE(history.frame_shown_at(at(170), 0.0));
}
