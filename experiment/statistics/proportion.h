/// How far a share of independent events can be trusted.
#pragma once

#include <optional>

#include "experiment/statistics/estimate.h"

namespace overt {

/// Wilson's score interval of a proportion (Wilson 1927, JASA 22, 209-212), without correction for
/// continuity. Nothing without events. `hits` need not be whole, 0 <= hits <= events.
std::optional<Interval> wilson_interval(double hits, double events, double confidence = 0.95);

} // namespace overt
