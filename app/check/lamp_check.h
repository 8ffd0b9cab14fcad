/// Lamps that an object has inside, or that cut through it: nothing is seen of what they shine on within.
#pragma once

#include "app/inputs/protocol_inputs.h"
#include "experiment/scene/ray_caster.h"
#include "render/bake/light_sources.h"

namespace overt {

/// How a lamp and a surface lie to one another.
enum class LampPlace : std::uint8_t { outside, inside, cutting };

/// A surface to be asked what is within it.
struct Enclosure {
    explicit Enclosure(const Mesh& of); ///< `of` must outlive it
    const Mesh* mesh;
    RayCaster surface;
    bool has_inside; ///< it encloses a volume
};

/// `lamp`: a near one, in the mesh's coordinates. Looks
/// along some hundreds of lines over the lamp: what is thinner than a twentieth of it may go unseen.
LampPlace place_of_lamp(const LightSource& lamp, const Enclosure& enclosure);

/// Adds a warning at the lamp for each object that it is in the way of, in any of 72 poses of each motion.
void check_lamps(const Experiment& experiment, Diagnostics& diagnostics);

} // namespace overt
