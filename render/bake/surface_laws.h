/// What layered surfaces are held against: laws of light, and numbers that others worked out. Tests demand
/// them, and `overt bench materials` lists them.
#pragma once

#include <string>
#include <vector>

#include "render/bake/layered_surface.h"

namespace overt {

/// A number of ours, what it has to be, and how near.
struct SurfaceLaw {
    std::string what;
    double ours = 0.0, known = 0.0;
    double tolerance = 0.0;
    bool is_bound = false; ///< it may also be below

    bool holds() const { return ours <= known + tolerance && (is_bound || ours >= known - tolerance); }
};

/// A plastic, a rough metal or a mixture, of grey `reflectance`.
LayeredSurface grey_surface(const MaterialSettings& material, double reflectance);

/// Share of light from everywhere that a surface sends to an eye at a cosine, in the first bin: by going
/// through the hemisphere in small steps, for roughnesses from 0.1 on.
double albedo_by_steps(const LayeredSurface& surface, double cosine);
/// The same by the directions that scatter() gives, `paths` of them.
double albedo_by_paths(const LayeredSurface& surface, double cosine, int paths);

/// How much f(v, l) and f(l, v) differ at most, as a share of the larger, over many pairs of directions.
double largest_asymmetry(const LayeredSurface& surface);

/// What is left of 1 when density() is summed over the hemisphere, and scatter()'s share of directions below
/// the surface is added.
double density_error(const LayeredSurface& surface, double cosine);
/// Chi square of scatter()'s directions against density(), over its degrees of freedom: about 1.
double density_misfit(const LayeredSurface& surface, double cosine, int paths);

/// All of them; a second or two.
std::vector<SurfaceLaw> surface_laws();

} // namespace overt
