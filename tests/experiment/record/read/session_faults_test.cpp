/// Whose fault it was.
#include "experiment/record/read/session_faults.h"

#include <catch2/catch.hpp>

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
          std::vector<std::string>{"eye tracker: eye tracker lost (trial 1); gaze lost (trial 5, trial 7)",
                                   "spoken answers: answer recording (trial 3)",
                                   "machine: machine slept (between trials)"});
    CHECK(summary_of({}).empty());
}
