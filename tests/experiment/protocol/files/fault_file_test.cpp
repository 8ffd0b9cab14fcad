#include "experiment/protocol/files/fault_file.h"

#include <catch2/catch.hpp>

using namespace overt;
using Kind = DisplayFault::Kind;

TEST_CASE("a fault file says what goes wrong, where and how much", "[unit]") {
    Diagnostics diagnostics;
    const auto faults = read_fault_text(R"([display]
drift_ppm = -40
jitter_sd_ms = 0.25
time_stamps = "bare"
[chance]
seed = 9
late_share = 0.5
skip_share = 0.25
skip_max_refreshes = 7
[[fault]]
kind = "late"
trial = 3
refresh = 100
ms = 12.5
[[fault]]
kind = "skip"
refresh = 0
refreshes = 4
[[fault]]
kind = "stamp"
refresh = 5
ms = -3
)",
                                        "faults.toml", diagnostics);
    CHECK(diagnostics.print() == "");
    REQUIRE(faults.has_value());
    CHECK(faults->drift_ppm == -40.0);
    CHECK(faults->jitter_sd_ms == 0.25);
    CHECK_FALSE(faults->counts_refreshes);
    CHECK(faults->seed == 9);
    CHECK(faults->by_chance.late_share == 0.5);
    CHECK(faults->by_chance.skip_max_refreshes == 7);
    CHECK(faults->given == std::vector<DisplayFault>{{Kind::late, 2, 100, 12.5, 1},
                                                     {Kind::skip, std::nullopt, 0, 0.0, 4},
                                                     {Kind::stamp, std::nullopt, 5, -3.0, 1}});
    CHECK_FALSE(faults->is_clean());
    CHECK(DisplayFaults{}.is_clean());
}

TEST_CASE("all that is wrong with a fault file is found at once, each with its place", "[unit]") {
    Diagnostics diagnostics;
    CHECK_FALSE(read_fault_text(R"([displai]
[chance]
late_share = 1.5
stall_min_ms = 9
stall_max_ms = 8
[[fault]]
kind = "lat"
refresh = 1
[[fault]]
kind = "skip"
ms = 3
[[fault]]
kind = "stall"
refresh = 0
ms = 5
)",
                                "f.toml", diagnostics)
                    .has_value());
    std::vector<int> lines;
    for (const Finding& finding : diagnostics.findings())
        lines.push_back(finding.place.line);
    CHECK(lines == std::vector<int>{1, 2, 3, 6, 7, 9, 9, 12});
    CHECK(diagnostics.print().find("did you mean \"display\"?") != std::string::npos);
    CHECK_FALSE(read_fault_file("/no/such/file.toml", diagnostics).has_value());
}

TEST_CASE("faults by chance are a function of seed and trial, and one share moves no other", "[unit]") {
    DisplayFaults faults;
    faults.seed = 4;
    faults.by_chance.skip_share = 0.01;
    const auto first = faults_in(faults, 2, 10'000);
    CHECK(first == faults_in(faults, 2, 10'000));
    CHECK(first != faults_in(faults, 3, 10'000));
    CHECK(static_cast<double>(first.size()) == Approx(100.0).margin(40.0));
    faults.by_chance.late_share = 0.02;
    auto with_late = faults_in(faults, 2, 10'000);
    std::erase_if(with_late, [](const DisplayFault& fault) { return fault.kind == Kind::late; });
    CHECK(with_late == first);
}

TEST_CASE("a fault file says what goes wrong with the eye tracker", "[unit]") {
    using Tracker = TrackerFault::Kind;
    Diagnostics diagnostics;
    const auto faults = read_fault_text(R"([tracker]
granted_rate_hz = 250
[[tracker-fault]]
kind = "stall"
trial = 2
attempt = 3
at_s = 0.5
s = 2
[[tracker-fault]]
kind = "clock-jump"
at_s = 1
ms = -40
[[tracker-fault]]
kind = "unplug"
trial = 1
at_s = 0
refusals = 2
[[tracker-fault]]
kind = "calibration"
number = 2
)",
                                        "faults.toml", diagnostics);
    CHECK(diagnostics.print() == "");
    REQUIRE(faults.has_value());
    CHECK(faults->is_clean()); // of the display
    CHECK(faults->tracker.granted_rate_hz == 250.0);
    CHECK(faults->tracker.given ==
          std::vector<TrackerFault>{{.kind = Tracker::stall, .trial = 1, .attempt = 3, .at_s = 0.5, .s = 2.0},
                                    {.kind = Tracker::clock_jump, .at_s = 1.0, .ms = -40.0},
                                    {.kind = Tracker::unplug, .trial = 0, .refusals = 2},
                                    {.kind = Tracker::calibration, .number = 2}});
    CHECK(TrackerFaults{}.are_none());
    CHECK_FALSE(faults->tracker.are_none());
}

TEST_CASE("keys that an eye tracker's fault does not have, or lacks, are found", "[unit]") {
    Diagnostics diagnostics;
    CHECK_FALSE(read_fault_text(R"([[tracker-fault]]
kind = "gap"
ms = 4
[[tracker-fault]]
kind = "calibration"
trial = 2
[[tracker-fault]]
kind = "repeat"
refusals = 1
[[tracker-fault]]
kind = "silence"
)",
                                "faults.toml", diagnostics));
    const std::string said = diagnostics.print();
    CAPTURE(said);
    for (const char* const expected :
         {"faults.toml:3:6: error: an eye tracker's fault of kind \"gap\" has no \"ms\"",
          "faults.toml:1:1: error: an eye tracker's fault of kind \"gap\" needs \"s\"",
          "faults.toml:6:9: error: an eye tracker's fault of kind \"calibration\" has no \"trial\"",
          "faults.toml:9:12: error: an eye tracker's fault of kind \"repeat\" has no \"refusals\"",
          "\"silence\""})
        CHECK(said.find(expected) != std::string::npos);
}
