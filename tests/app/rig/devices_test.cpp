/// The tables of eye trackers and response devices.
#include <catch2/catch.hpp>

#include "app/rig/response_devices.h"
#include "app/rig/tracker_devices.h"
#include "devices/pupil/pupil_tracker.h"
#include "devices/simulated/operator_script.h"
#include "experiment/base/error.h"
#include "tests/devices/link/tcp_peer.h"
#include "tests/devices/opengaze/opengaze_server_model.h"
#include "tests/devices/simulated/sitting.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

/// Answers once so many seconds after a question was shown.
class TimedPanel final : public ResponsePanel {
  public:
    TimedPanel(const Clock& clock, SessionDuration after) : clock_(clock), after_(after) {}
    void await(Awaited, SessionTime since, const Trial*) override { due_ = since + after_; }
    std::optional<ResponsePress> poll() noexcept override {
        if (!due_ || clock_.now() < *due_)
            return std::nullopt;
        const ResponsePress press{ResponsePress::Key::next, *due_};
        due_.reset();
        return press;
    }
    std::string answer() override { return "in time"; }

  private:
    const Clock& clock_;
    SessionDuration after_;
    std::optional<SessionTime> due_;
};

} // namespace

TEST_CASE("gaze on a surface of tags is gaze on the screen between their black borders", "[unit]") {
    Protocol protocol; // 1920 x 1080
    CHECK_FALSE(pupil_settings_of(protocol).surface_place);
    protocol.display.output = OutputMode::native_8bit;
    protocol.display.tags_px = 200;
    const std::optional<SurfaceOnScreen> place = pupil_settings_of(protocol).surface_place;
    REQUIRE(place);
    const ScreenPoint top_right = place->on_screen({1.0, 1.0}), middle = place->on_screen({0.5, 0.5}),
                      bottom_left = place->on_screen({0.0, 0.0});
    CHECK((top_right.x_px == 1900.0 && top_right.y_px == 20.0));
    CHECK((middle.x_px == 960.0 && middle.y_px == 540.0));
    CHECK((bottom_left.x_px == 20.0 && bottom_left.y_px == 1060.0));
}

TEST_CASE("each kind of tracker that needs no device can be made, and says its name", "[unit]") {
    test::SimulatedSitting sitting(3);
    Protocol protocol;
    int made = 0;
    for (const TrackerKind kind : all_kinds<TrackerKind>) {
        protocol.tracker.kind = kind;
        const TrackerDevice& device = tracker_device(kind, false);
        CHECK((device.make_driver != nullptr) == row_of(kind).is_hardware());
        CHECK((device.make_tracker != nullptr) != row_of(kind).is_hardware());
        if (row_of(kind).is_hardware())
            continue;
        if (name_of(kind) == "replay") {
            CHECK_THROWS_WITH(device.make_tracker({protocol, sitting.clock, sitting.observer, 7}),
                              Contains("needs a recording"));
            protocol.tracker.address = "nowhere";
            CHECK_THROWS_WITH(device.make_tracker({protocol, sitting.clock, sitting.observer, 7}),
                              Contains("nowhere: this recording"));
            continue;
        }
        const auto tracker = device.make_tracker({protocol, sitting.clock, sitting.observer, 7});
        CHECK(tracker->description().name == name_of(kind));
        CHECK(tracker->measures_gaze() == row_of(kind).measures_gaze);
        ++made;
    }
    CHECK(made >= 2);
}

TEST_CASE("a tracker that is hardware is refused in virtual time", "[unit]") {
    const auto mouse = kind_called<TrackerKind>("mouse");
    CHECK(tracker_device(mouse, false).make_driver);
    CHECK_THROWS_WITH(tracker_device(mouse, true), Contains("\"mouse\"") && Contains("--virtual-time"));
    CHECK(tracker_device(kind_called<TrackerKind>("simulated"), true).make_tracker);
}

TEST_CASE("a session asks the last response device that it uses, which asks the one before", "[unit]") {
    test::SimulatedSitting sitting(3);
    const Protocol protocol;
    const std::vector<ScriptedOperatorKey> keys;
    ResponseParts parts{protocol, sitting.clock, sitting.observer, nullptr, false, keys};
    CHECK(make_response_devices(parts).empty());
    parts.simulate_observer = true;
    CHECK(make_response_devices(parts).size() == 1);

    // One more row is all that another device takes.
    static ResponsePanel* asked = nullptr;
    std::vector<ResponseDevice> devices(response_devices().begin(), response_devices().end());
    devices.push_back({"timed", [](const ResponseParts&) { return true; },
                       [](const ResponseParts& with, ResponsePanel* answering) {
                           asked = answering;
                           return std::unique_ptr<ResponsePanel>(
                               std::make_unique<TimedPanel>(with.clock, std::chrono::seconds(2)));
                       }});
    const auto made = make_response_devices(parts, devices);
    REQUIRE(made.size() == 2);
    CHECK(asked == made.front().get());
    ResponsePanel& panel = *made.back();
    panel.await_response({}, sitting.clock.now());
    CHECK_FALSE(panel.poll());
    sitting.clock.wait_until(sitting.clock.now() + std::chrono::seconds(3));
    REQUIRE(panel.poll());
    CHECK_FALSE(panel.poll());
    CHECK(panel.answer() == "in time");
}

TEST_CASE("a tracker in the network is set as the protocol says", "[unit]") {
    SteadyClock clock;
    test::SimulatedSitting sitting(3);
    Protocol protocol;
    const auto made = [&](std::string_view kind) {
        protocol.tracker.kind = tracker_kind_called(kind);
        return make_tracker({protocol, clock, sitting.observer, 7}, false).tracker;
    };
    OpenGazeServerModel model;
    const TcpPeer peer([&](std::string_view bytes, double now_s) { return model.receive(bytes, now_s); },
                       [&](double now_s) { return model.stream(now_s); });
    protocol.tracker.address = describe(peer.address());
    protocol.tracker.eye = "both";
    CHECK(made("opengaze")->description().both_eyes);
    protocol.tracker.point = TrackedPoint::best;
    CHECK_FALSE(made("opengaze")->description().both_eyes);

    protocol.tracker.address = "127.0.0.1:here";
    CHECK_THROWS_WITH(made("opengaze"), Contains("\"here\" is no port") && Contains(":4242"));
    CHECK_THROWS_WITH(made("pupil"), Contains("\"here\" is no port") && Contains(":50020"));
    protocol.tracker.channels = {"left depth 3"};
    CHECK_THROWS_WITH(made("lsl"), Contains("meanings are x, y"));
}
