#include <catch2/catch.hpp>

#include <array>
#include <memory>

#include "devices/display_box/bits_link.h"
#include "devices/simulated/simulated_response_panel.h"
#include "tests/devices/link/in_memory_line.h"
#include "tests/devices/simulated/sitting.h"
#include "tests/support/counted_allocations.h"

using namespace overt;

TEST_CASE("from the begin of a presentation to its last sample nothing is allocated", "[unit]") {
    test::Sitting sitting(31);
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 31);
    SimulatedResponsePanel panel(sitting.clock, sitting.observer);
    const ObservedScene& scene = sitting.observer.scene();
    const PageCycle cycle = make_page_cycle(scene.animation, scene.refresh_hz);
    std::array<TrackerItem, 256> samples;
    for (int trial = 0; trial < 3; ++trial) {
        sitting.observer.screen_shown({}, sitting.clock.now());
        tracker.start_recording();
        const long before = test::allocations;
        std::size_t taken = 0;
        sitting.observer.presentation_begins({trial, 0, {}});
        for (int refresh = 0; refresh < cycle.total_refreshes; ++refresh) {
            const PageCycleEntry& entry = cycle.entry_at(refresh);
            sitting.clock.wait_until(sitting.clock.now() + from_seconds(1.0 / scene.refresh_hz));
            FlipRecord flip{trial, refresh, entry.frame, entry.frame, entry.pose, {}};
            flip.report.vertical_blank = sitting.clock.now();
            sitting.observer.flipped(flip);
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

TEST_CASE("status lines of a display box are read without allocating, noise among them", "[unit]") {
    /// Gives the same bytes over and over, from where they were left, and allocates nothing itself.
    class Chatter final : public ByteTransport {
      public:
        explicit Chatter(std::string said) : said_(std::move(said)) {}
        const std::string& name() const noexcept override { return name_; }
        bool write(std::string_view, SessionTime) noexcept override { return true; }
        std::size_t read(std::span<char> into, SessionTime) noexcept override {
            const std::size_t count = std::min<std::size_t>(into.size(), 1500);
            for (std::size_t i = 0; i < count; ++i)
                into[i] = said_[next_++ % said_.size()];
            return count;
        }
        bool lost() const noexcept override { return false; }
        std::string loss() const override { return {}; }

      private:
        std::string name_ = "chatter", said_;
        std::size_t next_ = 0;
    };
    test::BitsBoxModel model;
    const std::string noise(300, 'x');
    VirtualClock clock;
    BitsLink link(std::make_unique<Chatter>(model.status_line(1.0) + noise + "\r$touch;1.0;1;2;1;\r"), clock);
    std::array<ArrivedStatus, 32> samples;
    std::size_t taken = 0;
    const long before = test::allocations;
    for (int refresh = 0; refresh < 2000; ++refresh)
        taken += link.poll_status(samples);
    const long during = test::allocations - before;
    CHECK(during == 0);
    CHECK(taken > 2000);
}
