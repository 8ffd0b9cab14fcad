/// Sessions that are killed, and what must be true of them afterwards.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <set>
#include <thread>

#include <catch2/catch.hpp>

#include "experiment/record/read/session_record.h"
#include "tests/app/small_experiment.h"
#include "tests/support/running_program.h"

namespace overt::test {

/// Arguments of `overt run` for a simulated observer on OSMesa.
inline std::vector<std::string> run_arguments(const SmallExperiment& experiment, const std::string& observer,
                                              const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"run",
                                       experiment.protocol().string(),
                                       "--simulate-observer",
                                       "5",
                                       "--sessions",
                                       experiment.sessions().string(),
                                       "--observer",
                                       observer,
                                       "--context",
                                       "osmesa",
                                       "--seed",
                                       "7"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

/// Starts a run and kills it as soon as `is_time` says so; true if that came before its end.
inline bool run_and_kill(const SmallExperiment& experiment, const std::vector<std::string>& arguments,
                         const std::function<bool()>& is_time) {
    RunningProgram program(arguments, {"OVERT_CACHE=" + experiment.cache().string()},
                           experiment.folder().path() / "said");
    while (program.is_running()) {
        if (is_time()) {
            program.signal(SIGKILL);
            return program.wait() == 128 + SIGKILL;
        }
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    return false;
}

/// The attempts that a session has by now; none if it cannot be read yet.
inline std::vector<TrialRecord> attempts_so_far(const std::filesystem::path& session) {
    try {
        return SessionRecord(session).trials();
    } catch (const std::exception&) {
        return {};
    }
}

/// A session with `completed` trials, killed while the next one runs. Its trials must take much longer than
/// the tenth of a second after which their rows can be seen.
inline void make_interrupted_session(const SmallExperiment& experiment, std::size_t completed,
                                     const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"--virtual-time"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::vector<TrialRecord> attempts;
    const auto is_in_the_next = [&] {
        attempts = attempts_so_far(experiment.session());
        return attempts.size() == completed + 1 && attempts.back().status == TrialRecord::Status::open;
    };
    // On a busy machine the trial may be over before it is seen.
    for (int tries = 0; tries < 10; ++tries) {
        std::filesystem::remove_all(experiment.session());
        const bool was_killed = run_and_kill(experiment, run_arguments(experiment, "P01", arguments), [&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            return is_in_the_next();
        });
        if (was_killed && is_in_the_next())
            return;
    }
    FAIL(text_of(experiment.folder().path() / "said"));
}

/// How often each trial has an attempt that counts, by its index.
inline std::map<int, int> counted(const SessionRecord& record) {
    std::map<int, int> counted;
    for (const TrialRecord& attempt : record.trials())
        if (attempt.counts)
            ++counted[attempt.trial.index];
    return counted;
}

/// Each planned trial counts once, and nothing else does.
inline bool is_the_plan(const SessionRecord& record) {
    std::map<int, int> plan;
    for (const Trial& trial : record.header().schedule.trials)
        plan[trial.index] = 1;
    return counted(record) == plan;
}

} // namespace overt::test
