/// How much of even light a surface gives back, for renderers that look light up instead of following it.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "experiment/protocol/protocol.h"

namespace overt {

/// By the cosine of the angle to the eye, in rows that are even in its root from 0 to 1: linear Rec. 709
/// under D65. What is mirrored is mirrored in a lobe about the mirror's direction, the rest is even ("split
/// sum": Karis 2013, "Real shading in Unreal Engine 4").
struct LiveShares {
    static constexpr int rows = 64;
    /// rgb in the material's own lobe; alpha in that of a clear coat over it.
    std::vector<glm::vec4> mirrored;
    /// rgb; of glass what goes through.
    std::vector<glm::vec4> even;
};

/// Of metals, polished or rough, with or without all their light, of plastics and mixtures: the shares that
/// their paths have (LayeredSurface, LobeAlbedo). Of glass what its surface mirrors, and what goes through
/// its middle; of a translucent body what a thick one gives back. Throws InputError for an unknown metal.
LiveShares live_shares(const MaterialSettings& material);

} // namespace overt
