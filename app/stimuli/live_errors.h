/// How far live frames are from baked ones, as `overt bench live` measures and holds it.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "experiment/protocol/protocol.h"

namespace overt {

/// CIEDE2000 of the pixels of an object, live to baked, in the median and of 95 %: what is not exceeded by
/// the kind at its usual values, under the overcast sky.
struct LiveDifference {
    MaterialKind kind = MaterialKind::smooth_conductor;
    double median = 0.0, most = 0.0;
};
inline constexpr std::array<LiveDifference, 9> live_differences{{
    {MaterialKind::smooth_conductor, 4.0, 16.0},
    {MaterialKind::rough_conductor, 2.4, 12.0},
    {MaterialKind::coated_conductor, 7.5, 22.0},
    {MaterialKind::diffuse, 1.0, 5.0},
    {MaterialKind::plastic, 1.1, 5.0},
    {MaterialKind::metallic_roughness, 1.1, 5.0},
    {MaterialKind::own, 2.0, 8.0},
    {MaterialKind::glass, 4.5, 25.0},
    {MaterialKind::translucent, 6.0, 12.0},
}};

/// In a sentence for each kind of material that the protocol has, what is known of its live frames.
std::string live_differences_of(const Protocol& protocol);

} // namespace overt
