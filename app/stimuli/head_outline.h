/// A head outlined on a surface by clicks: a sphere about it and a plane through its neck.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/scene/making/mesh_parts.h"

namespace overt {

/// All points are in the coordinates of one mesh.
class HeadOutline {
  public:
    /// `first_radius`: of the sphere while one side of the head only is known, above 0. `given` stands until
    /// a point is picked.
    explicit HeadOutline(double first_radius, std::optional<PartRegion> given = std::nullopt);

    /// The first two points are opposite sides of the head: they are the ends of the sphere's diameter. The
    /// third is on the neck: the plane goes through it, across the line to the sphere's middle. Each further
    /// one is another place for the neck.
    void pick(glm::dvec3 point);
    /// The last point is forgotten; without any the given head is.
    void take_back();
    /// Makes the sphere larger about its middle, or smaller.
    void scale(double factor) { factor_ *= factor; }

    /// Named "head"; nothing before the first point, unless one was given.
    std::optional<PartRegion> region() const;
    const std::vector<glm::dvec3>& points() const { return points_; }

  private:
    double first_radius_;
    std::optional<PartRegion> given_;
    std::vector<glm::dvec3> points_; ///< at most three
    double factor_ = 1.0;
};

/// The same part after its mesh was turned, scaled alike in all directions and then moved.
PartRegion transformed(const PartRegion& region, const glm::dmat3& turn, double scale,
                       glm::dvec3 move = glm::dvec3(0.0));

/// As [[object]] of a protocol has it: "head = { spheres = [[…]], planes = [[[…], […]]] }", numbers to six
/// digits, and to as many more as the first sphere lies away from the origin.
std::string head_key(const PartRegion& region);

} // namespace overt
