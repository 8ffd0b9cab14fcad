/// A session in a real window, led and answered by somebody at its keyboard.
#include <algorithm>
#include <functional>
#include <initializer_list>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/app/session/interrupted_run.h"
#include "tests/support/virtual_screen.h"

// Last: it defines words.
#include "experiment/ports/session_phase.h"
#include "tests/support/keyboard.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr const char* surroundings = R"(
[consent]
text = "Do you agree to take part?   J: ja   N: nein"
accept_key = "j"

[instructions]
pages = ["First page.", "Second page."]

[[observer_field]]
id = "age"
[[observer_field]]
id = "handedness"

[operator]
skip_reasons = ["eye lost", "wish"]

[words]
skip = "Durchgang überspringen?"
)";

std::string typed_protocol() {
    return with(
        with(fmt::format("{}{}", small_protocol, surroundings), "refresh_hz = 120", "refresh_hz = 60"),
        "output = \"color++\"", "output = \"native-8bit\"\ngamma = 2.2");
}

/// The arguments of a session in a window of its own.
std::vector<std::string> windowed_run(const SmallExperiment& experiment) {
    return {"run",
            experiment.protocol().string(),
            "--observer",
            "P01",
            "--context",
            "window",
            "--windowed",
            "--refresh-check",
            "0",
            "--seed",
            "7",
            "--sessions",
            experiment.sessions().string()};
}

/// Its environment: an X server alone, whatever desktop the tests run on.
std::vector<std::string> surroundings_of(const SmallExperiment& experiment) {
    return {"OVERT_CACHE=" + experiment.cache().string(),
            "WAYLAND_DISPLAY=", "XDG_SESSION_TYPE=", "ASAN_OPTIONS=detect_leaks=0"};
}

/// Somebody who presses keys until the session's record shows that they were taken.
class Somebody {
  public:
    Somebody(RunningProgram& program, const std::filesystem::path& session, Keyboard keyboard)
        : program_(program), session_(session), keyboard_(keyboard) {}

    /// Types all keys again each second until the record is so. False: the program ended, or a minute was
    /// over.
    bool type_until(std::initializer_list<KeySym> keys,
                    const std::function<bool(const SessionRecord&)>& is_so) {
        for (int tries = 0; tries < 60; ++tries) {
            for (const KeySym key : keys)
                keyboard_.type(key);
            for (int i = 0; i < 50; ++i) {
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
                try {
                    if (is_so(SessionRecord(session_)))
                        return true;
                } catch (const std::exception&) {
                    // Not there yet, or just being written.
                }
            }
            if (!program_.is_running())
                return false;
        }
        return false;
    }

  private:
    RunningProgram& program_;
    std::filesystem::path session_;
    Keyboard keyboard_;
};

/// How often the record has such an event.
auto has_event(const std::string& kind, const std::string& begin, int times = 1) {
    return [=](const SessionRecord& record) {
        const auto events = record.events();
        return std::count_if(events.begin(), events.end(), [&](const RecordedEvent& event) {
                   return event.kind == kind && event.detail.starts_with(begin);
               }) >= times;
    };
}

} // namespace

TEST_CASE("a session in a window is led by its keys: consent, form, pages, pause, skip, and an end that is "
          "asked for",
          "[session]") {
    const auto screen = VirtualScreen::start(800, 600, 24);
    Display* const display = XOpenDisplay(nullptr);
    REQUIRE(display);
    const SmallExperiment experiment(typed_protocol());
    const std::filesystem::path said = experiment.folder().path() / "said";
    {
        RunningProgram program(windowed_run(experiment), surroundings_of(experiment), said);
        const Window window = await_window(display);
        INFO(text_of(said));
        REQUIRE(window != 0);
        Somebody somebody(program, experiment.session(1), Keyboard(display, window));

        // A key that neither accepts nor declines does nothing.
        REQUIRE(somebody.type_until({XK_y, XK_space, XK_j}, [](const SessionRecord& record) {
            return record.consents().size() == 1;
        }));
        // What was typed before the form came is taken back first.
        REQUIRE(somebody.type_until(
            {XK_BackSpace, XK_BackSpace, XK_BackSpace, XK_BackSpace, XK_3, XK_1, XK_Return, XK_r, XK_Return},
            [](const SessionRecord& record) { return !record.observer_fields().empty(); }));
        REQUIRE(somebody.type_until({XK_F1}, has_event("operator", "pauses")));
        REQUIRE(somebody.type_until({XK_F1}, has_event("operator", "goes on")));
        REQUIRE(somebody.type_until({XK_space}, has_event(std::string(phase_event), "task screen")));
        REQUIRE(somebody.type_until({XK_F5}, has_event("operator asked", "Durchgang überspringen?")));
        REQUIRE(somebody.type_until({XK_2}, has_event("operator", "skips the trial: wish")));
        REQUIRE(somebody.type_until({XK_Escape}, has_event("operator asked", "End the session?")));
        REQUIRE(somebody.type_until({XK_n}, has_event("operator answered", "no")));
        REQUIRE(somebody.type_until({XK_Escape}, has_event("operator asked", "End the session?", 2)));
        REQUIRE(somebody.type_until({XK_y}, has_event("session aborted", "")));
        program.wait();
    }
    XCloseDisplay(display);

    INFO(text_of(said));
    const SessionRecord record(experiment.session(1));
    CHECK(record.consents()[0].accepted);
    const std::vector<RecordedObserverField> fields = record.observer_fields();
    REQUIRE(fields.size() == 2);
    CHECK(fields[0].value == "31");
    CHECK(fields[1].value == "right");
    REQUIRE_FALSE(record.trials().empty());
    CHECK(record.trials()[0].status == TrialRecord::Status::aborted);
    for (const TrialRecord& trial : record.trials())
        CHECK(trial.status != TrialRecord::Status::completed);
}

TEST_CASE("who declined is not asked again unless that session is named", "[session]") {
    const auto screen = VirtualScreen::start(800, 600, 24);
    Display* const display = XOpenDisplay(nullptr);
    REQUIRE(display);
    const SmallExperiment experiment(typed_protocol());
    const std::filesystem::path said = experiment.folder().path() / "said";
    {
        RunningProgram program(windowed_run(experiment), surroundings_of(experiment), said);
        const Window window = await_window(display);
        INFO(text_of(said));
        REQUIRE(window != 0);
        Somebody somebody(program, experiment.session(1), Keyboard(display, window));
        REQUIRE(somebody.type_until({XK_n}, has_event("session aborted", "")));
        program.wait();
    }
    XCloseDisplay(display);
    const std::vector<std::string> again{
        "run",     experiment.protocol().string(), "--observer", "P01",        "--context",
        "osmesa",  "--simulate-observer",          "1",          "--sessions", experiment.sessions().string(),
        "--resume"};
    const ProgramRun refused = experiment.overt(again);
    INFO(refused.err);
    CHECK(refused.exit_code == 2);
    CHECK(refused.err.find("the observer did not agree to take part") != std::string::npos);
}
