#include "experiment/scene/sculptures/novel_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/scene/sculptures/clay.h"
#include "experiment/scene/sculptures/contouring.h"

namespace overt {

namespace {

/// Of all shapes: another number would be another set.
constexpr std::uint64_t set_seed = 20190401;

/// How far seams are filled.
constexpr double limb_blend_mm = 14.0, lump_blend_mm = 30.0;

/// A direction by its angles: 0 azimuth is to the right as seen from the front (-y), 90 away from the viewer.
glm::dvec3 direction(double azimuth_deg, double elevation_deg) {
    const double azimuth = azimuth_deg * 0.017453292519943295,
                 elevation = elevation_deg * 0.017453292519943295;
    return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
            std::sin(elevation)};
}

/// A limb that begins inside the trunk, bends once, and ends in a ball or a disc, or thins out.
Clay limb(const glm::dvec3& along, double trunk_mm, RandomStream& random) {
    const double length = random.uniform(60.0, 95.0), bend = random.uniform(-45.0, 45.0);
    const glm::dvec3 across = glm::normalize(
        glm::cross(along, std::abs(along.z) > 0.8 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0)));
    const glm::dvec3 root = 0.7 * trunk_mm * along, bent = (trunk_mm + 0.4 * length) * along + bend * across,
                     tip = (trunk_mm + length) * along + 0.6 * bend * glm::cross(along, across);
    const double thick = random.uniform(13.0, 20.0);
    Clay clay;
    switch (random.below(3)) {
    case 0: // a ball
        clay.add(cord(root, bent, tip, {thick, 0.7 * thick, 0.6 * thick}), limb_blend_mm);
        clay.add(sphere(tip, random.uniform(20.0, 28.0)), limb_blend_mm);
        break;
    case 1: // a disc
        clay.add(cord(root, bent, tip, {thick, 0.8 * thick, 0.7 * thick}), limb_blend_mm);
        clay.add(ellipsoid(tip, {30.0, 30.0, 11.0}, frame_of(glm::normalize(along + 0.3 * across), across)),
                 limb_blend_mm);
        break;
    default: // a horn
        clay.add(cord(root, bent, tip, {1.4 * thick, thick, 0.35 * thick}), limb_blend_mm);
        break;
    }
    return clay;
}

struct NovelShape {
    std::array<Clay, 4> parts; ///< trunk, crest, left, right

    explicit NovelShape(int number) {
        RandomStream random(set_seed, "novel shape", static_cast<std::uint64_t>(number));
        const double trunk_mm = random.uniform(42.0, 52.0);
        const glm::dvec3 half_axes(trunk_mm * random.uniform(0.9, 1.2), trunk_mm * random.uniform(0.8, 1.0),
                                   trunk_mm * random.uniform(0.9, 1.3));
        parts[0].add(ellipsoid(glm::dvec3(0.0), half_axes), lump_blend_mm);
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 on = direction(random.uniform(-160.0, -20.0), random.uniform(-60.0, 40.0));
            parts[0].add(sphere(0.85 * on * half_axes, random.uniform(14.0, 24.0)), lump_blend_mm);
        }
        parts[1] = limb(direction(random.uniform(0.0, 360.0), random.uniform(60.0, 85.0)), trunk_mm, random);
        parts[2] =
            limb(direction(random.uniform(150.0, 215.0), random.uniform(-35.0, 35.0)), trunk_mm, random);
        parts[3] =
            limb(direction(random.uniform(-35.0, 30.0), random.uniform(-35.0, 35.0)), trunk_mm, random);
    }

    Clay whole() const {
        Clay all = parts[0];
        for (std::size_t i = 1; i < parts.size(); ++i)
            all.add(parts[i], limb_blend_mm);
        return all;
    }

    PartIndex part_at(const glm::dvec3& point) const {
        std::size_t nearest = 0;
        for (std::size_t i = 1; i < parts.size(); ++i)
            if (parts[i].distance(point) < parts[nearest].distance(point))
                nearest = i;
        return static_cast<PartIndex>(nearest);
    }
};

} // namespace

std::span<const std::string> novel_shape_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (int number = 1; number <= novel_shape_count; ++number)
            all.push_back(fmt::format("shape-{:02}", number));
        return all;
    }();
    return names;
}

std::optional<int> novel_shape_number(std::string_view name) {
    const std::span<const std::string> names = novel_shape_names();
    const auto found = std::ranges::find(names, name);
    return found == names.end() ? std::nullopt : std::optional(1 + static_cast<int>(found - names.begin()));
}

Mesh make_novel_shape(int number, double cell_mm, int threads) {
    if (number < 1 || number > novel_shape_count)
        throw InputError(fmt::format("There are the shapes 1 to {}, and no {}.", novel_shape_count, number));
    if (!(cell_mm >= 1.0 && cell_mm <= 10.0))
        throw InputError(fmt::format("A shape's cells must be from 1 to 10 mm large, not {}.", cell_mm));
    const NovelShape shape(number);
    const Clay whole = shape.whole();
    ContourRequest request;
    request.distance = [&](const glm::dvec3& point) { return whole.distance(point); };
    request.cell_mm = cell_mm;
    request.threads = threads;
    const Ball ball = whole.ball();
    request.box_mm = {ball.centre - ball.radius - 2.0 * cell_mm, ball.centre + ball.radius + 2.0 * cell_mm};
    const ClosedSurface surface = contour(request);
    Bounds box{surface.positions.front(), surface.positions.front()};
    for (const glm::dvec3& position : surface.positions) {
        box.min = glm::min(box.min, position);
        box.max = glm::max(box.max, position);
    }
    const glm::dvec3 origin(box.centre().x, box.centre().y, box.min.z);
    Mesh mesh;
    mesh.part_names = {"trunk", "crest", "left", "right"};
    mesh.triangles = surface.triangles;
    for (const glm::dvec3& position : surface.positions)
        mesh.positions.emplace_back(position - origin);
    for (const glm::uvec3& t : surface.triangles)
        mesh.triangle_parts.push_back(
            shape.part_at((surface.positions[t.x] + surface.positions[t.y] + surface.positions[t.z]) / 3.0));
    return mesh;
}

} // namespace overt
