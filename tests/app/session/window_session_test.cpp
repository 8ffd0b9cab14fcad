#include <catch2/catch.hpp>

#include "experiment/record/read/session_record.h"
#include "tests/app/session/windowed_run.h"
#include "tests/support/virtual_screen.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("a session in a window in virtual time is the headless session", "[session]") {
    const auto screen = VirtualScreen::start(800, 600, 24);
    const SmallExperiment experiment;
    const ProgramRun run = experiment.run({"--context", "window", "--windowed"}, x_server_alone);
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

namespace {

/// A second and a half of presentation, so that real time does not become long.
std::vector<std::string> in_real_time(const SmallExperiment& experiment) {
    return windowed_run(experiment, {"--simulate-observer", "5", "--trials", "1", "--refresh-check", "2"});
}

std::string native_at(int refresh_hz) {
    return with(with(small_protocol, "refresh_hz = 120", "refresh_hz = " + std::to_string(refresh_hz)),
                "output = \"color++\"", "output = \"native-8bit\"\ngamma = 2.2\nlinearised_by = \"none\"");
}

} // namespace

TEST_CASE("a session in real time is stamped by the server's vertical blanks, and records what it measured",
          "[session]") {
    const auto screen = VirtualScreen::start(800, 600, 24);
    const SmallExperiment experiment(native_at(60));
    const ProgramRun run = run_overt(in_real_time(experiment), x_server_alone);
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(run.err.find("risk: swaps:") != std::string::npos);

    const SessionRecord record(experiment.session(1));
    REQUIRE(record.trials().size() == 1);
    const std::vector<FlipRecord> flips = record.flips(record.trials()[0]);
    REQUIRE_FALSE(flips.empty());
    for (const FlipRecord& flip : flips)
        CHECK(flip.report.source == VblankSource::present_count);
    std::string measured;
    for (const RecordedEvent& event : record.events())
        if (event.kind == "screen" && event.detail.find("measured refresh: ") == 0)
            measured = event.detail;
    INFO(measured);
    // Xvfb counts 60 refreshes a second by a timer.
    CHECK(std::stod("0" + measured.substr(std::min(measured.size(), sizeof "measured refresh:"))) ==
          Approx(60.0).epsilon(0.005));
}

TEST_CASE("a screen that is measured at another rate refuses the session, which leaves nothing",
          "[session]") {
    const auto screen = VirtualScreen::start(800, 600, 24);
    const SmallExperiment experiment(native_at(90));
    const ProgramRun run = run_overt(in_real_time(experiment), x_server_alone);
    CHECK(run.exit_code == 1);
    CHECK(run.err.find("measured refresh: ") != std::string::npos);
    CHECK(run.err.find("90 Hz") != std::string::npos);
    CHECK(run.err.find("refresh_hz") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(experiment.sessions()));
}

TEST_CASE("without a display a session in a window is refused, and leaves nothing", "[session]") {
    const SmallExperiment experiment;
    const ProgramRun run = experiment.run({"--context", "window"},
                                          {"DISPLAY=", "WAYLAND_DISPLAY=", "ASAN_OPTIONS=detect_leaks=0"});
    CHECK(run.exit_code == 1);
    CHECK(run.err.find("the desktop cannot be reached") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(experiment.sessions()));
}
