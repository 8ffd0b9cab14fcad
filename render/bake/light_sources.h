/// The sun and lamps near the object, which shine besides the probe.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/protocol/protocol.h"
#include "render/image/light_probe.h"

namespace overt {

/// Changes whenever the same inputs would give other light: part of the key under which frames are kept.
constexpr int light_sources_version = 1;

/// One that shines evenly, with the same radiance from wherever it is seen. It hides nothing: light goes by
/// it as if it were not there, so that the light of several is the sum of the light of each.
struct LightSource {
    enum class Shape : std::uint8_t { sun, rectangle, disc, sphere } shape = Shape::sun;
    glm::vec3 light{0.0f};  ///< linear Rec. 709, in the probe's unit
    glm::vec3 place{0.0f};  ///< its middle; of the sun the direction to it, of unit length
    glm::vec3 across{0.0f}; ///< unit vector along the width of a rectangle
    glm::vec3 facing{0.0f}; ///< of a flat one, to the side that shines
    float half_width = 0.0f, half_height = 0.0f;
    float radius = 0.0f; ///< of disc and sphere; of the sun in radians

    /// A direction to it, as seen from `from`.
    struct Aim {
        glm::vec3 direction{0.0f}; ///< unit length
        float distance = 0.0f;     ///< to it; of the sun infinite
        float density = 0.0f;      ///< per steradian, with which it is chosen; 0: it does not shine there
    };
    /// For a place in the unit square: evenly over the angle that sun and sphere fill, and over the area of
    /// what is flat.
    Aim aim(glm::vec3 from, glm::vec2 place) const;
    /// With which aim() gives this direction, which meets it at `distance`.
    float density(glm::vec3 from, glm::vec3 direction, float distance) const;
    /// How far along a ray it is met; negative: not at all, or from behind. From inside a sphere it is not.
    float met_at(glm::vec3 from, glm::vec3 direction) const;
};

/// Those of a light, as they stand in the world about the centre of the object's box, before the light is
/// turned by LightSettings::rotation_deg. Of a sum: none.
std::vector<LightSource> light_sources(const LightSettings& light);

/// The same sources moved: rotated by a rotation, and then by `shift`.
std::vector<LightSource> moved(std::span<const LightSource> sources, const glm::dmat3& rotation,
                               glm::dvec3 shift);

/// A light's probe with its sun and lamps in it, as they are seen from the centre of the object's box: what
/// live frames are lit by, for which nothing is near. Of a sum, all of its parts. Turned as load_light_probe
/// has it, and throws as it does.
LightProbe distant_probe(const LightSettings& light);

} // namespace overt
