/// What a session makes of its eye tracker: calibrations that are poor or fail, trials that the tracker ends,
/// a tracker that is lost, and what it is told.
#include <catch2/catch.hpp>

#include "tests/experiment/record/plain_session.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;
using Pressed = ResponsePress::Key;

namespace {

SetupOutcome validated(double mean_deg, double max_deg) {
    return {SetupOutcome::Kind::done,
            ValidationResult{{mean_deg},
                             {max_deg},
                             {{Eye::right, {100.0, 200.0}, ScreenPoint{110.0, 200.0}, {max_deg}, {}, {}}}},
            "tracker",
            {}};
}

/// Answers the operator's questions in this order, then with yes.
void decide(Sitting& sitting, std::vector<Pressed> answers) {
    sitting.panel.tell =
        [answers, next = std::size_t{0}](ScriptedPanel& panel) mutable -> std::optional<ResponsePress> {
        if (!panel.is_deciding() || next >= answers.size())
            return std::nullopt;
        return ResponsePress{answers[next++], {}};
    };
}

} // namespace

TEST_CASE("a validation within the limits goes on by itself and is recorded target by target", "[unit]") {
    Sitting sitting(short_protocol("[calibration]\nmean_limit_deg = 0.5\nmax_limit_deg = 1\n"));
    sitting.tracker.set_ups = {validated(0.5, 1.0)};
    CHECK(sitting.run().completed_trials == 2);
    REQUIRE(sitting.log.calibrations.size() == 1);
    CHECK(sitting.log.calibrations[0].is_within_limits);
    CHECK(sitting.log.calibrations[0].validation.targets.size() == 1);
    CHECK(sitting.log.calibrations[0].method == "tracker");
    CHECK(sitting.log.count("operator asked") == 0);
}

TEST_CASE("a validation beyond a limit is shown, and the operator decides", "[unit]") {
    const Protocol protocol = short_protocol("[calibration]\nmean_limit_deg = 0.5\nmax_limit_deg = 1\n");
    for (const SetupOutcome& poor : {validated(0.51, 0.9), validated(0.4, 1.01)}) {
        Sitting sitting(protocol);
        sitting.tracker.set_ups = {poor, poor};
        decide(sitting, {Pressed::no, Pressed::yes});
        CHECK(sitting.run().completed_trials == 2);
        CHECK(sitting.tracker.calibrations == 2);
        REQUIRE(sitting.log.calibrations.size() == 1);
        CHECK_FALSE(sitting.log.calibrations[0].is_within_limits);
        CHECK(sitting.log.details_of("operator").front() ==
              "goes on with a validation that is poorer than the protocol allows");
        const auto shown = std::ranges::count_if(sitting.presenter.screens, [](const Screen& screen) {
            return screen.kind == Screen::Kind::validation && screen.validated.size() == 1;
        });
        CHECK(shown == 2);
    }
}

TEST_CASE("what the tracker's camera sees is shown, and told besides", "[unit]") {
    Sitting sitting(short_protocol(""));
    sitting.tracker.camera = CameraImage{2, 1, std::vector<std::byte>(8, std::byte{5}), "left eye"};
    CHECK(sitting.run().completed_trials == 2);
    REQUIRE(sitting.cameras.size() == 1);
    CHECK(sitting.cameras[0].title == "left eye");
    CHECK(sitting.cameras[0].rgba == sitting.tracker.camera->rgba);
    CHECK(std::ranges::count_if(sitting.presenter.screens, [](const Screen& screen) {
              return screen.kind == Screen::Kind::camera;
          }) == 1);
}

TEST_CASE("a session does not go on uncalibrated", "[unit]") {
    for (const SetupOutcome::Kind kind : {SetupOutcome::Kind::cancelled, SetupOutcome::Kind::failed}) {
        Sitting again(short_protocol(""));
        again.tracker.set_ups = {{kind, {}, {}, "no eye"}};
        CHECK(again.run().completed_trials == 2); // the operator says yes: calibrate again
        CHECK(again.tracker.calibrations == 2);
        CHECK(again.log.details_of("calibration failed") == std::vector<std::string>{"no eye"});
        // Whoever is asked reads why.
        CHECK_THAT(again.log.details_of("operator asked").at(0),
                   Contains("The eye tracker is not calibrated.") && Contains("no eye"));

        Sitting ended(short_protocol(""));
        ended.tracker.set_ups = {{kind, {}, {}, "no eye"}};
        decide(ended, {Pressed::no});
        const SessionResult result = ended.run();
        CHECK(result.aborted);
        CHECK(result.reason == "the eye tracker was not calibrated");
        CHECK(ended.log.started.empty());
    }
}

