/// How well frames are rendered, as protocols and people ask for it.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "experiment/protocol/protocol.h"
#include "render/bake/bake_settings.h"

namespace overt {

/// A level of quality, with numbers of its own where somebody gives some.
struct FrameQuality {
    BakeQuality level = BakeQuality::preview;
    std::optional<int> samples;            ///< of each pixel, instead of what is usual
    std::optional<double> target_error_de; ///< see BakeSettings
    friend bool operator==(const FrameQuality&, const FrameQuality&) = default;

    bool is_live() const { return level == BakeQuality::live; }
};

/// The levels of traced frames.
inline constexpr std::array traced_qualities{BakeQuality::preview, BakeQuality::draft, BakeQuality::standard,
                                             BakeQuality::reference};

/// A level as a protocol has it: the samples and the target of [bake] belong to its own level.
FrameQuality quality_of(BakeQuality level, const BakingSettings& baking);

/// "standard", "standard with 96 samples", …
std::string describe(const FrameQuality& quality);

/// What the path tracer is told. Not for live frames.
BakeSettings bake_settings(const FrameQuality& quality, const BakingSettings& baking, MaterialKind material);

/// What one frame takes, in an arbitrary unit that is the same for all stimuli and qualities: to deal work
/// out evenly, and to say how much of it is done. From times measured on figures of 300,000 triangles (a path
/// of a coated metal takes eight times as long as one of a smooth metal), with a share for writing the frame.
double expected_cost(const FrameQuality& quality, const Protocol& protocol, MaterialKind material);

} // namespace overt
