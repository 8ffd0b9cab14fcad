/// The relief that settings of a gauge figure speak of (Koenderink, van Doorn and Kappers 1992; triangulation
/// after Wijntjes, Behavior Research Methods 44, 2012).
///
/// x to the right, y up, z towards the eye; slant from 0 (facing the eye), tilt from +x towards +y, of the
/// normal (sin slant cos tilt, sin slant sin tilt, cos slant): dz/dx = -tan slant cos tilt, dz/dy = -tan
/// slant sin tilt. Perspective is ignored.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace overt {

struct ReliefNode {
    double x = 0.0, y = 0.0; ///< any unit; z has the same
};

/// A setting at the middle of a triangle of nodes.
struct GaugeSetting {
    std::array<std::size_t, 3> nodes{};
    double slant_deg = 0.0, tilt_deg = 0.0;
};

/// Slants beyond this have hardly any depth left in the picture: they are taken for this one, and counted.
inline constexpr double steepest_slant_deg = 85.0;

struct GaugeRelief {
    std::vector<double> z;     ///< by node, with a mean of 0
    double residual_sum = 0.0; ///< of squares, over all edges of all triangles
    int equations = 0;
    int clipped = 0; ///< settings beyond steepest_slant_deg
};

/// Least squares: for each edge of each triangle z differs by its gradient along it. Nothing where the
/// triangles do not connect all nodes.
std::optional<GaugeRelief> gauge_relief(std::span<const ReliefNode> nodes,
                                        std::span<const GaugeSetting> settings);

/// Relief over the true depth: z = a + gain true, and z = a + gain true + x_shear x + y_shear y, the family
/// of reliefs that look alike (Belhumeur, Kriegman and Yuille 1999): the first alone says little.
struct ReliefAgreement {
    double gain = 0.0, r_squared = 0.0;
    double affine_gain = 0.0, x_shear = 0.0, y_shear = 0.0, affine_r_squared = 0.0;
};
std::optional<ReliefAgreement> compare_relief(std::span<const ReliefNode> nodes, std::span<const double> z,
                                              std::span<const double> true_z);

/// The angle between two normals by slant and tilt, in degrees.
double normal_angle_deg(double slant_deg, double tilt_deg, double other_slant_deg, double other_tilt_deg);

} // namespace overt
