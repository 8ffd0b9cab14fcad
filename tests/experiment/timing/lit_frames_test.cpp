/// What is known of the frame lit while a presentation runs is what its ledger says afterwards.
#include <catch2/catch.hpp>

#include "experiment/analysis/flip_history.h"
#include "experiment/base/random.h"
#include "experiment/timing/lit_frames.h"

using namespace overt;

TEST_CASE("the frame lit is told live as the flip history tells it", "[unit]") {
    Animation animation;
    animation.duration_s = 1.0;
    const PageCycle plan = make_page_cycle(animation, 120.0);
    const ScanOut scan_out{from_seconds(0.0035), 120.0, 1080.0};
    RandomStream random(3, "lit frames");
    std::vector<FlipRecord> flips;
    for (int refresh = 0; refresh < plan.total_refreshes; ++refresh) {
        const PageCycleEntry& entry = plan.entry_at(refresh);
        if (refresh > 0 && random.below(10) == 0)
            refresh += static_cast<int>(random.below(4)); // went by with the picture before
        FlipRecord flip{0, refresh, entry.frame, entry.frame, entry.pose, {}};
        flip.report.refresh = {refresh};
        flip.report.vertical_blank = SessionTime(from_seconds(2.0 + refresh / 120.0));
        flips.push_back(flip);
    }
    const FlipHistory history(flips, scan_out, plan);
    LitFrames lit(scan_out, 64);
    CHECK_FALSE(lit.pose_at(flips.front().report.vertical_blank, 0.0));
    std::size_t known = 0;
    int told = 0;
    for (int i = 0; i < 20'000; ++i) {
        // Asked before the next flip, of what was lit in the last few refreshes.
        const SessionTime now(from_seconds(2.0 + 1.0 * i / 20'000.0));
        while (known < flips.size() && flips[known].report.vertical_blank <= now)
            lit.add(flips[known++]);
        const SessionTime sampled = now - from_seconds(random.uniform(0.0, 0.02));
        const double row_px = random.uniform(-100.0, 1200.0);
        const std::optional<LitFrame> afterwards = history.frame_shown_at(sampled, row_px);
        const std::optional<PoseIndex> live = lit.pose_at(sampled, row_px);
        // A picture that stays for longer than a refresh is known to stay once the next has come.
        if (!live && afterwards)
            CHECK(blank_lighting(scan_out, 1e9 / 120.0, sampled, row_px) >=
                  flips[known - 1].report.vertical_blank + from_seconds(1.0 / 120.0));
        else
            CHECK(live == (afterwards ? std::optional(afterwards->pose) : std::nullopt));
        told += live.has_value();
    }
    CHECK(told > 15'000);
}
