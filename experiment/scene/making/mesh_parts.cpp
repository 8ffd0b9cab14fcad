#include "experiment/scene/making/mesh_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
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

/// The corners of a triangle, in the coordinates of the regions.
using RegionPlaces = std::span<const glm::dvec3>;

double area_of(RegionPlaces places, const glm::uvec3& t) {
    return 0.5 * glm::length(glm::cross(places[t.y] - places[t.x], places[t.z] - places[t.x]));
}

[[noreturn]] void refuse_empty(const PartRegion& region, RegionPlaces places) {
    glm::dvec3 min = places.front(), max = places.front();
    for (const glm::dvec3& place : places) {
        min = glm::min(min, place);
        max = glm::max(max, place);
    }
    throw InputError(
        fmt::format("the region of part '{}' contains no triangle (or an earlier region took them all). "
                    "The mesh reaches from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) in the "
                    "coordinates in which the region is looked for.",
                    region.name, min.x, min.y, min.z, max.x, max.y, max.z));
}

constexpr std::size_t no_region = static_cast<std::size_t>(-1);

/// The region that has each triangle. Throws InputError if one has none.
std::vector<std::size_t> regions_of(const Mesh& mesh, std::span<const PartRegion> regions,
                                    RegionPlaces places) {
    std::vector<bool> is_used(regions.size(), false);
    std::vector<std::size_t> found;
    found.reserve(mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 centroid = (places[t.x] + places[t.y] + places[t.z]) / 3.0;
        const auto region = std::ranges::find_if(
            regions, [&](const PartRegion& candidate) { return candidate.contains(centroid); });
        if (region == regions.end()) {
            found.push_back(no_region);
            continue;
        }
        found.push_back(static_cast<std::size_t>(region - regions.begin()));
        is_used[found.back()] = true;
    }
    const auto unused = std::ranges::find(is_used, false);
    if (unused != is_used.end())
        refuse_empty(regions[static_cast<std::size_t>(unused - is_used.begin())], places);
    return found;
}

/// Of a part that the mesh had: where its triangles lie.
struct PartInRegions {
    std::size_t triangles = 0, in_regions = 0;
    double area = 0.0, area_in_regions = 0.0;
    std::string region; ///< name of the one that has all so far; empty if there are several

    bool lies_within() const { return triangles > 0 && in_regions == triangles && !region.empty(); }
};

std::vector<PartInRegions> parts_in_regions(const Mesh& mesh, std::span<const PartRegion> regions,
                                            std::span<const std::size_t> region_of, RegionPlaces places) {
    std::vector<PartInRegions> parts(mesh.part_names.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        PartInRegions& part = parts[mesh.triangle_parts[i]];
        const double area = area_of(places, mesh.triangles[i]);
        ++part.triangles;
        part.area += area;
        if (region_of[i] == no_region)
            continue;
        const std::string& region = regions[region_of[i]].name;
        part.region = part.in_regions == 0 || part.region == region ? region : std::string();
        ++part.in_regions;
        part.area_in_regions += area;
    }
    return parts;
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

bool is_of_head(std::string_view part_name) {
    return part_name == head_part ||
           (part_name.starts_with(head_part) && part_name.substr(head_part.size()).starts_with('/'));
}

HeadParts::HeadParts(std::span<const std::string> part_names) {
    for (const std::string& name : part_names)
        parts_.push_back(is_of_head(name));
}

bool HeadParts::has_value() const { return std::ranges::find(parts_, true) != parts_.end(); }

std::vector<std::string> label_parts(Mesh& mesh, std::span<const PartRegion> regions,
                                     std::span<const glm::dvec3> places) {
    for (const PartRegion& region : regions)
        expect_possible(region);
    std::vector<glm::dvec3> own;
    if (places.empty()) {
        own.assign(mesh.positions.begin(), mesh.positions.end());
        places = own;
    }
    std::set<std::string> names(mesh.part_names.begin(), mesh.part_names.end());
    for (const PartRegion& region : regions)
        names.insert(region.name);
    expect_few(names.size());
    const std::vector<std::size_t> region_of = regions_of(mesh, regions, places);
    const std::vector<PartInRegions> before = parts_in_regions(mesh, regions, region_of, places);
    const bool is_divided = before.size() > 1;
    std::vector<std::string> sentences;
    for (std::size_t part = 0; is_divided && part < before.size(); ++part) {
        std::string& name = mesh.part_names[part];
        const bool is_same =
            std::ranges::any_of(regions, [&](const PartRegion& r) { return r.name == name; });
        if (is_same) {
            sentences.push_back(
                fmt::format("Part '{0}' is labelled, and a region of that name is given: what "
                            "either says is part '{0}'.",
                            name));
        } else if (before[part].lies_within()) {
            name = fmt::format("{}/{}", before[part].region, name);
        } else if (before[part].in_regions > 0) {
            sentences.push_back(fmt::format(
                "{:.1f} % of the area of part '{}' lies in '{}' and is counted there.",
                100.0 * before[part].area_in_regions / before[part].area, name,
                before[part].region.empty() ? std::string("several regions") : before[part].region));
        }
    }
    std::vector<PartIndex> part_of_region;
    for (const PartRegion& region : regions)
        part_of_region.push_back(part_named(mesh, region.name));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const bool keeps_own = is_divided && before[mesh.triangle_parts[i]].lies_within();
        if (region_of[i] != no_region && !keeps_own)
            mesh.triangle_parts[i] = part_of_region[region_of[i]];
    }
    return sentences;
}

Mesh mesh_with_labelled_parts(RawMesh raw) {
    Mesh mesh;
    mesh.positions.assign(raw.positions.begin(), raw.positions.end());
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
