/// The tables of eye trackers and response devices.
#include <catch2/catch.hpp>

#include "app/rig/response_devices.h"
#include "app/rig/tracker_devices.h"
#include "devices/simulated/operator_script.h"
#include "experiment/base/error.h"
#include "experiment/ports/tracker_kinds.h"
#include "tests/devices/simulated/sitting.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

/// Answers once so many seconds after a question was shown.
class TimedPanel final : public ResponsePanel {
  public:
    TimedPanel(const Clock& clock, SessionDuration after) : clock_(clock), after_(after) {}
    void await_key(SessionTime since) override { due_ = since + after_; }
    void await_response(const Trial&, SessionTime since) override { await_key(since); }
    void await_decision(bool, SessionTime since) override { await_key(since); }
    void await_entry(SessionTime since) override { await_key(since); }
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

TEST_CASE("each kind of tracker that a protocol may name can be made, and says its name", "[unit]") {
    Sitting sitting(3);
    TrackerSettings settings;
    for (std::size_t i = 0; i < std::size(tracker_kinds); ++i) {
        settings.kind = static_cast<TrackerKind>(i);
        const auto tracker =
            tracker_device(settings.kind, true).make({settings, sitting.clock, sitting.observer, 7});
        CHECK(tracker->description().name == tracker_kinds[i].name);
        CHECK(tracker->measures_gaze() == (tracker_kinds[i].name != "none"));
    }
}

TEST_CASE("a tracker that is hardware is refused in virtual time", "[unit]") {
    const TrackerDevice hardware[] = {{"glass", true, nullptr}};
    CHECK(&tracker_device(TrackerKind{}, false, hardware) == hardware);
    CHECK_THROWS_WITH(tracker_device(TrackerKind{}, true, hardware),
                      Contains("\"glass\"") && Contains("--virtual-time"));
}

TEST_CASE("a session asks the last response device that it uses, which asks the one before", "[unit]") {
    Sitting sitting(3);
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
