/// What a body can be looked through with.
#pragma once

#include <optional>

#include "experiment/protocol/protocol.h"

namespace overt {

/// The index at 587.6 nm of a material that is polished glass; nothing of rough glass, which has no line of
/// sight through it, and of all else.
inline std::optional<double> clear_glass_index(const MaterialSettings& material) {
    const bool is_clear = material.kind == MaterialKind::glass && material.roughness.value_or(0.0) == 0.0;
    return is_clear ? std::optional(material.ior) : std::nullopt;
}

} // namespace overt
