#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "devices/display_box/display_plus_plus.h"
#include "experiment/record/read/session_record.h"
#include "tests/app/display/screen_box.h"
#include "tests/app/small_experiment.h"
#include "tests/support/running_program.h"
#include "tests/support/tsv_file.h"
#include "tests/support/virtual_screen.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

constexpr int width = 544, height = 192;
constexpr double rate_hz = 60.0;

/// A small experiment on a screen with a box behind it.
struct Rigged {
    std::unique_ptr<ScreenBox> box = ScreenBox::start(width, height, rate_hz);
    std::unique_ptr<SmallExperiment> experiment =
        std::make_unique<SmallExperiment>(protocol("box = \"" + box->port() + "\"\n"));
    TemporaryFolder state;

    static std::string protocol(const std::string& box) {
        const std::string at_60_hz = with(small_protocol, "refresh_hz = 120", "refresh_hz = 60");
        const std::string light = box.find("none") == std::string::npos
                                      ? "linearised_by = \"box\"\nbox_gamma_table = \"lab3.txt\"\n"
                                        "video_check_days = 0\n"
                                      : "linearised_by = \"display\"\n";
        return with(at_60_hz, "output = \"color++\"\n",
                    "output = \"color++\"\ntiming = \"unproven\"\n" + light + box);
    }
    std::vector<std::string> environment() const {
        std::vector<std::string> all = x_server_alone;
        all.insert(all.end(),
                   {"OVERT_STATE=" + state.path().string(), "OVERT_CACHE=" + experiment->cache().string()});
        return all;
    }
    std::vector<std::string> session(int trials) const {
        return {"run",
                experiment->protocol().string(),
                "--observer",
                "P01",
                "--simulate-observer",
                "5",
                "--seed",
                "7",
                "--refresh-check",
                "0", // a busy machine would not have it
                "--sessions",
                experiment->sessions().string(),
                "--trials",
                std::to_string(trials)};
    }
    ProgramRun overt(const std::vector<std::string>& arguments) const {
        return run_overt(arguments, environment());
    }
    std::filesystem::path note() const { return state.path() / "display-switched.txt"; }
    std::filesystem::path said() const { return state.path() / "said"; }

    /// Until it holds, or a minute has passed.
    template <class Stimulus> static bool comes_true(Stimulus stimulus) {
        const auto give_up = std::chrono::steady_clock::now() + 60s;
        while (!stimulus()) {
            if (std::chrono::steady_clock::now() > give_up)
                return false;
            std::this_thread::sleep_for(5ms);
        }
        return true;
    }
    /// Until the first trial is under way.
    bool comes_to_a_trial() const {
        return comes_true([&] {
            if (!std::filesystem::exists(experiment->session() / "session.sqlite"))
                return false;
            try {
                return !SessionRecord(experiment->session()).trials().empty();
            } catch (const std::exception&) {
                return false; // not begun yet
            }
        });
    }
};

std::vector<std::string> event_kinds_of(const SessionRecord& record) {
    std::vector<std::string> kinds;
    for (const RecordedEvent& event : record.events())
        kinds.push_back(event.kind);
    return kinds;
}

bool holds(const std::vector<std::string>& words, const std::string& word) {
    return std::ranges::find(words, word) != words.end();
}

} // namespace

TEST_CASE("every output mode with T-Lock has a mode of the box, and no other has", "[unit]") {
    for (const OutputModeRow& row : output_modes) {
        CAPTURE(row.name);
        CHECK(box_mode_called(row.name).has_value() == (row.top_rows == TopRows::t_lock));
    }
}

