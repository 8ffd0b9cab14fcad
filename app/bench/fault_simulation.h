/// Presentations on a display whose faults are known, to see whether the ledger gives them back.
#pragma once

#include <cstdint>
#include <vector>

#include "experiment/animation.h"
#include "experiment/timing/display_faults.h"
#include "experiment/timing/ledger_fit.h"

namespace overt {

/// A display, what goes wrong with it in one presentation, and what a true ledger says of that.
struct FaultScript {
    double refresh_hz = 120.0;
    WhenLate when_late = WhenLate::drop;
    DisplayFaults faults;
    std::vector<MissedRun> misses; ///< without margins
    std::vector<int> wrong_stamps; ///< refreshes since onset
};

/// The `index`-th of a series of scripts: displays of 60 to 240 Hz with clocks up to 300 ppm off, with a
/// count of refreshes and without, time stamps that jitter by up to 1 ms, both policies; up to a dozen late
/// pictures, skipped refreshes, stalls of the machine and wrong stamps, of sizes that make refreshes go by or
/// just do not.
FaultScript random_script(std::uint64_t seed, std::uint64_t index);

/// One presentation as the ledger recorded it, and as it truly was.
struct SimulatedPresentation {
    PageCycle plan;
    std::vector<FlipRecord> flips;
    std::vector<MissedRefresh> missed;
    std::vector<AnimationFrameIndex> lit; ///< truly, by refresh since the onset
    std::vector<SessionTime> begins;      ///< truly, likewise
};

/// Plays the paper's 8 s, or less at rates at which 30 frames a second do not fit.
SimulatedPresentation simulate_presentation(const FaultScript& script);

/// The time stamps' line through one presentation.
LedgerFit fit_of(const SimulatedPresentation& presentation, const FaultScript& script);

/// The ledger, read back, has the script's misses with their causes, its wrong stamps, the frame truly lit at
/// each refresh, and nothing else.
bool gives_back(const SimulatedPresentation& presentation, const FaultScript& script, const LedgerFit& fit);

/// Each refresh from the onset to the plan's end has exactly one row, a flip or a miss.
bool accounts_for_all(const SimulatedPresentation& presentation);

} // namespace overt
