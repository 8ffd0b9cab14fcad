#include <catch2/catch.hpp>

#include "devices/host/clocks.h"
#include "devices/opengaze/opengaze_tracker.h"
#include "devices/tracker/threaded_tracker.h"
#include "experiment/base/error.h"
#include "tests/devices/link/tcp_peer.h"
#include "tests/devices/opengaze/opengaze_server_model.h"
#include "tests/devices/tracker/scripted_setup_screen.h"
#include "tests/support/kept_items.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

/// An Open Gaze server over TCP and in real time, and the tracker on its thread.
struct OpenGazeNetwork {
    SteadyClock clock;
    OpenGazeServerModel model;
    TcpPeer peer{[this](std::string_view bytes, double now_s) { return model.receive(bytes, now_s); },
                 [this](double now_s) { return model.stream(now_s); }};
    OpenGazeSettings settings;
    TrackerWish wish;
    KeptItems items;

    OpenGazeNetwork() {
        settings.server = peer.address();
        settings.timeouts.connect = settings.timeouts.reply = 20s; // the peer's thread may wait for long
        settings.timeouts.silence = 20s;
        wish.both_eyes = true;
    }

    std::unique_ptr<ThreadedTracker> tracker() {
        return std::make_unique<ThreadedTracker>(std::make_unique<OpenGazeTracker>(settings, clock), clock,
                                                 wish);
    }

    /// Until so many samples have come, or the recording does not go on.
    void poll(EyeTracker& tracker, std::size_t wanted) {
        std::array<TrackerItem, 64> some;
        const SessionTime give_up = clock.now() + 60s;
        while (items.all<GazeSample>().size() < wanted && clock.now() < give_up) {
            const bool running = tracker.recording_state() == RecordingState::running;
            const std::size_t count = tracker.poll(some);
            items.items.insert(items.items.end(), some.begin(),
                               some.begin() + static_cast<std::ptrdiff_t>(count));
            if (count == 0 && !running)
                return;
            if (count == 0)
                clock.wait_until(clock.now() + 1ms);
        }
    }

    /// After the recording was stopped: nothing follows then.
    void take_what_is_left(EyeTracker& tracker) {
        std::array<TrackerItem, 64> some;
        while (const std::size_t count = tracker.poll(some))
            items.items.insert(items.items.end(), some.begin(),
                               some.begin() + static_cast<std::ptrdiff_t>(count));
    }
};

} // namespace

TEST_CASE("an Open Gaze tracker on the network gives each sample once and in order, and takes marks",
          "[unit]") {
    OpenGazeNetwork network;
    const auto tracker = network.tracker();
    CHECK(tracker->description().sample_rate_hz == 150.0);
    tracker->start_recording();
    network.poll(*tracker, 150);
    tracker->mark({network.clock.now(), "ONSET 3"});
    network.poll(*tracker, 300);
    tracker->stop_recording();
    network.take_what_is_left(*tracker);
    const auto samples = network.items.all<GazeSample>();
    REQUIRE(samples.size() % 2 == 0);
    for (std::size_t i = 2; i < samples.size(); i += 2)
        REQUIRE((samples[i].sampled_at - samples[i - 2].sampled_at).count() == Approx(6667).margin(2));
    CHECK(network.items.all<TrackerGap>().empty());
    CHECK_FALSE(network.items.all<ClockPair>().empty());
    CHECK(network.model.marks() == std::vector<std::string>{"ONSET 3"});
}

TEST_CASE("an Open Gaze server that ends in a recording is lost, and is reached again when it is back",
          "[unit]") {
    OpenGazeNetwork network;
    const auto tracker = network.tracker();
    tracker->start_recording();
    network.poll(*tracker, 50);
    network.peer.drop();
    network.poll(*tracker, 10'000'000);
    CHECK(tracker->lost());
    CHECK(network.items.all<TrackerGap>().back().reason == TrackerGap::Reason::connection);
    tracker->reconnect();
    CHECK_FALSE(tracker->lost());
    network.items.items.clear();
    tracker->start_recording();
    network.poll(*tracker, 50);
    tracker->stop_recording();
    CHECK(network.items.all<GazeSample>().size() >= 50);
}

TEST_CASE("an Open Gaze server calibrates over the network", "[unit]") {
    OpenGazeNetwork network;
    const auto tracker = network.tracker();
    ScriptedSetupScreen setup_screen(network.clock);
    const SetupOutcome outcome = tracker->set_up(setup_screen);
    CHECK(outcome.kind == SetupOutcome::Kind::done);
    CHECK(setup_screen.targets.size() == 5);
}

TEST_CASE("without an Open Gaze server it is said where none is", "[unit]") {
    OpenGazeNetwork network;
    network.settings.server = TcpPeer([](std::string_view, double) { return ""; }).address();
    CHECK_THROWS_WITH(network.tracker(), Contains("Open Gaze server (Gazepoint Control) at 127.0.0.1") &&
                                             Contains("Connection refused"));
}