TEST_CASE("a session on a screen switches the display box, relates its clock and switches it back",
          "[session][waits]") {
    const Rigged rig;
    const ProgramRun run = rig.overt(rig.session(2));
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(rig.box->mode() == "BitsPlusPlus");
    CHECK(rig.box->was_told("colorPlusPlus"));
    CHECK(rig.box->was_told("TemporalDithering"));
    CHECK(rig.box->gamma_table() == "lab3.txt"); // the protocol's
    CHECK(rig.box->clock_resets() >= 1);
    CHECK_FALSE(std::filesystem::exists(rig.note()));

    const SessionRecord record(rig.experiment->session());
    const auto boxes = record.display_boxes();
    REQUIRE(boxes.size() == 1);
    const RecordedBox& box = boxes.front().second;
    CHECK(box.use == RecordedBox::Use::box);
    CHECK(box.serial_number == "DPP-0042");
    CHECK(box.firmware_date == "Mar 14 2018");
    CHECK(box.mode == "Color++");
    CHECK(box.port == rig.box->port());
    CHECK(box.video_rate_hz == rate_hz);
    CHECK(box.settled_after > SessionDuration::zero());
    CHECK(holds(event_kinds_of(record), "display box left"));

    // The box's clock and the session's are the same machine's: no drift, and a second is a second.
    const auto readings = record.box_clock_readings(1);
    REQUIRE(readings.size() >= 1 + 5 + 2 + 1); // the reset, after it, after each trial, at the end
    const BoxClockFit fit = fit_box_clock(readings);
    CHECK(std::abs(fit.drift_ppm) <= fit.drift_uncertainty_ppm);
    CHECK(readings.front().other == BoxTime());
    CHECK(fit.zero >= readings.front().before - fit.uncertainty);
    CHECK(fit.zero <= readings.front().after + fit.uncertainty);
    // No question was asked during a presentation.
    for (const TrialRecord& trial : record.trials())
        for (const BoxClockPair& reading : readings)
            CHECK((reading.after < trial.outcome.presentation_onset ||
                   reading.before > trial.outcome.presentation_end));

    const ProgramRun exported = rig.overt({"export", rig.experiment->session().string()});
    REQUIRE(exported.exit_code == 0);
    const TsvFile table(rig.experiment->session() / "export_tsv" / "display_box.tsv");
    CHECK(table.text(0, "serial_number") == "DPP-0042");
    CHECK(table.text(0, "clock_readings") == std::to_string(readings.size()));
}

TEST_CASE("a session that is killed leaves a note, and the next start switches the display box back",
          "[session][waits]") {
    const Rigged rig;
    {
        RunningProgram session(rig.session(9), rig.environment(), rig.said());
        const bool began = rig.comes_to_a_trial();
        INFO(text_of(rig.said()));
        REQUIRE(began);
        session.signal(SIGKILL);
        CHECK(session.wait() == 128 + SIGKILL);
    }
    REQUIRE(rig.box->mode() == "colorPlusPlus");
    REQUIRE(std::filesystem::exists(rig.note()));
    SECTION("display status") {
        const ProgramRun status = rig.overt({"display", "status", "--port", rig.box->port()});
        INFO(status.out << status.err);
        CHECK(status.exit_code == 0);
        CHECK_THAT(status.out, Contains("was left in Color++ mode") && Contains("back in Bits++"));
    }
    SECTION("run") {
        const ProgramRun run = rig.overt(rig.session(1));
        INFO(run.out << run.err);
        CHECK(run.exit_code == 0);
        CHECK_THAT(run.err, Contains("was left in Color++ mode") && Contains("back in Bits++"));
    }
    CHECK(rig.box->mode() == "BitsPlusPlus");
    CHECK_FALSE(std::filesystem::exists(rig.note()));
}

TEST_CASE("Ctrl-C ends a session in order, with the display box switched back", "[session][waits]") {
    const Rigged rig;
    RunningProgram session(rig.session(9), rig.environment(), rig.said());
    REQUIRE(rig.comes_to_a_trial());
    session.signal(SIGINT);
    CHECK(session.wait() == 1);
    INFO(text_of(rig.said()));
    CHECK_THAT(text_of(rig.said()), Contains("interrupted by a signal"));
    CHECK(rig.box->mode() == "BitsPlusPlus");
    CHECK_FALSE(std::filesystem::exists(rig.note()));
    const SessionRecord record(rig.experiment->session());
    CHECK(record.closed_in_order());
    CHECK(record.trials().size() < 9);
}

TEST_CASE("a display box that was restarted within a session ends it", "[session][waits]") {
    const Rigged rig;
    RunningProgram session(rig.session(9), rig.environment(), rig.said());
    REQUIRE(rig.comes_to_a_trial());
    rig.box->restart();
    CHECK(session.wait() == 1);
    INFO(text_of(rig.said()));
    CHECK_THAT(text_of(rig.said()), Contains("restarted or reset") && Contains("Color++"));
    const SessionRecord record(rig.experiment->session());
    CHECK(holds(event_kinds_of(record), "display box lost"));
    CHECK(record.trials().size() < 9);
}

