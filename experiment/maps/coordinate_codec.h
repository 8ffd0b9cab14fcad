/// Coordinates as 16-bit colours: x, y and z within the object's bounding box become red, green and blue.
///
/// After equations 1 and 2 of Sidorov, Harvey, Smithson and Hardeberg 2019, with two corrections: they
/// multiply by 2^16, which a channel of 16 bits cannot hold at the far side of the box, and do not say how
/// they round. Here code = round(65535 (x - min) / (max - min)), as OpenGL and PNG code numbers between 0
/// and 1, so that decoding is at most half a code off. The paper's 2^16 is known too: maps that were made
/// with it are read with it.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "experiment/scene/mesh.h"

namespace overt {

/// One coordinate triple as it stands in a file.
using CoordinateCode = glm::vec<3, std::uint16_t>;

class CoordinateCodec {
  public:
    static constexpr int usual_scale = 65535;
    static constexpr int paper_scale = 65536; ///< the code of the far side is clamped to 65535

    /// `bounds`: finite, min <= max in each axis. Throws InputError for others, and for a scale that is
    /// neither of the two.
    explicit CoordinateCodec(const Bounds& bounds, int scale = usual_scale);

    /// What lies outside of the box is taken to its nearest side; of an axis without extent every code is 0.
    CoordinateCode encode(glm::dvec3 position) const;

    /// With the usual scale the ends of the box come back exactly, and codes stand for themselves:
    /// encode(decode(code)) == code on axes with an extent.
    glm::dvec3 decode(CoordinateCode code) const;

    /// Distance of neighbouring codes on each axis, in the mesh's unit.
    glm::dvec3 step() const { return bounds_.extent() / static_cast<double>(scale_); }

    const Bounds& bounds() const { return bounds_; }
    int scale() const { return scale_; }

  private:
    Bounds bounds_;
    int scale_;
};

} // namespace overt
