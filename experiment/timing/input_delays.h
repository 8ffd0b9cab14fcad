/// How long what observers do takes to be seen.
#pragma once

#include <optional>
#include <vector>

namespace overt {

/// How long what observers did took to be seen: from the latest input that a picture contains to the refresh
/// that it was lit at, of each picture that contains a further one. Without the display's latency.
struct InputDelays {
    int count = 0; ///< pictures
    double median_s = 0.0;
    double most_s = 0.0; ///< 95 % of them take no longer: the smallest of which that is true
    double longest_s = 0.0;
    friend constexpr bool operator==(const InputDelays&, const InputDelays&) = default;
};

/// Of delays in seconds, in any order; nothing of none.
std::optional<InputDelays> summary_of(std::vector<double> delays_s);

} // namespace overt
