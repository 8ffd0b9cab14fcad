#include <catch2/catch.hpp>

#include <array>
#include <memory>

#include "devices/simulated_response_panel.h"
#include "devices/sitting.h"
#include "support/counted_allocations.h"

using namespace overt;

TEST_CASE("from the begin of a presentation to its last sample nothing is allocated", "[unit]") {
    test::Sitting sitting(31);
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 31);
    SimulatedResponsePanel panel(sitting.clock, sitting.observer);
    const ObservedScene& scene = sitting.observer.scene();
    const PageCycle cycle = make_page_cycle(scene.animation, scene.refresh_hz);
    std::array<GazeSample, 256> samples;
    for (int trial = 0; trial < 3; ++trial) {
        sitting.observer.saw_screen({}, sitting.clock.now());
        tracker.start_recording();
        const long before = test::allocations;
        std::size_t taken = 0;
        sitting.observer.presentation_begins({trial, 0, {}});
        for (int refresh = 0; refresh < cycle.total_refreshes; ++refresh) {
            const PageCycleEntry& entry = cycle.entry_at(refresh);
            sitting.clock.wait_until(sitting.clock.now() + from_seconds(1.0 / scene.refresh_hz));
            FlipRecord flip{trial, refresh, entry.frame, entry.frame, entry.page, {}};
            flip.report.vertical_blank = sitting.clock.now();
            sitting.observer.saw(flip);
            taken += tracker.poll(samples);
            panel.poll();
        }
        static_cast<void>(tracker.read_clocks());
        const long during = test::allocations - before;
        CHECK(during == 0);
        CHECK(taken > 15900);
        tracker.stop_recording();
    }
    const long before = test::allocations;
    const auto counted = std::make_unique<int>(1);
    CHECK(test::allocations - before >= *counted); // the count does count
}
