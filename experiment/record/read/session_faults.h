/// What went wrong in a session, by what it went wrong with.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/base/enum_names.h"
#include "experiment/record/read/session_record.h"

namespace overt {

/// Whose fault it is.
enum class FaultSide : std::uint8_t { eye_tracker, display, response_device, sound, markers, machine };
template <>
inline constexpr auto names_of<FaultSide> = enum_names<FaultSide>("eye tracker", "display",
                                                                  "response devices", "spoken answers",
                                                                  "outputs of markers", "machine");

struct SessionFault {
    FaultSide side = FaultSide::eye_tracker;
    int sitting = 1;
    int trial = -1;     ///< index; -1: outside of trials
    std::string what;   ///< the kind of the event, or what an attempt failed by
    std::string detail; ///< in the record's words; may be empty
};

/// In the order of the sides, of each side in that of the record. What the operator did is no fault;
/// refreshes that were missed are told by timing_report(), but for attempts that failed by them.
std::vector<SessionFault> faults_of(const SessionRecord& record);

/// Of which devices a text of simulated faults tells (fault_file.h), or which a session had.
struct SimulatedSides {
    bool display = false, eye_tracker = false;
    bool are_none() const { return !display && !eye_tracker; }
};
SimulatedSides simulated_sides(std::string_view faults);
SimulatedSides simulated_sides(const SessionRecord& record);

/// A line for each side: what went wrong, in which trials, and what was said of it first.
std::vector<std::string> summary_of(const std::vector<SessionFault>& faults);

} // namespace overt
