#include <catch2/catch.hpp>

#include "experiment/events/event_detector.h"
#include "experiment/events/planted_gaze.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/session_schema.h"
#include "tests/experiment/record/session_fixture.h"
#include "tests/support/counted_allocations.h"

using namespace overt;
using namespace overt::testing;

namespace {

class EventCounter final : public EventListener {
  public:
    void detected(const GazeEvent& event) override {
        ++events;
        latest = event.end;
    }
    int events = 0;
    TrackerTime latest;
};

} // namespace

TEST_CASE("detecting events allocates nothing", "[unit]") {
    const double rate_hz = GENERATE(60.0, 2000.0, 10000.0);
    const ScreenGeometry screen;
    const PlantedGaze planted = plant_gaze({.rate_hz = rate_hz, .duration_s = 20.0}, screen);
    EventCounter counter;
    EventDetector detector({}, GazeAngles(screen), counter);
    const long before = test::allocations;
    for (const GazeSample& sample : planted.samples)
        detector.push(sample);
    detector.finish();
    CHECK(test::allocations == before);
    CHECK(counter.events > 30);
}

TEST_CASE("noting flips, samples and clock pairs allocates nothing, with a full ring too", "[unit]") {
    const TemporaryFolder root;
    const SessionHeader header = example_header();
    const auto session = make_session(root.path(), header);
    SessionStore::Options options = patient();
    options.wait_when_full = GENERATE(true, false);
    options.ring_capacity = 64;
    SessionStore store(session / session_file_name, options);
    const long before_event = test::allocations;
    store.trial_started(header.schedule.trials[0], at_ms(0));
    CHECK(test::allocations > before_event); // the counter counts

    const long before = test::allocations;
    for (int i = 0; i < 20'000; ++i) {
        GazeSample sample;
        sample.gaze = ScreenPoint{0.5 * i, 1.0};
        store.sample(0, sample);
        if (i % 16 == 0) {
            store.flip({});
            store.clock_pair({});
        }
    }
    CHECK(test::allocations == before);
    store.trial_finished(header.schedule.trials[0], outcome_at(0));
}