TEST_CASE("what is decided at the tracker's host becomes of the trial", "[unit]") {
    for (const RecordingState state : {RecordingState::repeat, RecordingState::skip, RecordingState::abort}) {
        Sitting sitting(short_protocol(""));
        sitting.tracker.says = [state](int recording) {
            return recording == 0 ? state : RecordingState::running;
        };
        const SessionResult result = sitting.run();
        REQUIRE_FALSE(sitting.log.outcomes.empty());
        CHECK_FALSE(sitting.log.completed[0]);
        CHECK(sitting.log.outcomes[0].shown_refreshes == 1); // it is seen after the first flip
        CHECK(sitting.log.count("presentation broken off") == 1);
        if (state == RecordingState::repeat)
            CHECK(sitting.log.started == std::vector<int>{0, 0, 1});
        if (state == RecordingState::skip)
            CHECK(sitting.log.started == std::vector<int>{0, 1});
        CHECK(result.aborted == (state == RecordingState::abort));
        if (result.aborted)
            CHECK(result.reason == "aborted at the eye tracker");
        else
            CHECK(result.completed_trials == (state == RecordingState::repeat ? 2 : 1));
    }
}

TEST_CASE("a tracker that is lost in a trial is asked for, connected and calibrated again", "[unit]") {
    Sitting sitting(short_protocol(""));
    sitting.tracker.says = [](int recording) {
        return recording == 0 ? RecordingState::lost : RecordingState::running;
    };
    sitting.tracker.refused_reconnections = 1;
    CHECK(sitting.run().completed_trials == 2);
    CHECK(sitting.tracker.reconnections == 2);
    CHECK(sitting.tracker.calibrations == 2);
    CHECK_FALSE(sitting.log.completed[0]);
    CHECK(sitting.log.details_of("eye tracker lost") ==
          std::vector<std::string>{"", "it is still not there"});
    CHECK(sitting.log.count("eye tracker regained") == 1);
    const std::vector<std::string> asked = sitting.log.details_of("operator asked");
    REQUIRE(asked.size() == 2);
    CHECK_THAT(asked[0], !Contains("it is still not there"));
    CHECK_THAT(asked[1], Contains("The eye tracker was lost.") && Contains("it is still not there"));

    Sitting ended(short_protocol(""));
    ended.tracker.says = [](int) { return RecordingState::lost; };
    decide(ended, {Pressed::no});
    const SessionResult result = ended.run();
    CHECK(result.aborted);
    CHECK(result.reason == "the eye tracker was lost");
    CHECK(ended.tracker.reconnections == 0);
}

TEST_CASE("a drift check that asks for a set-up calibrates and begins the trial anew", "[unit]") {
    Sitting sitting(short_protocol(""));
    sitting.tracker.set_ups_wanted = 1;
    CHECK(sitting.run().completed_trials == 2);
    CHECK(sitting.tracker.calibrations == 2);
    CHECK(sitting.log.started == std::vector<int>{0, 0, 1});
}

TEST_CASE("a tracker is told of trials, onsets, frames and results at the times of their flips", "[unit]") {
    Sitting sitting(short_protocol(""));
    REQUIRE(sitting.run().completed_trials == 2);
    std::vector<std::string> texts;
    for (const auto& [at, text] : sitting.tracker.marks)
        texts.push_back(text);
    const auto begin = std::ranges::find(texts, "TRIALID 1"), second = std::ranges::find(texts, "TRIALID 2");
    REQUIRE(begin != texts.end());
    REQUIRE(second > begin);
    const auto onset = std::find(begin, second, "SYNCTIME");
    REQUIRE(onset != second);
    CHECK(*std::next(onset) == "FRAME 0");
    CHECK(sitting.tracker.marks[static_cast<std::size_t>(onset - texts.begin())].first ==
          sitting.log.outcomes[0].presentation_onset);
    // 0.1 s at 30 frames a second, each said once.
    for (const char* const frame : {"FRAME 0", "FRAME 1", "FRAME 2"})
        CHECK(std::count(begin, second, frame) == 1);
    CHECK(std::count(begin, second, "PRESENTATION_OFFSET") == 1);
    const auto tells = [&](const std::string& beginning) {
        return std::count_if(begin, second,
                             [&](const std::string& text) { return text.starts_with(beginning); });
    };
    for (const char* const name : {"task", "object", "material", "missed_refreshes"})
        CHECK(tells(std::string("!V TRIAL_VAR ") + name + " ") == 1);
    CHECK(std::count(begin, second, "TRIAL_RESULT 0") == 1);
    for (const std::string& text : texts)
        CHECK(text.size() <= longest_mark);
}

