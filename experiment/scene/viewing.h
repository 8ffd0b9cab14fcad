/// Where the camera stands, how the object is turned, and what that makes of points and pixels. All of it in
/// double: the graphics card gets these matrices, the gaze is projected with them, and both must agree.
///
/// World: right-handed, +z up, in the mesh's unit. The object turns about the vertical through the centre of
/// its bounding box, and may be tilted and moved after that. Image: continuous pixels, origin top left, y
/// down, pixel centres at +0.5.
#pragma once

#include <glm/glm.hpp>

#include "experiment/object_pose.h"
#include "experiment/scene/mesh.h"
#include "experiment/units.h"

namespace overt {

/// A pinhole camera with square pixels; up is +z. Of a pair for two eyes each stands aside of `position` and
/// looks straight ahead past `target` as the other does; its image is shifted until `target` is in the middle
/// of both. What lies in the plane of the target, across the line of sight, so has no disparity: it is seen
/// in the plane of the screen.
struct Camera {
    glm::dvec3 position{0.0, -1.0, 0.0};
    glm::dvec3 target{0.0};
    Degrees vertical_fov{12.0}; ///< full angle over the image's height
    double aside = 0.0;         ///< how far the eye stands to the right of `position`; of the left eye < 0

    /// Where the rays meet.
    glm::dvec3 eye() const;
    bool operator==(const Camera&) const = default;
};

/// How an object stands, turned and tilted about `axis_point`.
struct TurntablePose {
    glm::dvec3 axis_point{0.0};
    ObjectPose object;

    glm::dmat4 world_from_object() const;
};

struct Ray {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0, 1.0, 0.0}; ///< unit length
};

/// A camera with an image of a given size.
struct View {
    Camera camera;
    glm::ivec2 image_px{1024, 1024};

    glm::dmat4 view_from_world() const;

    /// OpenGL's clip space (y up, depth -1 … 1) for distances near … far along the viewing direction, 0 <
    /// near < far.
    glm::dmat4 clip_from_view(double near, double far) const;

    /// Ray in the world through a continuous image point.
    Ray ray_through(glm::dvec2 image_point_px) const;

    /// Image point of a world point in front of the camera.
    glm::dvec2 project(glm::dvec3 world_point) const;

    /// Pixels of the image that a unit of length takes in a depth of one.
    double px_at_unit_depth() const;

    /// Image point to which the camera looks straight ahead: the middle, unless the camera stands aside.
    glm::dvec2 straight_ahead_px() const;

    /// How much farther to the right the other eye of a pair has a world point in its image than this one; 0
    /// without a pair. Between left and right eye it is the point's disparity: of the left eye's view > 0
    /// beyond the target, < 0 before it.
    double other_eye_right_px(glm::dvec3 world_point) const;

    /// Distance along the viewing direction; positive in front of the camera.
    double depth_of(glm::dvec3 world_point) const;
};

/// An object on its turntable in front of the camera: what the stimulus, its hidden map and the gaze must
/// agree on.
struct SceneView {
    View view;
    Bounds bounds; ///< of the mesh; the turn is about the vertical through its centre

    TurntablePose pose_at(const ObjectPose& object) const { return {bounds.centre(), object}; }
};

/// The same ray seen from the object: its coordinates before it was turned.
Ray to_object(const Ray& world_ray, const TurntablePose& pose);

/// A camera in front of the object (on its -y side), level with its centre, as near as the object allows when
/// it turns up to `amplitude` to each side: every point of the mesh stays inside the image with `margin`
/// (share of the image, 0 … 0.45) left free on all sides.
Camera fit_camera(const Mesh& mesh, Degrees vertical_fov, glm::ivec2 image_px, Degrees amplitude,
                  double margin);

/// Nearest and farthest distance along the viewing direction that the mesh can reach, however it is turned
/// after it was tilted and moved as `object` is, slightly widened.
struct DepthRange {
    double near = 0.0;
    double far = 0.0;
};
/// Throws InputError if the camera stands inside the volume that the mesh sweeps.
DepthRange depth_range(const Bounds& bounds, const View& view, const ObjectPose& object = {});

} // namespace overt
