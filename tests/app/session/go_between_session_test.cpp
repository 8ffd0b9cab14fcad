// Sessions whose pictures something else than the X server shows, or copies.
#include <catch2/catch.hpp>

#include <nlohmann/json.hpp>

#include "experiment/record/read/session_record.h"
#include "render/window/window_system.h"
#include "tests/app/session/windowed_run.h"
#include "tests/support/go_between.h"
#include "tests/support/skip.h"
#include "tests/support/tsv_file.h"
#include "tests/support/virtual_screen.h"

using namespace overt;
using namespace overt::test;

namespace {

std::string protocol_with(const char* timing) {
    return with(with(small_protocol, "refresh_hz = 120", "refresh_hz = 60"), "output = \"color++\"",
                std::string("output = \"native-8bit\"\ngamma = 2.2\nlinearised_by = \"none\"\ntiming = \"") +
                    timing + "\"");
}

ProgramRun run_in_real_time(const SmallExperiment& experiment) {
    return run_overt(
        windowed_run(experiment, {"--simulate-observer", "5", "--trials", "1", "--refresh-check", "1"}),
        x_server_alone);
}

/// The weight of a finding of `overt doctor --window`, and what it says.
std::pair<std::string, std::string> found_by_doctor(const std::string& what) {
    const ProgramRun run =
        run_overt({"doctor", "--window", "--windowed", "--seconds", "1", "--json"}, x_server_alone);
    INFO(run.out << run.err);
    CHECK(run.exit_code == 1);
    const auto found = nlohmann::json::parse(run.out);
    for (const auto& finding : found["screen"])
        if (finding["what"] == what)
            return {finding["weight"], finding["finding"]};
    return {};
}

} // namespace

TEST_CASE("a session whose pictures are copied is refused; its record says how many were flipped otherwise",
          "[session][waits]") {
    const auto screen = VirtualScreen::start(800, 600, 24);
    const SmallExperiment refused(protocol_with("proven"));
    const ProgramRun run = run_in_real_time(refused);
    INFO(run.err);
    CHECK(run.exit_code == 2);
    CHECK(run.err.find("copied into the window") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(refused.sessions()));

    const SmallExperiment tried(protocol_with("unproven"));
    const ProgramRun trial_run = run_in_real_time(tried);
    INFO(trial_run.err);
    REQUIRE(trial_run.exit_code == 0);
    CHECK(trial_run.err.find("risk: pictures:") != std::string::npos);
    const std::string session = tried.session(1).string();
    // Software shows its pictures past Present, which says so of each presentation.
    CHECK(SessionRecord(session).trials().at(0).outcome.swaps == SwapModes{});
    const auto out = tried.folder().path() / "tables";
    REQUIRE(tried.overt({"export", session, "--out", out.string()}).exit_code == 0);
    CHECK(TsvFile(out / "trials.tsv").text(0, "swaps_copied") == "0");

    // In virtual time nobody is asked.
    REQUIRE(tried.run({"--trials", "1"}).exit_code == 0);
    CHECK_FALSE(SessionRecord(tried.session(2)).trials().at(0).outcome.swaps);
    const auto virtual_out = tried.folder().path() / "virtual";
    REQUIRE(tried.overt({"export", tried.session(2).string(), "--out", virtual_out.string()}).exit_code == 0);
    CHECK(TsvFile(virtual_out / "trials.tsv").text(0, "swaps_copied") == "n/a");
}

TEST_CASE("a session under a compositor is refused by its name with the remedy, and the doctor says the same",
          "[session]") {
    const auto screen = VirtualScreen::start(800, 600, 24);
    CHECK(found_by_doctor("compositor").first == "good");
    const auto picom = Picom::start([] { return examine_window_system().has_compositor; });
    if (!picom)
        OVERT_SKIP("picom is not installed");
    const SmallExperiment experiment(protocol_with("proven"));
    const ProgramRun run = run_in_real_time(experiment);
    INFO(run.err);
    CHECK(run.exit_code == 2);
    CHECK(run.err.find("a compositor (picom)") != std::string::npos);
    CHECK(run.err.find("turn the compositor off for the session") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(experiment.sessions()));
    CHECK(found_by_doctor("compositor").first == "refused");
    CHECK(run_overt({"doctor"}, x_server_alone).out.find("X11 with a compositor, picom") !=
          std::string::npos);
}

TEST_CASE("Xwayland is no screen for a session, whatever the environment says of Wayland", "[session]") {
    const auto desktop = WaylandDesktop::start();
    if (!desktop)
        OVERT_SKIP("weston is not installed");
    if (!examine_window_system().is_x11)
        OVERT_SKIP("Xwayland is not installed");
    CHECK(examine_window_system().is_xwayland);
    const SmallExperiment experiment(protocol_with("proven"));
    const ProgramRun run = run_in_real_time(experiment);
    INFO(run.err);
    CHECK(run.exit_code == 2);
    CHECK(run.err.find("the X server is Xwayland") != std::string::npos);
    CHECK(run.err.find("log in to a session of X11") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(experiment.sessions()));
    const auto [weight, finding] = found_by_doctor("compositor");
    CHECK(weight == "refused");
    CHECK(finding.find("Xwayland") != std::string::npos);
    CHECK(run_overt({"doctor"}, x_server_alone).out.find("Wayland, through Xwayland") != std::string::npos);
}
