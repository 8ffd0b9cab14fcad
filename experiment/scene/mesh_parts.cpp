#include "experiment/scene/mesh_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void expect_possible(const PartRegion& region) {
    if (region.name.empty())
        throw InputError("a part region has no name.");
    if (region.spheres.empty() && region.half_spaces.empty()) {
        throw InputError(fmt::format("the region of part '{}' has neither spheres nor planes.", region.name));
    }
    for (const glm::dvec4& sphere : region.spheres) {
        if (!is_finite(glm::dvec3(sphere)) || !std::isfinite(sphere.w) || sphere.w <= 0.0) {
            throw InputError(
                fmt::format("a sphere of part '{}' is at ({}, {}, {}) with radius {}; all must be finite "
                            "and the radius positive.",
                            region.name, sphere.x, sphere.y, sphere.z, sphere.w));
        }
    }
    for (const HalfSpace& half : region.half_spaces) {
        if (!is_finite(half.point) || !is_finite(half.normal) || half.normal == glm::dvec3(0.0)) {
            throw InputError(
                fmt::format("a plane of part '{}' passes through ({}, {}, {}) with the normal ({}, {}, "
                            "{}); all must be finite and the normal not 0.",
                            region.name, half.point.x, half.point.y, half.point.z, half.normal.x,
                            half.normal.y, half.normal.z));
        }
    }
}

void expect_few(std::size_t parts) {
    if (parts > max_mesh_parts) {
        throw InputError(
            fmt::format("the mesh has {} parts; at most {} can be told apart.", parts, max_mesh_parts));
    }
}

PartIndex part_named(Mesh& mesh, std::string_view name) {
    const auto found = std::find(mesh.part_names.begin(), mesh.part_names.end(), name);
    const auto index = found - mesh.part_names.begin();
    if (found == mesh.part_names.end())
        mesh.part_names.emplace_back(name);
    expect_few(mesh.part_names.size());
    return static_cast<PartIndex>(index);
}

glm::dvec3 centroid_of(const Mesh& mesh, const glm::uvec3& triangle) {
    return (glm::dvec3(mesh.positions[triangle.x]) + glm::dvec3(mesh.positions[triangle.y]) +
            glm::dvec3(mesh.positions[triangle.z])) /
           3.0;
}

[[noreturn]] void refuse_empty(const PartRegion& region, const Bounds& box) {
    throw InputError(
        fmt::format("the region of part '{}' contains no triangle (or an earlier region took them all). "
                    "The mesh reaches from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) in the "
                    "coordinates in which the region is looked for.",
                    region.name, box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z));
}

} // namespace

bool PartRegion::contains(const glm::dvec3& position) const {
    const bool in_sphere =
        spheres.empty() || std::any_of(spheres.begin(), spheres.end(), [&](const glm::dvec4& sphere) {
            return glm::distance(position, glm::dvec3(sphere)) <= sphere.w;
        });
    return in_sphere && std::all_of(half_spaces.begin(), half_spaces.end(),
                                    [&](const HalfSpace& half) { return half.contains(position); });
}

void label_parts(Mesh& mesh, std::span<const PartRegion> regions, std::string_view rest_name) {
    for (const PartRegion& region : regions)
        expect_possible(region);
    mesh.part_names.assign(1, std::string(rest_name));
    mesh.triangle_parts.assign(mesh.triangles.size(), PartIndex{0});
    std::vector<PartIndex> part_of_region;
    for (const PartRegion& region : regions)
        part_of_region.push_back(part_named(mesh, region.name));

    std::vector<bool> is_used(regions.size(), false);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::dvec3 centroid = centroid_of(mesh, mesh.triangles[i]);
        const auto region = std::find_if(regions.begin(), regions.end(), [&](const PartRegion& candidate) {
            return candidate.contains(centroid);
        });
        if (region == regions.end())
            continue;
        const std::size_t index = static_cast<std::size_t>(region - regions.begin());
        mesh.triangle_parts[i] = part_of_region[index];
        is_used[index] = true;
    }
    const auto unused = std::find(is_used.begin(), is_used.end(), false);
    if (unused != is_used.end())
        refuse_empty(regions[static_cast<std::size_t>(unused - is_used.begin())], mesh.bounds());
}

Mesh mesh_with_labelled_parts(RawMesh raw) {
    Mesh mesh;
    mesh.positions = std::move(raw.positions);
    mesh.triangles = std::move(raw.triangles);
    mesh.triangle_parts.assign(mesh.triangles.size(), PartIndex{0});
    std::map<PartLabel, std::string> names = raw.part_names;
    for (std::size_t i = 0; i < raw.triangle_labels.size(); ++i) {
        const PartLabel label = raw.triangle_labels[i];
        // Neighbouring triangles mostly share their part, so most need no look into the map.
        if (i == 0 || label != raw.triangle_labels[i - 1])
            names.try_emplace(label, fmt::format("part {}", label));
    }
    expect_few(names.size());
    if (names.empty() || (names.size() == 1 && raw.part_names.empty())) {
        mesh.part_names = {"body"};
        return mesh;
    }
    std::map<PartLabel, PartIndex> part_of_label;
    for (const auto& [label, name] : names) {
        part_of_label[label] = static_cast<PartIndex>(mesh.part_names.size());
        mesh.part_names.push_back(name);
    }
    PartIndex part = 0;
    for (std::size_t i = 0; i < raw.triangle_labels.size(); ++i) {
        const PartLabel label = raw.triangle_labels[i];
        if (i == 0 || label != raw.triangle_labels[i - 1])
            part = part_of_label[label];
        mesh.triangle_parts[i] = part;
    }
    return mesh;
}

} // namespace overt
