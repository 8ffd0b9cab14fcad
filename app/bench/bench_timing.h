/// Presentation timing, measured on displays whose faults are known.
#pragma once

#include "app/cli/figures.h"

namespace overt {

/// How many of 10,000 random fault scripts the ledger gives back exactly, and how far the line through time
/// stamps of 1 ms jitter is from the true onsets.
void measure_timing(BenchFigures& figures);

} // namespace overt