TEST_CASE("what a tracker shows while it is set up is framed for the experimenter, and lasts as it says",
          "[unit]") {
    Sitting sitting(short_protocol(""));
    sitting.tracker.sets_up = [&](SetupScreen& screen) {
        const SessionTime before = sitting.clock.now();
        screen.show_text("No eye yet.");
        ValidationResult result;
        result.targets.push_back({Eye::left, {10.0, 20.0}, ScreenPoint{11.0, 20.0}, {0.1}, {}, {}});
        screen.show_result(result, "Accept?");
        const SessionTime lit = screen.show_target({100.0, 200.0}, Degrees{0.8});
        CHECK(lit == sitting.clock.now());
        CHECK(screen.clear() > lit);
        screen.beep(Beep::answered);
        const SessionTime begun = sitting.clock.now();
        screen.wait(std::chrono::milliseconds(250));
        CHECK(sitting.clock.now() - begun == SessionDuration(std::chrono::milliseconds(250)));
        CHECK(screen.geometry().screen_px == screen_geometry_of(sitting.protocol).screen_px);
        CHECK(sitting.clock.now() > before);
    };
    CHECK(sitting.run().completed_trials == 2);
    const std::string& frame = sitting.protocol.words.experimenter;
    int texts = 0, results = 0;
    for (const Screen& screen : sitting.presenter.screens) {
        if (screen.text == "No eye yet.") {
            ++texts;
            CHECK(screen.kind == Screen::Kind::text);
            CHECK(screen.frame == frame);
        }
        if (screen.text == "Accept?") {
            ++results;
            CHECK(screen.kind == Screen::Kind::validation);
            CHECK(screen.frame == frame);
            CHECK(screen.validated.size() == 1);
        }
    }
    CHECK(texts == 1);
    CHECK(results == 1);
    REQUIRE_FALSE(sitting.presenter.targets.empty());
    REQUIRE(sitting.presenter.targets[0]);
    CHECK(sitting.presenter.targets[0]->x_px == 100.0);
    CHECK(sitting.beeps == std::vector<Beep>{Beep::answered});
    // Whoever waits for a display that has gone waits no longer.
    Sitting gone(short_protocol(""));
    bool is_gone = false;
    gone.presenter.is_closed = [&] { return is_gone; };
    gone.tracker.sets_up = [&](SetupScreen& screen) {
        is_gone = true;
        const SessionTime begun = gone.clock.now();
        screen.wait(std::chrono::seconds(5));
        CHECK(gone.clock.now() - begun < SessionDuration(std::chrono::milliseconds(20)));
    };
    CHECK(gone.run().aborted);
}

TEST_CASE("a calibration of the program's own is shown to the operator, however good it is", "[unit]") {
    const Protocol protocol = short_protocol("[calibration]\nmean_limit_deg = 0.5\nmax_limit_deg = 1\n");
    for (const auto& [outcome, is_good] :
         {std::pair{validated(0.4, 0.9), true}, {validated(0.6, 0.9), false}}) {
        Sitting sitting(protocol);
        sitting.tracker.calibrates = false;
        sitting.tracker.set_ups = {outcome, outcome};
        decide(sitting, {Pressed::no, Pressed::yes});
        CHECK(sitting.run().completed_trials == 2);
        CHECK(sitting.tracker.calibrations == 2);
        const auto asked = sitting.log.details_of("operator asked");
        REQUIRE(asked.size() == 2);
        for (const std::string& question : asked)
            CHECK_THAT(question, Catch::StartsWith(is_good ? protocol.words.validation
                                                           : protocol.words.validation_poor));
        REQUIRE(sitting.log.calibrations.size() == 1);
        CHECK(sitting.log.calibrations[0].is_within_limits == is_good);
        CHECK(sitting.log.count("operator") == (is_good ? 0 : 1));
        CHECK(sitting.log.details_of("validation").front() ==
              fmt::format("mean error {:.3f} deg, largest 0.900 deg", is_good ? 0.4 : 0.6));
    }
}
