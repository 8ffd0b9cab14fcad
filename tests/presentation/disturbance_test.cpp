/// A machine that sleeps in a trial, or has its wall clock set.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "devices/host/clocks.h"
#include "devices/simulated/simulated_response_panel.h"
#include "experiment/session/session.h"
#include "experiment/timing/virtual_refresh.h"
#include "tests/devices/simulated/sitting.h"

using namespace overt;

namespace {

/// Virtual time on a machine that sleeps, and whose wall clock is set, at given instants.
class DisturbedClock final : public Clock {
  public:
    struct At {
        SessionTime time;
        Disturbance what;
    };
    std::vector<At> disturbances;

    SessionTime now() const noexcept override { return clock_.now(); }
    void wait_until(SessionTime time) noexcept override { clock_.wait_until(time); }
    Disturbance disturbance() const noexcept override {
        Disturbance sum;
        for (const At& at : disturbances) {
            if (at.time <= now()) {
                sum.slept += at.what.slept;
                sum.wall_moved += at.what.wall_moved;
            }
        }
        return sum;
    }

  private:
    VirtualClock clock_;
};

class BlankPresenter final : public Presenter {
  public:
    explicit BlankPresenter(Clock& clock) : refresh_(clock, 120.0) {}
    DisplayTiming timing() const override { return refresh_.timing(); }
    void load_slots(std::span<const PlacedStimulus>) override {}
    FlipReport show(const Screen&) override { return refresh_.next(); }
    FlipReport flip_slots(std::span<const AnimationFrameIndex>) noexcept override { return refresh_.next(); }
    bool closed() const noexcept override { return false; }

  private:
    VirtualRefresh refresh_;
};

class EventList final : public SessionLog {
  public:
    std::vector<std::pair<int, std::string>> events; ///< trial and words
    void flip(const FlipRecord&) noexcept override {}
    void missed(const MissedRefresh&) noexcept override {}
    void sample(int, const GazeSample&) noexcept override {}
    void clock_pair(const ClockPair&) noexcept override {}
    void event(const SessionEvent& event) override {
        events.emplace_back(event.trial, std::string(event.kind) + ": " + event.detail);
    }
    void trial_started(const Trial&, SessionTime) override {}
    void trial_finished(const Trial&, const TrialOutcome&) override {}
};

} // namespace

TEST_CASE("a trial in which the machine slept or its wall clock was set says so, and the next does not",
          "[unit]") {
    const Mesh mesh = test::bust();
    DisturbedClock clock;
    SimulatedObserver observer(test::scene_with(mesh), 5);
    SimulatedEyeTracker tracker(clock, observer, 5);
    SimulatedResponsePanel panel(clock, observer);
    BlankPresenter presenter(clock);
    EventList log;
    Protocol protocol;
    protocol.tasks = {{"free", "Look."}};
    protocol.objects.resize(1);
    protocol.materials.resize(1);
    Schedule schedule;
    schedule.trials = {{0, 0, {}}, {1, 0, {}}, {2, 0, {}}};
    Session session(protocol, schedule, observer.scene().screen.centre(),
                    {clock, presenter, tracker, panel, log, {&observer}});
    // Both in the second trial; what a clock is slewed by is nothing.
    const SessionResult result = session.run([&](const Trial& trial, const TrialOutcome&, int) {
        if (trial.index == 0)
            clock.disturbances = {
                {clock.now() + std::chrono::seconds(4), {std::chrono::seconds(90), {}}},
                {clock.now() + std::chrono::seconds(5), {{}, std::chrono::seconds(-3600)}},
                {clock.now() + std::chrono::seconds(6), {{}, std::chrono::milliseconds(20)}}};
    });
    CHECK(result.completed_trials == 3);
    CHECK_FALSE(result.aborted);
    std::vector<std::pair<int, std::string>> disturbances;
    std::copy_if(log.events.begin(), log.events.end(), std::back_inserter(disturbances),
                 [](const auto& event) { return event.first >= 0 && !event.second.starts_with("phase: "); });
    REQUIRE(disturbances.size() == 2);
    CHECK(disturbances[0].first == 1);
    CHECK(disturbances[0].second == "machine slept: 90.000 s, in which nothing was shown or recorded");
    CHECK(disturbances[1].first == 1);
    CHECK(disturbances[1].second.starts_with("wall clock was set: by -3599.980 s"));
}

TEST_CASE("a steady clock on a machine that is awake is not disturbed", "[unit]") {
    const SteadyClock clock;
    const Clock::Disturbance first = clock.disturbance(), second = clock.disturbance();
    CHECK(std::abs(to_seconds(first.slept)) < 0.005);
    CHECK(std::abs(to_seconds(second.slept - first.slept)) < 0.005);
}
