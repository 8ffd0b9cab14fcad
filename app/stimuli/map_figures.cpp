#include "app/stimuli/map_figures.h"

#include <algorithm>
#include <cmath>

namespace overt {

BenchFigures figures_of(const MapCheck& check, glm::ivec2 image_px, const std::string& name) {
    const double area = double{1.0} * image_px.x * image_px.y / (1024.0 * 1024.0);
    const auto figure = [&](const char* what) { return name + ", " + what; };
    // Rounding allows half a code of each coordinate, and the float map's own error: no pixel may be farther
    // off, and so no mean. Where a surface is at random to the codes the mean is 0.375, that of the largest
    // of three errors that are uniform within half a code; a face along an axis has the same error all over.
    return {
        at_most(figure("pixels whose coverage differs from ray casting, worst map"),
                check.coverage_differs_px, "px", std::floor(10.0 * std::max(1.0, area))),
        at_most(figure("float map, interior, mean error"), check.as_float.mean_lsb, "LSB", 0.007),
        at_most(figure("float map, interior, 99.9 % below"), check.as_float.p99_9_lsb, "LSB", 0.04),
        {figure("float map, interior, largest error"), check.as_float.max_lsb, "LSB"},
        at_most(figure("16-bit map, interior, mean error"), check.as_codes.mean_lsb, "LSB", 0.5),
        at_most(figure("16-bit map, interior, 99.9 % below"), check.as_codes.p99_9_lsb, "LSB", 0.51),
        {figure("16-bit map, interior, largest error"), check.as_codes.max_lsb, "LSB"},
        at_most(figure("farthest covered pixel off the surface"), check.farthest_off_surface, "diagonals",
                1e-6),
        {figure("pixels covered, all maps"), double{1.0} * check.covered_px, "px"},
        {figure("pixels in the interior, all maps"), double{1.0} * check.interior_px, "px"},
    };
}

} // namespace overt
