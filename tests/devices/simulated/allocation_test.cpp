#include <catch2/catch.hpp>

#include <array>
#include <memory>

#include "devices/display_box/bits_link.h"
#include "devices/operator/gaze_tap.h"
#include "devices/operator/watched_log.h"
#include "devices/simulated/simulated_response_panel.h"
#include "tests/devices/link/in_memory_line.h"
#include "tests/devices/simulated/sitting.h"
#include "tests/support/counted_allocations.h"
#include "tests/support/temporary_folder.h"

using namespace overt;

TEST_CASE("from the begin of a presentation to its last sample nothing is allocated", "[unit]") {
    test::SimulatedSitting sitting(31);
    SimulatedEyeTracker tracker(sitting.clock, sitting.observer, 31);
    SimulatedResponsePanel panel(sitting.clock, sitting.observer);
    const ObservedScene& scene = sitting.observer.scene();
    const PageCycle cycle = make_page_cycle(scene.animations[0], scene.refresh_hz);
    std::array<TrackerItem, 256> samples;
    for (int trial = 0; trial < 3; ++trial) {
        sitting.observer.screen_shown({}, sitting.clock.now());
        tracker.start_recording();
        const long before = test::allocations;
        std::size_t taken = 0;
        sitting.observer.presentation_begins({trial, 0, {}}, 0);
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

TEST_CASE("a session that is watched allocates nothing for it in a presentation, and records the same",
          "[unit]") {
    class CountedLog final : public SessionLog {
      public:
        void flip(const FlipRecord&) noexcept override { ++flips; }
        void missed(const MissedRefresh&) noexcept override { ++misses; }
        void sample(int, const GazeSample&) noexcept override { ++samples; }
        void tracker_item(int, const TrackerItem&) noexcept override { ++items; }
        void clock_pair(const ClockPair&) noexcept override { ++pairs; }
        void event(const SessionEvent&) override {}
        void trial_started(const Trial&, SessionTime) override {}
        void trial_finished(const Trial&, const TrialOutcome&) override {}
        int flips = 0, misses = 0, samples = 0, items = 0, pairs = 0;
    };
    const test::TemporaryFolder folder;
    OperatorServer::Options options;
    options.socket = folder.path() / "view.sock";
    options.ring_capacity = 256;
    OperatorServer server(std::move(options));
    VirtualClock clock;
    test::SimulatedSitting sitting(31);
    SimulatedResponsePanel silent(sitting.clock, sitting.observer);
    OperatorPanel panel(server, clock, silent);
    CountedLog record;
    GazeTap tap(server, clock);
    WatchedLog log(record, server, panel, clock, &tap);
    log.trial_started({}, {});
    const long before = test::allocations;
    constexpr int refreshes = 1000;
    for (int refresh = 0; refresh < refreshes; ++refresh) {
        FlipRecord flip;
        flip.refresh_in_trial = refresh;
        flip.pose.value = refresh % 61;
        log.missed({});
        log.flip(flip);
        for (int i = 0; i < 16; ++i)
            log.sample(0, {tracker_time(1000 * (16 * refresh + i)), Eye::right, ScreenPoint{1.0, 2.0}, 1.0f});
        log.tracker_item(0, TrackerInput{});
        log.clock_pair({});
        panel.poll();
    }
    const long during = test::allocations - before;
    CHECK(during == 0);
    CHECK(record.flips == refreshes);
    CHECK(record.misses == refreshes);
    CHECK(record.samples == 16 * refreshes);
    CHECK(record.items == refreshes);
    CHECK(record.pairs == refreshes);
}
