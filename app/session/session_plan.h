/// What is settled about a session before anything is drawn.
#pragma once

#include <optional>

#include "app/session/observer_questions.h"
#include "app/session/resumed_session.h"
#include "app/session/session_commands.h"
#include "experiment/protocol/files/fault_file.h"

namespace overt {

struct SessionPlan {
    std::optional<ResumedSession> resumed;
    SimulatedFaults faults;
    FieldValues fields; ///< of the observer's form, as far as it is filled in outside of the window
    Schedule schedule;
    /// Of a new session of an observer who has others: which one it is, and what became of those; else empty.
    std::string earlier_sessions;
};

/// Finds the session that is taken up, or sees that a new one has a place and says which one it is; reads the
/// faults; asks for the observer's form at the terminal if it is to be asked there. Throws InputError, or
/// FindingsPrinted when all is said.
SessionPlan plan_session(const RunOptions& options, const SessionPlace& place, const Protocol& protocol,
                         const Observer& observer);

/// What is simulated has a seed of its own, so that one order can be tried with several observers.
std::uint64_t seed_of_simulated(const RunOptions& options, const SessionPlan& plan);

} // namespace overt
