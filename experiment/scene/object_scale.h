/// Which millimetres everything on an object is given in.
///
/// There is one space, the object's own: millimetres of the thing itself, whatever its picture on the display
/// measures, with the origin and the axes of its mesh as it stands unturned (+z up). The suffixes _mm, _mm2
/// and _mm3 of columns and files always mean it. The exports' surface_x, surface_y, surface_z and depth are
/// in the mesh's unit, which is this millimetre wherever the protocol knows the unit; so their names have no
/// suffix, and their descriptions say it (LengthWords). What is seen is an angle at the observer's eye, and
/// has the suffixes _deg and _deg2. Nothing is given in millimetres of the display: how many of them an
/// object's millimetre takes is said once for each stimulus, as `shown_size`.
///
/// Where the protocol does not know a mesh's unit (unit = "own"), the object is taken to be as large as its
/// picture: its shown_size is 1.
#pragma once

#include <optional>
#include <string_view>

#include "experiment/scene/viewing.h"
#include "experiment/screen_geometry.h"

namespace overt {

/// How large an object is, and how large it is seen. All sizes are in the depth of the axis about which it
/// turns.
struct ObjectScale {
    double mm_per_unit = 0.0; ///< millimetres of the object in a unit of its mesh
    double axis_depth = 0.0;  ///< of the axis from the camera, in the mesh's unit
    double mm_per_deg = 0.0;  ///< millimetres of the object in a degree of visual angle
    double shown_size = 1.0;  ///< millimetres of the display in a millimetre of the object
};

/// Of an object that turns about the vertical through `axis_point`, in the mesh's unit. `unit`: "mm" where
/// that is the millimetre, as RecordedObject has it. The height of the image is 2 tan(fov / 2) depths of
/// the camera, and image_px.y pixels of the screen; a degree at the middle of the screen takes tan(1 deg)
/// viewing distances. Nothing if the camera or the screen is not known, or the axis is not in front of it.
std::optional<ObjectScale> object_scale(const Camera& camera, const glm::dvec3& axis_point,
                                        const ScreenGeometry& screen, std::string_view unit);

} // namespace overt
