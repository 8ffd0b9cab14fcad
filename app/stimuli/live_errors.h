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
inline constexpr std::array<LiveDifference, 8> live_differences{{
    {MaterialKind::smooth_conductor, 99.0, 99.0},
    {MaterialKind::rough_conductor, 99.0, 99.0},
    {MaterialKind::coated_conductor, 99.0, 99.0},
    {MaterialKind::diffuse, 99.0, 99.0},
    {MaterialKind::plastic, 99.0, 99.0},
    {MaterialKind::metallic_roughness, 99.0, 99.0},
    {MaterialKind::own, 99.0, 99.0},
    {MaterialKind::glass, 99.0, 99.0},
}};

/// In a sentence for each kind of material that the protocol has, what is known of its live frames.
std::string live_differences_of(const Protocol& protocol);

} // namespace overt
