#include <catch2/catch.hpp>

#include "experiment/record/read/session_record.h"
#include "experiment/record/session_schema.h"
#include "tests/experiment/record/session_fixture.h"
#include "tests/support/counted_allocations.h"

using namespace overt;
using namespace overt::testing;

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