TEST_CASE("a box that is missing, of another rate, or not asked for is never passed over in silence",
          "[session][waits]") {
    const Rigged rig;
    SECTION("missing: refused, with how to go on, and nothing is left") {
        const SmallExperiment experiment(Rigged::protocol("box = \"/dev/no-such-port\"\n"));
        std::vector<std::string> arguments = rig.session(1);
        arguments[1] = experiment.protocol().string();
        const ProgramRun run = rig.overt(arguments);
        CHECK(run.exit_code == 2);
        CHECK_THAT(run.err, Contains("/dev/no-such-port") && Contains("overt display status") &&
                                Contains("box = \"none\""));
        CHECK_FALSE(std::filesystem::exists(rig.experiment->sessions()));
    }
    SECTION("another rate: refused") {
        const SmallExperiment experiment(with(Rigged::protocol("box = \"" + rig.box->port() + "\"\n"),
                                              "refresh_hz = 60", "refresh_hz = 30"));
        std::vector<std::string> arguments = rig.session(1);
        arguments[1] = experiment.protocol().string();
        const ProgramRun run = rig.overt(arguments);
        INFO(run.err);
        CHECK(run.exit_code == 2);
        CHECK_THAT(run.err, Contains("Hz") && Contains("refresh_hz"));
        CHECK(rig.box->mode() == "BitsPlusPlus");
        CHECK_FALSE(std::filesystem::exists(rig.note()));
    }
    SECTION("none, by the protocol: on record") {
        const SmallExperiment experiment(Rigged::protocol("box = \"none\"\n"));
        std::vector<std::string> arguments = rig.session(1);
        arguments[1] = experiment.protocol().string();
        const ProgramRun run = rig.overt(arguments);
        INFO(run.err);
        CHECK(run.exit_code == 0);
        CHECK(SessionRecord(rig.experiment->session()).display_boxes().front().second.use ==
              RecordedBox::Use::declined);
        CHECK(rig.box->commands().empty());
    }
    SECTION("in virtual time: simulated, on record") {
        std::vector<std::string> arguments = rig.session(1);
        arguments.emplace_back("--virtual-time");
        const ProgramRun run = rig.overt(arguments);
        INFO(run.err);
        CHECK(run.exit_code == 0);
        CHECK(SessionRecord(rig.experiment->session()).display_boxes().front().second.use ==
              RecordedBox::Use::simulated);
        CHECK(rig.box->commands().empty());
    }
}

TEST_CASE("display mode switches with a read-back and keeps it, status tells", "[session]") {
    const Rigged rig;
    const ProgramRun switched = rig.overt({"display", "mode", "mono++", "--port", rig.box->port()});
    INFO(switched.out << switched.err);
    REQUIRE(switched.exit_code == 0);
    CHECK(rig.box->mode() == "monoPlusPlus");
    CHECK_THAT(switched.out, Contains("Mono++") && Contains("60.00 Hz") && Contains("cannot be asked"));
    // On a busy machine the simulated box, a thread of ours, may answer later than a box ever does.
    ProgramRun status;
    const bool found = Rigged::comes_true([&] {
        status = rig.overt({"display", "status", "--port", rig.box->port(), "--json"});
        return status.exit_code == 0;
    });
    INFO(status.out << status.err);
    REQUIRE(found);
    const auto json = nlohmann::json::parse(status.out);
    CHECK(json["ports"][0]["serial_number"] == "DPP-0042");
    CHECK(json["ports"][0]["video_rate_hz"] == rate_hz);
    CHECK(json["note"]["mode"] == "Mono++");
    CHECK(json["note"]["kept"] == true);
    CHECK(json["switched_back"].is_null());
    CHECK(rig.box->mode() == "monoPlusPlus");
    REQUIRE(rig.overt({"display", "mode", "bits++", "--port", rig.box->port()}).exit_code == 0);
    CHECK(rig.box->mode() == "BitsPlusPlus");
    CHECK_FALSE(std::filesystem::exists(rig.note()));
}

TEST_CASE("display commands refuse what they cannot do in a sentence", "[session]") {
    const TemporaryFolder state;
    const std::vector<std::string> environment{"OVERT_STATE=" + state.path().string(),
                                               "DISPLAY=", "WAYLAND_DISPLAY="};
    CHECK(run_overt({"display", "mode", "colour"}, environment).exit_code == 2);
    const ProgramRun status = run_overt({"display", "status", "--port", "/dev/no-such-port"}, environment);
    CHECK(status.exit_code == 1);
    CHECK_THAT(status.out, Contains("/dev/no-such-port cannot be opened") && Contains("no display box"));
    const ProgramRun mode =
        run_overt({"display", "mode", "bits++", "--port", "/dev/no-such-port"}, environment);
    CHECK(mode.exit_code == 1);
    CHECK_THAT(mode.err, Contains("/dev/no-such-port cannot be opened"));
    const ProgramRun verify = run_overt({"display", "verify", "--hardware"}, environment);
    CHECK(verify.exit_code == 2);
    CHECK_THAT(verify.err, Contains("there is no display to draw on"));
}

