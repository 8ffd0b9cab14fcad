#include <catch2/catch.hpp>

#include "app/small_experiment.h"
#include "experiment/record/session_record.h"
#include "support/virtual_screen.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("a session in a window in virtual time is the headless session", "[session]") {
    const auto screen = VirtualScreen::start(800, 600, 24);
    if (!screen) {
        WARN("Xvfb is missing: no window can be opened");
        return;
    }
    const SmallExperiment experiment;
    // The libraries behind a window keep memory until the end of the process.
    const ProgramRun run = experiment.run({"--context", "window", "--windowed"},
                                          {"WAYLAND_DISPLAY=", "ASAN_OPTIONS=detect_leaks=0"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    REQUIRE(experiment.run({"--context", "osmesa"}).exit_code == 0);

    const SessionRecord window(experiment.session(1)), headless(experiment.session(2));
    CHECK(window.header().graphics.context == "window");
    REQUIRE(window.trials().size() == small_trials);
    REQUIRE(headless.trials().size() == small_trials);
    for (std::size_t i = 0; i < window.trials().size(); ++i) {
        const TrialRecord &a = window.trials()[i], &b = headless.trials()[i];
        CHECK(a.status == TrialRecord::Status::completed);
        CHECK(a.trial == b.trial);
        CHECK(a.outcome.missed_refreshes == 0);
        CHECK(a.outcome.presentation_onset == b.outcome.presentation_onset);
        const std::vector<FlipRecord> flips = window.flips(a), expected = headless.flips(b);
        REQUIRE(flips.size() == 120);
        REQUIRE(expected.size() == 120);
        int differing = 0;
        for (std::size_t k = 0; k < flips.size(); ++k) {
            differing += flips[k].shown != expected[k].shown ||
                         flips[k].report.vertical_blank != expected[k].report.vertical_blank;
        }
        CHECK(differing == 0);
        CHECK(window.samples(a).size() == headless.samples(b).size());
    }
}

TEST_CASE("without a display a session in a window is refused, and leaves nothing", "[session]") {
    const SmallExperiment experiment;
    const ProgramRun run = experiment.run({"--context", "window"},
                                          {"DISPLAY=", "WAYLAND_DISPLAY=", "ASAN_OPTIONS=detect_leaks=0"});
    CHECK(run.exit_code == 1);
    CHECK(run.err.find("GLFW") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(experiment.sessions()));
}
