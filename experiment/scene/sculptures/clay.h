/// A solid built up the way a sculptor works in clay: lumps put on and smoothed in, hollows cut out, relief
/// drawn on the surface. All coordinates and lengths in mm.
#pragma once

#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/scene/sculptures/signed_distance.h"

namespace overt {

/// A solid and a ball around it.
struct Shape {
    std::function<double(const glm::dvec3&)> distance; ///< signed, see signed_distance.h
    Ball ball;
};

/// Height that is added to a surface: of a point and its distance to the surface without the relief. It is 0
/// outside the ball and rises smoothly from there.
struct Relief {
    std::function<double(const glm::dvec3&, double)> height;
    Ball ball;
};

/// The strokes in the order they were made. Copying is deep; asking for distances is thread-safe.
class Clay {
  public:
    /// Puts a lump on, its seam filled over `blend_mm` (> 0).
    Clay& add(Shape shape, double blend_mm);
    /// Puts a whole other work on.
    Clay& add(const Clay& clay, double blend_mm);
    /// Cuts a hollow out, its rim rounded over `blend_mm` (> 0).
    Clay& carve(Shape shape, double blend_mm);
    /// Raises (or with negative heights lowers) the surface made so far.
    Clay& emboss(Relief relief);

    /// Signed distance to the surface. Strokes that cannot reach `point` are passed over, without a change of
    /// the result.
    double distance(const glm::dvec3& point) const;

    /// Unit vector away from the surface at `point`.
    glm::dvec3 normal(const glm::dvec3& point) const;

    /// Foot of `point` on the surface, by Newton steps; the point must be nearer to the surface than to its
    /// medial axis.
    glm::dvec3 foot(const glm::dvec3& point) const;

    /// Ball around everything put on so far.
    const Ball& ball() const { return ball_; }

    /// The work as a single shape.
    Shape shape() const;

  private:
    enum class Kind { add, carve, emboss };
    struct Stroke {
        Kind kind;
        std::function<double(const glm::dvec3&)> distance;
        std::function<double(const glm::dvec3&, double)> height;
        Ball ball;
        double blend_mm;
    };

    std::vector<Stroke> strokes_;
    Ball ball_{glm::dvec3(0.0), -1.0};
};

/// A place for a shape that was made about the origin: turned, then enlarged, then moved.
struct Placement {
    glm::dvec3 origin{0.0};
    glm::dmat3 axes{1.0}; ///< orthonormal; the columns are the shape's own x, y and z. May mirror.
    double scale = 1.0;

    glm::dvec3 to_world(const glm::dvec3& local) const { return origin + axes * (local * scale); }
    glm::dvec3 to_local(const glm::dvec3& world) const { return (world - origin) * axes / scale; }
    Shape place(Shape local) const;
};

/// Ball of clay.
Shape sphere(const glm::dvec3& centre, double radius);
/// Ellipsoid with its half axes along `axes`.
Shape ellipsoid(const glm::dvec3& centre, const glm::dvec3& half_axes,
                const glm::dmat3& axes = glm::dmat3(1.0));
/// Tapered bar with round ends.
Shape bar(const glm::dvec3& a, const glm::dvec3& b, double radius_a, double radius_b);
/// Box with rounded edges, upright.
Shape block(const glm::dvec3& centre, const glm::dvec3& half_size, double rounding);
/// Round cord along the quadratic curve from a to b that starts and ends in the direction of `control`; its
/// radius runs the same way through three values.
Shape cord(const glm::dvec3& a, const glm::dvec3& control, const glm::dvec3& b, const glm::dvec3& radii);

/// The shape grown by so many mm on all sides.
Shape grown(Shape shape, double by_mm);

/// Axes of a right-handed frame: z along `up`, y as near to `back` as can be, x = y cross z.
glm::dmat3 frame_of(const glm::dvec3& up, const glm::dvec3& back);

} // namespace overt
