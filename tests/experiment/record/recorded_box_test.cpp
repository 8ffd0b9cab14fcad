#include "experiment/record/recorded_box.h"

#include <cmath>

#include <SQLiteCpp/SQLiteCpp.h>
#include <catch2/catch.hpp>

#include "experiment/record/read/session_record.h"
#include "tests/experiment/record/session_fixture.h"

using namespace overt;
using namespace overt::testing;

namespace {

RecordedBox example_box() {
    return {RecordedBox::Use::box,
            "/dev/ttyACM3",
            "Display++",
            "DPP-1",
            "Mar 14 2018",
            "Mono++",
            "13bitLinearLUT.txt",
            SessionDuration(1'234'567'891),
            119.98};
}

/// A box whose clock runs `ppm` slower than the session's, read every minute over an hour.
std::vector<BoxClockPair> hour_of_readings(double ppm, SessionTime zero) {
    std::vector<BoxClockPair> readings;
    for (int minute = 0; minute <= 60; ++minute) {
        const std::int64_t box_us = 60'000'000LL * minute;
        const SessionTime at =
            zero + SessionDuration(std::llround(static_cast<double>(box_us) * (1e3 + 1e-3 * ppm)));
        // What lies before and after is never the same: on the way there and back.
        readings.push_back({at - SessionDuration(200'000 + 1000 * (minute % 7)),
                            BoxTime(BoxClock::duration(box_us)),
                            at + SessionDuration(900'000 - 1500 * (minute % 5))});
    }
    return readings;
}

} // namespace

TEST_CASE("each sitting's display box and the readings of its clock come back as they were written",
          "[unit]") {
    const TemporaryFolder folder;
    const auto path = make_session(folder.path(), example_header());
    const std::vector<BoxClockPair> readings = hour_of_readings(20.0, at_ms(500));
    RecordedBox declined;
    declined.use = RecordedBox::Use::declined;
    {
        SessionStore store(path / "session.sqlite", patient());
        store.display_box(declined); // replaced by what follows
        store.display_box(example_box());
        store.box_clock({readings.begin(), readings.begin() + 6});
        store.box_clock({readings.begin() + 6, readings.end()});
        store.close();
    }
    {
        SessionStore store(path / "session.sqlite", patient());
        store.display_box(declined);
        store.close();
    }
    const SessionRecord record(path);
    const auto boxes = record.display_boxes();
    REQUIRE(boxes.size() == 2);
    CHECK(boxes[0] == std::pair(1, example_box()));
    CHECK(boxes[1] == std::pair(2, declined));
    CHECK(record.box_clock_readings(1) == readings);
    CHECK(record.box_clock_readings(2).empty());
}

TEST_CASE("a session of a program that knew no display box is read, and taken up again", "[unit]") {
    const TemporaryFolder folder;
    const auto path = make_session(folder.path(), example_header());
    SQLite::Database((path / "session.sqlite").string(), SQLite::OPEN_READWRITE)
        .exec("DROP TABLE display_box; DROP TABLE box_clock_pair");
    CHECK(SessionRecord(path).display_boxes().empty());
    CHECK(SessionRecord(path).box_clock_readings(1).empty());
    SessionStore store(path / "session.sqlite", patient());
    store.display_box(example_box());
    store.box_clock(hour_of_readings(0.0, at_ms(0)));
    store.close();
    CHECK(SessionRecord(path).display_boxes().size() == 1);
    CHECK(SessionRecord(path).box_clock_readings(1).size() == 61);
}

TEST_CASE("the fit of a box's clock gives its drift and its zero back within its own bounds", "[unit]") {
    for (const double ppm : {-80.0, 0.0, 15.0, 120.0}) {
        CAPTURE(ppm);
        const SessionTime zero = at_ms(2500);
        const BoxClockFit fit = fit_box_clock(hour_of_readings(ppm, zero));
        CHECK(fit.readings == 61);
        CHECK(std::abs(fit.drift_ppm - ppm) <= fit.drift_uncertainty_ppm);
        CHECK(fit.drift_uncertainty_ppm < 5.0);
        CHECK(std::chrono::abs(fit.zero - zero) <= fit.uncertainty);
        CHECK(fit.uncertainty < std::chrono::milliseconds(2));
    }
}

TEST_CASE("a display box is described with all that is known of it, or with why there is none", "[unit]") {
    RecordedBox box = example_box();
    CHECK(describe(box) ==
          "Display++, serial number DPP-1, firmware Mar 14 2018, at /dev/ttyACM3: Mono++ after 1.23 s, "
          "119.98 Hz");
    for (const auto& [use, name, words] :
         {std::tuple(RecordedBox::Use::box, "box", ""),
          std::tuple(RecordedBox::Use::declined, "declined", "none, as the protocol says"),
          std::tuple(RecordedBox::Use::simulated, "simulated",
                     "none: nothing is shown on a real screen in real time"),
          std::tuple(RecordedBox::Use::no_mode, "not needed", "none: the output needs none")}) {
        CHECK(name_of(use) == name);
        box.use = use;
        CHECK((use == RecordedBox::Use::box || describe(box) == words));
    }
}
