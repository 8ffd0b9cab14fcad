/// Agreement of events, by hand.
#include "experiment/events/event_agreement.h"

#include <catch2/catch.hpp>

using namespace overt;
using Kind = GazeEvent::Kind;

namespace {

GazeEvent event(Kind kind, int from_ms, int to_ms) {
    GazeEvent event;
    event.kind = kind;
    event.start = tracker_time(1000 * from_ms);
    event.end = tracker_time(1000 * to_ms - 1000);
    event.duration = TrackerClock::duration(1000 * (to_ms - from_ms));
    return event;
}

} // namespace

TEST_CASE("events agree if more than half of the time of both is shared", "[unit]") {
    const auto f1 = [](std::vector<GazeEvent> a, std::vector<GazeEvent> b) {
        EventAgreement agreement(Kind::fixation);
        agreement.add(a, b);
        EventAgreement turned(Kind::fixation);
        turned.add(b, a);
        CHECK(agreement.f1() == turned.f1());
        return agreement.f1();
    };
    const GazeEvent whole = event(Kind::fixation, 0, 100);
    CHECK(f1({whole}, {whole}) == 1.0);
    CHECK(f1({whole}, {event(Kind::fixation, 0, 51)}) == 1.0);
    CHECK(f1({whole}, {event(Kind::fixation, 0, 50)}) == 0.0);
    CHECK(f1({whole}, {event(Kind::fixation, 40, 120)}) == 0.0);
    CHECK(f1({whole}, {event(Kind::fixation, 30, 120)}) == 1.0);
    CHECK(f1({whole}, {}) == 0.0);
    CHECK(f1({}, {}) == 1.0);
    // One of two halves has no partner: 2 * 1 / (1 + 2).
    CHECK(f1({whole}, {event(Kind::fixation, 0, 60), event(Kind::fixation, 60, 100)}) == Approx(2.0 / 3.0));
    // Saccades are none of its business.
    CHECK(f1({whole, event(Kind::saccade, 100, 140)}, {whole}) == 1.0);
}

TEST_CASE("errors of begins and ends are told of events with a partner", "[unit]") {
    EventAgreement agreement(Kind::saccade);
    agreement.add(std::vector{event(Kind::saccade, 0, 40), event(Kind::saccade, 200, 240),
                              event(Kind::saccade, 300, 340)},
                  std::vector{event(Kind::saccade, 2, 44), event(Kind::saccade, 196, 238),
                              event(Kind::saccade, 500, 540)});
    CHECK(agreement.matched() == 2);
    CHECK(agreement.in_reference() == 3);
    CHECK(agreement.detected() == 3);
    CHECK(agreement.median_onset_error_ms().value() == 3.0);
    CHECK(agreement.median_offset_error_ms().value() == 3.0);
    // Without any there is no error, and none of 0.
    EventAgreement apart(Kind::saccade);
    apart.add(std::vector{event(Kind::saccade, 0, 40)}, std::vector{event(Kind::saccade, 200, 240)});
    CHECK_FALSE(apart.median_onset_error_ms());
    CHECK_FALSE(apart.median_offset_error_ms());
}

TEST_CASE("kappa is agreement beyond chance", "[unit]") {
    // Cohen's own way: 20 yes, 15 no, and 5 and 10 in which they differ. po = 0.7, pe = 0.5 * 0.6 + 0.5 * 0.4
    // = 0.5.
    SampleAgreement agreement;
    for (int i = 0; i < 20; ++i)
        agreement.add(true, true);
    for (int i = 0; i < 5; ++i)
        agreement.add(true, false);
    for (int i = 0; i < 10; ++i)
        agreement.add(false, true);
    for (int i = 0; i < 15; ++i)
        agreement.add(false, false);
    CHECK(agreement.kappa() == Approx(0.4));
    SampleAgreement same;
    same.add(true, true);
    CHECK(same.kappa() == 1.0);
}

TEST_CASE("samples lie within events from the first to the last", "[unit]") {
    std::vector<GazeSample> samples;
    for (int ms = 0; ms < 10; ++ms)
        samples.push_back({tracker_time(1000 * ms), Eye::left, {}, 0.0f});
    const std::vector<GazeEvent> events{event(Kind::saccade, 0, 1), event(Kind::fixation, 1, 4),
                                        event(Kind::fixation, 6, 8)};
    CHECK(samples_within(samples, events, Kind::fixation) ==
          std::vector<bool>{false, true, true, true, false, false, true, true, false, false});
}
