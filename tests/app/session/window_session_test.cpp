#include <catch2/catch.hpp>

#include <nlohmann/json.hpp>

#include "experiment/base/whole_file.h"
#include "experiment/record/read/session_record.h"
#include "tests/app/session/windowed_run.h"
#include "tests/support/tsv_file.h"
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

std::string native_at(int refresh_hz, const std::string& timing = "timing = \"unproven\"") {
    return with(with(small_protocol, "refresh_hz = 120", "refresh_hz = " + std::to_string(refresh_hz)),
                "output = \"color++\"",
                "output = \"native-8bit\"\ngamma = 2.2\nlinearised_by = \"none\"\n" + timing);
}

} // namespace

TEST_CASE("a session in real time is stamped by the server's vertical blanks, and records what it measured",
          "[session][waits]") {
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
    // A period of the animation, before the first trial: 31 frames of which the last is the first again.
    const std::vector<RecordedEvent> events = record.events();
    const auto check = std::ranges::find(events, "presentation check", &RecordedEvent::kind);
    REQUIRE(check != events.end());
    CHECK(check->trial == -1);
    CHECK(check->at < record.trials()[0].outcome.task_screen_onset);
    CHECK(check->detail.find("from picture to picture in ms: least ") != std::string::npos);
    CHECK(run.out.find("presentation check: ") != std::string::npos);
    // Its own rows are not in the record, and its folder is gone.
    CHECK(flips.size() <= 60);
    for (const auto& entry : std::filesystem::directory_iterator(experiment.session(1).parent_path()))
        CHECK(entry.path().filename().string().find("presentation-check") == std::string::npos);
    // Xvfb counts 60 refreshes a second by a timer.
    CHECK(std::stod("0" + measured.substr(std::min(measured.size(), sizeof "measured refresh:"))) ==
          Approx(60.0).epsilon(0.005));
}

TEST_CASE("a session whose times nothing proves is refused with the remedy, and leaves nothing",
          "[session][waits]") {
    const auto screen = VirtualScreen::start(800, 600, 24);
    for (const char* const timing : {"", "timing = \"proven\""}) {
        const SmallExperiment experiment(native_at(60, timing));
        const ProgramRun run = run_overt(in_real_time(experiment), x_server_alone);
        INFO(run.err);
        CHECK(run.exit_code == 2);
        CHECK(run.err.find("[display]") != std::string::npos);
        CHECK(run.err.find("by a timer") != std::string::npos);
        CHECK(run.err.find("timing = \"unproven\"") != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(experiment.sessions()));
        // What measures nothing proves nothing.
        const ProgramRun unmeasured = run_overt(
            windowed_run(experiment, {"--simulate-observer", "5", "--trials", "1", "--refresh-check", "0"}),
            x_server_alone);
        INFO(unmeasured.err);
        CHECK(unmeasured.exit_code == 2);
        CHECK(unmeasured.err.find("--refresh-check 0") != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(experiment.sessions()));
    }
}

TEST_CASE("where nothing proves the times, the record, its exports and reports claim no missed refreshes",
          "[session][waits]") {
    const auto screen = VirtualScreen::start(800, 600, 24);
    const SmallExperiment experiment(native_at(60));
    const ProgramRun run = run_overt(in_real_time(experiment), x_server_alone);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(run.out.find("missed refreshes: unproven") != std::string::npos);
    const std::string session = experiment.session(1).string();
    CHECK(SessionRecord(session).header().display.timing == "unproven");

    const ProgramRun shown = experiment.overt({"show", session});
    CHECK(shown.out.find("missed: unproven") != std::string::npos);
    CHECK(shown.out.find("0 missed") == std::string::npos);
    const auto json = nlohmann::json::parse(experiment.overt({"show", session, "--json"}).out);
    CHECK(json["timing_proof"] == "unproven");
    CHECK(json["timing"]["missed_refreshes"] == "unproven");
    CHECK(json["trials"][0]["missed_refreshes"] == "unproven");

    const auto out = experiment.folder().path();
    REQUIRE(experiment.overt({"export", session, "--out", (out / "tables").string()}).exit_code == 0);
    const TsvFile trials(out / "tables" / "trials.tsv"), flips(out / "tables" / "flips.tsv");
    CHECK(trials.text(0, "timing") == "unproven");
    CHECK(trials.text(0, "missed_refreshes") == "n/a");
    CHECK(flips.text(0, "missed") == "n/a");
    CHECK(read_whole_file(out / "tables" / "dictionary.json").find("unproven") != std::string::npos);

    REQUIRE(
        experiment.overt({"export", session, "--format", "asc", "--out", (out / "asc").string()}).exit_code ==
        0);
    REQUIRE(experiment.overt({"export", session, "--format", "bids", "--out", (out / "bids").string()})
                .exit_code == 0);
    REQUIRE(experiment.overt({"analyze", session, "--out", (out / "study").string()}).exit_code == 0);
    const auto says_unproven = [&](const char* folder, const std::string& ending) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(out / folder))
            if (entry.is_regular_file() && entry.path().string().ends_with(ending) &&
                read_whole_file(entry.path()).find("unproven") != std::string::npos)
                return true;
        return false;
    };
    CHECK(says_unproven("asc", ".asc"));
    CHECK(says_unproven("bids", "_events.tsv"));
    CHECK(says_unproven("study", ".html"));
}

TEST_CASE("sessions in virtual time need no proof of their times, and say none", "[session]") {
    const SmallExperiment experiment;
    REQUIRE(experiment.run({"--trials", "1"}).exit_code == 0);
    CHECK(SessionRecord(experiment.session(1)).header().display.timing == "none");
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