TEST_CASE("display verify --hardware finds what the way from the graphics card to the box changed",
          "[session]") {
    const Rigged rig;
    const std::vector<std::string> arguments{"display", "verify", "--hardware", "--port", rig.box->port()};
    SECTION("nothing") {
        const ProgramRun run = rig.overt(arguments);
        INFO(run.out << run.err);
        CHECK(run.exit_code == 0);
        CHECK_THAT(run.out, Contains("arrived as they were drawn") && !Contains("MISSED"));
    }
    SECTION("a shift by a pixel") {
        rig.box->distort([](const SeenScreen& seen, int x, int y) {
            return x == 0 ? RgbBytes{} : RgbBytes(seen.at(x - 1, y));
        });
        const ProgramRun run = rig.overt(arguments);
        INFO(run.out << run.err);
        CHECK(run.exit_code == 1);
        CHECK_THAT(run.out, Contains("moved 1 px to the right"));
    }
    SECTION("dithering in time") {
        rig.box->distort([count = 0](const SeenScreen& seen, int x, int y) mutable {
            RgbBytes bytes = seen.at(x, y);
            bytes[2] = static_cast<std::uint8_t>(bytes[2] ^ (++count % 7 == 0 ? 1 : 0));
            return bytes;
        });
        const ProgramRun run = rig.overt(arguments);
        INFO(run.out << run.err);
        CHECK(run.exit_code == 1);
        CHECK_THAT(run.out, Contains("differently each time"));
    }
    SECTION("a gamma table") {
        rig.box->distort([](const SeenScreen& seen, int x, int y) {
            RgbBytes bytes = seen.at(x, y);
            for (auto& byte : bytes)
                byte = static_cast<std::uint8_t>(std::min(255, byte + (byte > 100 ? 1 : 0)));
            return bytes;
        });
        const ProgramRun run = rig.overt(arguments);
        INFO(run.out << run.err);
        CHECK(run.exit_code == 1);
        CHECK_THAT(run.out, Contains("changed for good"));
    }
    CHECK(rig.box->mode() == "BitsPlusPlus");
    CHECK_FALSE(std::filesystem::exists(rig.note()));
}

TEST_CASE("a session through a box wants to know that its bytes arrive, and has on record who said so",
          "[session][waits]") {
    const Rigged rig;
    const std::vector<std::string> verify{"display", "verify", "--hardware", "--port", rig.box->port()};
    const std::string asked = with(text_of(rig.experiment->protocol()), "video_check_days = 0\n", "");
    std::ofstream(rig.experiment->protocol()) << asked;
    const auto screen_events = [&](int session) {
        std::string all;
        const SessionRecord record(rig.experiment->session(session));
        for (const RecordedEvent& event : record.events())
            all += event.detail + "\n";
        return all;
    };
    const auto refused = [&] {
        const ProgramRun run = rig.overt(rig.session(1));
        INFO(run.out);
        CHECK(run.exit_code == 2);
        return run.err;
    };
    const auto runs = [&] {
        const ProgramRun run = rig.overt(rig.session(1));
        INFO(run.out << run.err);
        REQUIRE(run.exit_code == 0);
    };

    CHECK_THAT(refused(), Contains("never checked with the box DPP-0042") &&
                              Contains("overt display verify --hardware") &&
                              Contains("video_check_days = 0"));
    CHECK_FALSE(std::filesystem::exists(rig.experiment->sessions()));
    CHECK(rig.box->mode() == "BitsPlusPlus");

    // Without the wish for one, the record says that there was none.
    std::ofstream(rig.experiment->protocol())
        << with(asked, "linearised_by", "video_check_days = 0\nlinearised_by");
    runs();
    CHECK_THAT(screen_events(1), Contains("bytes at the box: not checked, as the protocol says"));
    std::ofstream(rig.experiment->protocol()) << asked;

    // Once it was seen, the session runs.
    REQUIRE(rig.overt(verify).exit_code == 0);
    runs();
    CHECK_THAT(screen_events(2), Contains("bytes at the box: as drawn: checked on"));

    // A check that failed takes the place of one that passed.
    rig.box->distort([](const SeenScreen& seen, int x, int y) {
        return x == 0 ? RgbBytes{} : RgbBytes(seen.at(x - 1, y));
    });
    REQUIRE(rig.overt(verify).exit_code == 1);
    CHECK_THAT(refused(), Contains("failed") && Contains("moved 1 px to the right"));
}
