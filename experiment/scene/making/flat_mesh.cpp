#include "experiment/scene/making/flat_mesh.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/scene/areas.h"

namespace overt {

namespace {

/// From 0 to `length`: at even steps of about `step`, and at `wanted`.
std::vector<double> grid_lines(double length, double step, std::vector<double> wanted) {
    std::erase_if(wanted, [length](double at) { return !(at > 0.0 && at < length); });
    wanted.push_back(0.0);
    wanted.push_back(length);
    std::ranges::sort(wanted);
    // Nearer than this there would be triangles that are lines.
    const double least = 1e-3 * step;
    std::vector<double> lines{0.0};
    for (const double at : wanted) {
        const double from = lines.back();
        if (at - from < least)
            continue;
        const int steps = std::max(1, static_cast<int>(std::lround((at - from) / step)));
        for (int i = 1; i <= steps; ++i)
            lines.push_back(i == steps ? at : from + (at - from) * i / steps);
    }
    lines.back() = length;
    return lines;
}

} // namespace

Mesh make_flat_mesh(glm::dvec2 size, std::span<const PartRegion> regions) {
    if (!(size.x > 0.0 && size.y > 0.0))
        throw InputError(fmt::format("a picture of {:g} by {:g} mm has no surface", size.x, size.y));
    std::vector<double> across, upward;
    for (const PartRegion& region : regions)
        for (const auto& [low, high] : region.boxes) {
            across.insert(across.end(), {low.x, high.x});
            upward.insert(upward.end(), {low.z, high.z});
        }
    const double step = std::max(size.x, size.y) / flat_cells;
    const std::vector<double> x = grid_lines(size.x, step, std::move(across)),
                              z = grid_lines(size.y, step, std::move(upward));
    Mesh mesh;
    mesh.positions.reserve(x.size() * z.size());
    for (const double up : z)
        for (const double right : x)
            mesh.positions.emplace_back(right, 0.0, up);
    const auto columns = static_cast<std::uint32_t>(x.size());
    mesh.triangles.reserve(2 * (x.size() - 1) * (z.size() - 1));
    for (std::uint32_t row = 0; row + 1 < z.size(); ++row)
        for (std::uint32_t column = 0; column + 1 < columns; ++column) {
            const std::uint32_t corner = row * columns + column, above = corner + columns;
            mesh.triangles.emplace_back(corner, corner + 1, above + 1);
            mesh.triangles.emplace_back(corner, above + 1, above);
        }
    mesh.triangle_parts.assign(mesh.triangles.size(), 0);
    mesh.part_names = {std::string(rest_part)};
    if (!regions.empty())
        label_parts(mesh, regions);
    return mesh;
}

} // namespace overt
