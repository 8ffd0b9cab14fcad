/// Whose fault it was.
#include "experiment/record/read/session_faults.h"

#include <catch2/catch.hpp>

#include "experiment/ports/event_kinds.h"
#include "tests/experiment/record/sealed_session.h"
#include "tests/support/temporary_folder.h"

using namespace overt;

TEST_CASE("a text of simulated faults tells whose they are", "[unit]") {
    const auto sides = [](std::string_view text) {
        const SimulatedSides told = simulated_sides(text);
        return std::string(told.display ? "d" : "") + (told.eye_tracker ? "t" : "");
    };
    CHECK(sides("[[tracker-fault]]\nkind = \"unplug\"\n") == "t");
    CHECK(sides("  [tracker]\ngranted_rate_hz = 500\n") == "t");
    CHECK(sides("[display]\njitter_sd_ms = 1\n") == "d");
    CHECK(sides("[[fault]]\nkind = \"late\"\n[[tracker-fault]]\nkind = \"gap\"\n") == "dt");
    CHECK(sides("chance.late_share = 0.1\n") == "d");
    CHECK(sides("# [[tracker-fault]]\n") == "d");
    CHECK(sides("") == "d");
}

TEST_CASE("faults are summed up by whose they are, of what kind and in which trials", "[unit]") {
    const std::vector<SessionFault> faults{{FaultSide::eye_tracker, 1, 0, "eye tracker lost", "unplugged"},
                                           {FaultSide::eye_tracker, 1, 4, "gaze lost", ""},
                                           {FaultSide::eye_tracker, 1, 0, "eye tracker lost", "still gone"},
                                           {FaultSide::eye_tracker, 1, 6, "gaze lost", ""},
                                           {FaultSide::sound, 1, 2, "answer recording", "clipped"},
                                           {FaultSide::machine, 1, -1, "machine slept", "1 s"}};
    CHECK(summary_of(faults) ==
          std::vector<std::string>{
              "eye tracker: eye tracker lost (trial 1): unplugged; gaze lost (trial 5, trial 7)",
              "spoken answers: answer recording (trial 3): clipped",
              "machine: machine slept (between trials): 1 s"});
    CHECK(summary_of({}).empty());
}

TEST_CASE("each event of a record that tells of a fault is its own device's, and all others are nobody's",
          "[unit]") {
    struct Told {
        std::string_view kind;
        const char* detail;
        int trial;
        std::optional<FaultSide> side;
    };
    const std::vector<Told> told{{tracker_event, "simulated: 1000 Hz", -1, {}},
                                 {marker_output_event, "serial port", -1, {}},
                                 {answer_recording_event, "44100 Hz", -1, {}},
                                 {keyboard_event, "came back", 0, {}},
                                 {tracker_lost_event, "unplugged", 0, FaultSide::eye_tracker},
                                 {tracker_regained_event, "", 0, {}},
                                 {tracker_clock_jumped_event, "-3 s", 1, FaultSide::eye_tracker},
                                 {calibration_failed_event, "", -1, FaultSide::eye_tracker},
                                 {drift_check_failed_event, "", 1, FaultSide::eye_tracker},
                                 {further_tracker_event, "left: eye tracker lost", 1, FaultSide::eye_tracker},
                                 {further_tracker_event, "left: eye tracker regained", 1, {}},
                                 {display_box_lost_event, "", 1, FaultSide::display},
                                 {keyboard_event, "went to another window", 1, FaultSide::response_device},
                                 {response_box_lost_event, "", 2, FaultSide::response_device},
                                 {answer_recording_event, "clipped", 2, FaultSide::sound},
                                 {machine_slept_event, "1 s", -1, FaultSide::machine},
                                 {operator_pressed_event, "skip", 2, {}}};
    const test::TemporaryFolder root;
    const std::filesystem::path session = overt::testing::make_whole_session(root.path());
    {
        SessionStore store(session / session_file_name, overt::testing::patient());
        for (const Told& one : told)
            store.event({overt::testing::at_ms(1), one.trial, std::string(one.kind), one.detail});
        // What an output of markers says at the end is what it failed at.
        store.event({overt::testing::at_ms(2), -1, std::string(phase_event),
                     std::string(name_of(SessionPhase::end))});
        store.event({overt::testing::at_ms(3), -1, std::string(marker_output_event), "3 were not sent"});
        store.close();
    }
    std::vector<std::string> expected, found;
    for (const FaultSide side : {FaultSide::eye_tracker, FaultSide::display, FaultSide::response_device,
                                 FaultSide::sound, FaultSide::markers, FaultSide::machine}) {
        for (const Told& one : told)
            if (one.side == side)
                expected.push_back(
                    fmt::format("{}: {} {} {}", name_of(side), one.trial, one.kind, one.detail));
        if (side == FaultSide::markers)
            expected.push_back(fmt::format("{}: -1 {} 3 were not sent", name_of(side), marker_output_event));
    }
    for (const SessionFault& fault : faults_of(SessionRecord(session)))
        found.push_back(
            fmt::format("{}: {} {} {}", name_of(fault.side), fault.trial, fault.what, fault.detail));
    CHECK(found == expected);
}
