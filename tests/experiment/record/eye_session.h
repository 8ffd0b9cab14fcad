/// A session with everything that exports must cope with: blinks, dropped samples, an aborted attempt, one
/// that was cut off, two sittings between which the tracker's clock began anew, and texts of all kinds.
#pragma once

#include <cmath>

#include "experiment/record/session_schema.h"
#include "tests/experiment/record/session_fixture.h"

namespace overt::testing {

/// Microseconds by which the tracker's clock is ahead of the session's, by sitting.
inline constexpr std::int64_t eye_session_offset_us[] = {0, 7'000'000'000, 90'000'000};

inline SessionHeader eye_session_header() {
    SessionHeader header = example_header();
    header.session_number = 1;
    header.protocol.title = "Blick, 視線, نظرة";
    header.tasks = {{"free", "Schauen Sie sich um; ganz frei"}, {"age", "何歳？\tقل"}};
    header.tracker = {"simuliert – ü", 2000.0, Eye::left};
    header.objects[0].title = "Büste";
    header.stimuli = {{{0, 0}, "rendered", std::string(64, 'c')},
                      {{0, 1}, "rendered", std::string(64, 'c')},
                      {{1, 0}, "rendered", std::string(64, 'c')},
                      {{1, 1}, "given", ""}};
    header.display.screen.screen_px = {1920, 1080};
    return header;
}

/// One attempt: samples of the left eye at 2000 Hz from 900 ms after `start_ms` on. Every 37th is dropped,
/// 100 to 139 are a blink.
inline void record_attempt(SessionStore& store, int sitting, const Trial& trial, std::int64_t start_ms,
                           int samples, std::optional<TrialOutcome::Status> status) {
    store.trial_started(trial, at_ms(start_ms));
    for (int n = 0; n < samples; ++n) {
        if (n % 37 == 36)
            continue;
        GazeSample sample;
        sample.eye = Eye::left;
        sample.sampled_at = TrackerTime(std::chrono::microseconds(eye_session_offset_us[sitting] +
                                                                  1000 * (start_ms + 900) + 500 * n + 137));
        if (n < 100 || n >= 140) {
            sample.gaze = ScreenPoint{960.0 + 200.123 * std::sin(0.01 * n), 540.0 - 0.0625 * n};
            sample.pupil_area = 812.5f + static_cast<float>(n);
        }
        store.sample(trial.index, sample);
    }
    if (!status)
        return;
    TrialOutcome outcome = outcome_at(start_ms);
    outcome.status = *status;
    if (*status == TrialOutcome::Status::aborted)
        outcome.response_screen_onset = outcome.responded_at = {};
    outcome.answer = "vierzig, \"oder\"\tfünfzig";
    store.trial_finished(trial, outcome);
}

/// Gives the session's directory. `observer` may be any label.
inline std::filesystem::path make_eye_session(const std::filesystem::path& root,
                                              const std::string& observer = "AB7",
                                              SessionHeader header = eye_session_header()) {
    header.schedule.observer.label = observer;
    std::filesystem::path session = make_session(root, header);
    std::filesystem::create_directories(session / "stimuli");
    for (const char* name : {"bust_gold", "bust_silver", "vase_gold"})
        std::ofstream(session / "stimuli" / (std::string(name) + ".png")) << "picture of " << name;
    using Status = TrialOutcome::Status;
    const auto clocks = [](SessionStore& store, int sitting) {
        for (const std::int64_t second : {0, 100})
            store.clock_pair(
                {at_ms(1000 * second),
                 TrackerTime(std::chrono::microseconds(eye_session_offset_us[sitting] + 1'000'000 * second)),
                 at_ms(1000 * second)});
    };
    {
        SessionStore store(session / session_file_name, patient());
        clocks(store, 1);
        store.observer_fields({{"age", "Alter", "34"},
                               {"sex", "Geschlecht", "female"},
                               {"handedness", "Hand", "beide"},
                               {"vision", "Sehen, 視力", "mit\tBrille"}});
        store.event({at_ms(5), -1, "validation", "mean error 0.312 deg, largest 0.754 deg"});
        record_attempt(store, 1, header.schedule.trials[0], 10'000, 400, Status::completed);
        record_attempt(store, 1, header.schedule.trials[1], 20'000, 200, Status::aborted);
        record_attempt(store, 1, header.schedule.trials[1], 30'000, 400, Status::completed);
        store.close();
    }
    SessionStore store(session / session_file_name, patient());
    clocks(store, 2);
    record_attempt(store, 2, header.schedule.trials[2], 50'000, 400, Status::completed);
    record_attempt(store, 2, header.schedule.trials[3], 60'000, 80, std::nullopt);
    store.close();
    return session;
}

} // namespace overt::testing
