/// What an eye tracker tells besides samples, as the record has it in words.
#include "experiment/ports/tracker_items.h"

#include <catch2/catch.hpp>

using namespace overt;
using namespace std::chrono_literals;

TEST_CASE("what a tracker told is found again in the words of the record", "[unit]") {
    TrackerEvent saccade, fixation;
    saccade.kind = GazeEvent::Kind::saccade;
    saccade.eye = Eye::left;
    saccade.start = TrackerTime(5ms);
    saccade.end = TrackerTime(45ms);
    saccade.duration = 40ms;
    saccade.place = ScreenPoint{1.0, 2.0};
    saccade.arrival = ScreenPoint{3.0, 4.0};
    saccade.amplitude_deg = 2.5F;
    saccade.peak_velocity_deg_s = 210.0F;
    fixation.kind = GazeEvent::Kind::fixation;
    fixation.end = TrackerTime(9ms);
    fixation.pupil = 700.0F;
    const TrackerItem items[] = {
        saccade,
        fixation,
        TrackerInput{TrackerTime(7ms), 4'000'000'000U},
        TrackerButton{TrackerTime(8ms), 5, true},
        TrackerButton{TrackerTime(9ms), 12, false},
        TrackerGap{TrackerGap::Reason::overflow, TrackerTime(10ms), 17},
        TrackerGap{TrackerGap::Reason::connection, TrackerTime(11ms), 0},
        TrackerGap{TrackerGap::Reason::unreadable, TrackerTime(12ms), 1},
    };
    for (const TrackerItem& item : items) {
        const std::optional<GazeEvent> words = gaze_event_of(item);
        REQUIRE(words);
        const std::optional<TrackerItem> again = tracker_item_of(*words);
        REQUIRE(again);
        CHECK(again->index() == item.index());
        CHECK(gaze_event_of(*again) == words);
    }
}

TEST_CASE("messages and notes of other things are no item of a tracker", "[unit]") {
    for (const char* const text : {"", "data lost", "data lost (moon): 3 samples", "calibration 9 points"}) {
        GazeEvent note;
        note.kind = GazeEvent::Kind::note;
        note.text = text;
        CHECK_FALSE(tracker_item_of(note));
    }
    for (const char* const text : {"", "x", "5", "5 "}) {
        GazeEvent button;
        button.kind = GazeEvent::Kind::button;
        button.text = text;
        CHECK_FALSE(tracker_item_of(button));
    }
    GazeEvent message;
    message.text = "TRIALID 1";
    CHECK_FALSE(tracker_item_of(message));
}
