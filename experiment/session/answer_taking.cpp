#include "experiment/session/answer_taking.h"

#include "experiment/design/match_levels.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/session/answer_check.h"
#include "experiment/session/level_watch.h"
#include "experiment/session/session_screens.h"

namespace overt {

namespace {

/// An answer's file is complete some milliseconds after its last sample has come; a device that has stopped
/// must not stop the session.
constexpr SessionDuration longest_wait_for_answer = std::chrono::seconds(2);

constexpr SessionDuration between_looks = std::chrono::milliseconds(4);

} // namespace

OperatorControl::How AnswerTaking::take(const Trial& trial, const std::optional<Trial>& next,
                                        bool is_practice, std::optional<double> limit_s,
                                        TrialOutcome& outcome) {
    const ScreenSettings& screens = state_.protocol.screens;
    SessionPorts& ports = state_.ports;
    if (state_.phase() != SessionPhase::response_screen)
        state_.enter(SessionPhase::response_screen, state_.trial());
    std::unique_ptr<AnswerRecording> recording;
    if (ports.recorder && !is_practice)
        recording = ports.recorder->begin(trial);
    const Screen screen = overt::screens::response(state_.protocol, trial.task);
    outcome.response_screen_onset = state_.show(screen);
    if (recording)
        recording->response_screen_lit(outcome.response_screen_onset);
    if (next)
        ports.presenter.expect_slots(loaded_for(state_.protocol, *next));
    Waiting waiting{.screen = screen,
                    .onset = outcome.response_screen_onset,
                    .min_s = screens.response_min_s,
                    .max_s = limit_s.value_or(screens.response_max_s)};
    waiting.await = [&](SessionTime since) { ports.panel.await_response(trial, since); };
    LevelWatch watch(state_.protocol.words, outcome.response_screen_onset);
    const bool shows_level = state_.protocol.answers.meter_on_screen;
    if (recording && (ports.on_level || shows_level))
        waiting.meanwhile = [&] {
            const AudioLevel level = recording->level();
            if (ports.on_level)
                ports.on_level(level);
            if (!shows_level)
                return;
            if (const std::optional<LevelBar> bar = watch.take(level, state_.now()))
                ports.presenter.show_level(*bar);
        };
    const OperatorControl::Press press = control_.wait(waiting);
    outcome.responded_at = press.at;
    if (press.uncertainty > SessionDuration::zero())
        outcome.responded_uncertainty = press.uncertainty;
    if (recording)
        recording->end(press.at);
    if (press.how == OperatorControl::How::timed_out)
        state_.log().event({press.at, state_.trial(), response_timed_out_event, ""});
    if (press.how == OperatorControl::How::next) {
        outcome.answer = ports.panel.answer();
        state_.markers.mark(MarkedEvent::response, press.at, "RESPONSE");
    }
    if (recording)
        keep(*recording);
    return press.how;
}

void AnswerTaking::keep(AnswerRecording& recording) {
    const SessionTime latest = state_.now() + longest_wait_for_answer;
    std::optional<RecordedAnswer> answer = recording.result();
    while (!answer && state_.now() < latest) {
        state_.ports.presenter.use_spare_time();
        state_.ports.clock.wait_until(state_.now() + between_looks);
        answer = recording.result();
    }
    if (!answer) {
        state_.note(answer_recording_event,
                    "was not complete two seconds after its end: the file may be short");
        return;
    }
    for (const std::string& warning : warnings_about(*answer))
        state_.note(answer_recording_event, warning);
    state_.log().answer_recorded(*answer);
}

} // namespace overt
