/// A session in a real window, led and answered by somebody at its keyboard.
#include <algorithm>
#include <functional>
#include <initializer_list>
#include <memory>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/app/session/interrupted_run.h"
#include "tests/app/session/windowed_run.h"
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
        "output = \"color++\"",
        "output = \"native-8bit\"\ngamma = 2.2\nlinearised_by = \"none\"\ntiming = \"unproven\"");
}

/// The session in its window, and somebody at that window's keyboard.
class TypedSession {
  public:
    /// A program whose window does not come fails the test.
    explicit TypedSession(const SmallExperiment& experiment)
        : screen_(VirtualScreen::start(800, 600, 24)), session_(experiment.session(1)),
          said_(experiment.folder().path() / "said"), display_(XOpenDisplay(nullptr)),
          program_(windowed_run(experiment, {"--refresh-check", "0"}), surroundings_of(experiment), said_),
          keyboard_(display_.get(), await_window(display_.get())) {
        INFO(said());
        REQUIRE(keyboard_.window() != 0);
    }

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
    void await_end() { program_.wait(); }
    /// What the program wrote to its terminal.
    std::string said() const { return text_of(said_); }

  private:
    struct Close {
        void operator()(Display* display) const { XCloseDisplay(display); }
    };
    static std::vector<std::string> surroundings_of(const SmallExperiment& experiment) {
        std::vector<std::string> variables = x_server_alone;
        variables.push_back(fmt::format("OVERT_CACHE={}", experiment.cache().string()));
        return variables;
    }

    std::unique_ptr<VirtualScreen> screen_;
    std::filesystem::path session_, said_;
    std::unique_ptr<Display, Close> display_;
    RunningProgram program_;
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
          "[session][waits]") {
    const SmallExperiment experiment(typed_protocol());
    {
        TypedSession session(experiment);

        // A key that neither accepts nor declines does nothing.
        REQUIRE(session.type_until({XK_y, XK_space, XK_j}, [](const SessionRecord& record) {
            return record.consents().size() == 1;
        }));
        // What was typed before the form came is taken back first.
        REQUIRE(session.type_until(
            {XK_BackSpace, XK_BackSpace, XK_BackSpace, XK_BackSpace, XK_3, XK_1, XK_Return, XK_r, XK_Return},
            [](const SessionRecord& record) { return !record.observer_fields().empty(); }));
        REQUIRE(session.type_until({XK_F1}, has_event("operator", "pauses")));
        REQUIRE(session.type_until({XK_F1}, has_event("operator", "goes on")));
        REQUIRE(session.type_until({XK_space}, has_event(std::string(phase_event), "task screen")));
        REQUIRE(session.type_until({XK_F5}, has_event("operator asked", "Durchgang überspringen?")));
        REQUIRE(session.type_until({XK_2}, has_event("operator", "skips the trial: wish")));
        REQUIRE(session.type_until({XK_Escape}, has_event("operator asked", "End the session?")));
        REQUIRE(session.type_until({XK_n}, has_event("operator answered", "no")));
        REQUIRE(session.type_until({XK_Escape}, has_event("operator asked", "End the session?", 2)));
        REQUIRE(session.type_until({XK_y}, has_event("session aborted", "")));
        session.await_end();
    }

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
    const SmallExperiment experiment(typed_protocol());
    {
        TypedSession session(experiment);
        REQUIRE(session.type_until({XK_n}, has_event("session aborted", "")));
        session.await_end();
    }
    const std::vector<std::string> again{
        "run",     experiment.protocol().string(), "--observer", "P01",        "--context",
        "osmesa",  "--simulate-observer",          "1",          "--sessions", experiment.sessions().string(),
        "--resume"};
    const ProgramRun refused = experiment.overt(again);
    INFO(refused.err);
    CHECK(refused.exit_code == 2);
    CHECK(refused.err.find("the observer did not agree to take part") != std::string::npos);
}
