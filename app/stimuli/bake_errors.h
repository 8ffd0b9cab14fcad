/// How far baked frames are off, as `overt bench bake` measures and holds it.
#pragma once

#include <array>
#include <optional>

#include "experiment/protocol/material_kind.h"

namespace overt {

/// Numbers of paths to a pixel that errors are known for.
inline constexpr std::array measured_samples{4, 16, 64, 256};

/// Mean CIE 1976 Delta-E ab against 1024 paths that frames of so many paths do not exceed, and the PSNR (dB)
/// that they reach, for pictures of 384 px and more under the overcast sky.
struct MeasuredErrors {
    MaterialKind kind = MaterialKind::smooth_conductor;
    std::array<double, 4> least_psnr_db, most_delta_e;
};
inline constexpr std::array<MeasuredErrors, 3> measured_errors{
    {{MaterialKind::smooth_conductor, {25.0, 32.6, 40.0, 47.0}, {4.4, 1.8, 0.75, 0.32}},
     {MaterialKind::rough_conductor, {19.4, 25.4, 32.4, 38.0}, {10.6, 5.5, 2.5, 1.2}},
     {MaterialKind::coated_conductor, {23.6, 30.1, 36.3, 42.1}, {7.3, 3.6, 1.75, 0.90}}}};

/// Nothing for a kind or a number that was not measured.
constexpr std::optional<double> mean_delta_e(MaterialKind kind, int samples) {
    for (const MeasuredErrors& errors : measured_errors)
        for (std::size_t i = 0; i < measured_samples.size(); ++i)
            if (errors.kind == kind && measured_samples[i] == samples)
                return errors.most_delta_e[i];
    return std::nullopt;
}

} // namespace overt
