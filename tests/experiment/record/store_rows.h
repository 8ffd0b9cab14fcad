/// Rows whose every field has a value of its own, and a process to be killed in.
#pragma once

#include <functional>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/experiment/record/session_fixture.h"

namespace overt::testing {

inline GazeSample sample_number(int number) {
    GazeSample sample;
    sample.sampled_at = tracker_time(9'000'000'000'000 + 500 * number);
    sample.eye = number % 2 == 0 ? Eye::left : Eye::right;
    if (number % 5 != 0)
        sample.gaze = ScreenPoint{0.1 * number, -1.0 / (1 + number)};
    sample.pupil_area = 0.3f * static_cast<float>(number);
    return sample;
}

inline FlipRecord flip_number(int trial, int number) {
    FlipRecord flip;
    flip.trial = trial;
    flip.refresh_in_trial = number;
    flip.planned = {number % 3};
    flip.shown = {(number + 1) % 3};
    flip.pose = {(number + 2) % 3};
    const SessionTime blank(SessionDuration(123'456'789'012'345 + 10'000'000LL * number));
    flip.report = {{5'000'000'000 + number},
                   blank - SessionDuration(3),
                   blank - SessionDuration(2),
                   blank,
                   number % 2 == 0 ? VblankSource::virtual_display : VblankSource::swap_return};
    flip.missed_refreshes = number % 4;
    return flip;
}

inline void write_trial(SessionStore& store, const Trial& trial, int samples = 1000) {
    store.trial_started(trial, at_ms(trial.index * 10000));
    for (int i = 0; i < samples; ++i) {
        store.sample(trial.index, sample_number(i));
        if (i % 20 == 0)
            store.flip(flip_number(trial.index, i / 20));
    }
    store.trial_finished(trial, outcome_at(trial.index * 10000));
}

/// Runs this in another process and gives its wait status.
inline int in_child(const std::function<void()>& work) {
    const pid_t child = ::fork();
    if (child == 0) {
        try {
            work();
        } catch (...) {
            ::_exit(99);
        }
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
}

inline void require_same(const GazeSample& a, const GazeSample& b) {
    REQUIRE(a.sampled_at == b.sampled_at);
    REQUIRE(a.eye == b.eye);
    REQUIRE(a.gaze == b.gaze);
    REQUIRE(a.pupil_area == b.pupil_area);
}

inline void require_same(const FlipRecord& a, const FlipRecord& b) {
    REQUIRE(a.trial == b.trial);
    REQUIRE(a.refresh_in_trial == b.refresh_in_trial);
    REQUIRE(a.planned == b.planned);
    REQUIRE(a.shown == b.shown);
    REQUIRE(a.pose == b.pose);
    REQUIRE(a.report.refresh == b.report.refresh);
    REQUIRE(a.report.requested == b.report.requested);
    REQUIRE(a.report.swapped == b.report.swapped);
    REQUIRE(a.report.vertical_blank == b.report.vertical_blank);
    REQUIRE(a.report.source == b.report.source);
    REQUIRE(a.missed_refreshes == b.missed_refreshes);
}

} // namespace overt::testing
