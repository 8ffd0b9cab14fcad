#include "app/stimuli/map_figures.h"

#include <algorithm>
#include <cmath>

namespace overt {

BenchFigures figures_of(const MapCheck& check, glm::ivec2 image_px, const std::string& name) {
    const double area = double{1.0} * image_px.x * image_px.y / (1024.0 * 1024.0);
    const auto figure = [&](const char* what) { return name + ", " + what; };
    // The bound of the mean of 16-bit codes is what rounding does to the same places (about 0.375 where the
    // surface lies at random to the codes), and twice what the map itself may be off: see
    // MapCheck::excess_lsb.
    constexpr double float_mean = 0.007;
    return {
        at_most(figure("pixels whose coverage differs from ray casting, worst map"),
                check.coverage_differs_px, "px", std::floor(10.0 * std::max(1.0, area))),
        at_most(figure("float map, interior, mean error"), check.as_float.mean_lsb, "LSB", float_mean),
        at_most(figure("float map, interior, 99.9 % below"), check.as_float.p99_9_lsb, "LSB", 0.04),
        {figure("float map, interior, largest error"), check.as_float.max_lsb, "LSB"},
        {figure("16-bit map, interior, mean error"), check.as_codes.mean_lsb, "LSB"},
        {figure("16-bit map, interior, mean of rounding itself"), check.rounding_mean_lsb, "LSB"},
        at_most(figure("16-bit map, interior, mean error beyond rounding"), check.excess_lsb, "LSB",
                2.0 * float_mean),
        at_most(figure("16-bit map, interior, 99.9 % below"), check.as_codes.p99_9_lsb, "LSB", 0.51),
        {figure("16-bit map, interior, largest error"), check.as_codes.max_lsb, "LSB"},
        at_most(figure("farthest covered pixel off the surface"), check.farthest_off_surface, "diagonals",
                1e-6),
        {figure("pixels covered, all maps"), double{1.0} * check.covered_px, "px"},
        {figure("pixels in the interior, all maps"), double{1.0} * check.interior_px, "px"},
    };
}

} // namespace overt
