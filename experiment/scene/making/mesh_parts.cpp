#include "experiment/scene/making/mesh_parts.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/scene/areas.h"

namespace overt {
namespace {

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

using AreaFaults = std::vector<AreaError::Fault>;

void find_impossible(const PartRegion& region, AreaFaults& faults) {
    const auto fault = [&](std::string message) { faults.push_back({region.name, std::move(message)}); };
    if (region.name.empty())
        fault("an area has no name.");
    if (region.name.find(between_areas) != std::string::npos)
        fault(fmt::format("the name of area '{}' has a slash, which stands between areas.", region.name));
    if (region.spheres.empty() && region.half_spaces.empty() && region.boxes.empty() && region.groups.empty())
        fault(fmt::format("area '{}' has neither spheres, boxes, groups nor planes.", region.name));
    for (const auto& [low, high] : region.boxes) {
        if (!is_finite(low) || !is_finite(high) || !glm::all(glm::lessThan(low, high)))
            fault(fmt::format(
                "a box of area '{}' reaches from ({}, {}, {}) to ({}, {}, {}); all must be finite, "
                "and the first corner the smaller one.",
                region.name, low.x, low.y, low.z, high.x, high.y, high.z));
    }
    for (const glm::dvec4& sphere : region.spheres) {
        if (!is_finite(glm::dvec3(sphere)) || !std::isfinite(sphere.w) || sphere.w <= 0.0)
            fault(
                fmt::format("a sphere of area '{}' is at ({}, {}, {}) with radius {}; all must be finite and "
                            "the radius positive.",
                            region.name, sphere.x, sphere.y, sphere.z, sphere.w));
    }
    for (const HalfSpace& half : region.half_spaces) {
        if (!is_finite(half.point) || !is_finite(half.normal) || half.normal == glm::dvec3(0.0))
            fault(
                fmt::format("a plane of area '{}' passes through ({}, {}, {}) with the normal ({}, {}, {}); "
                            "all must be finite and the normal not 0.",
                            region.name, half.point.x, half.point.y, half.point.z, half.normal.x,
                            half.normal.y, half.normal.z));
    }
}

void expect_few(std::size_t parts) {
    if (parts > max_mesh_parts) {
        throw InputError(
            fmt::format("the mesh has {} parts; at most {} can be told apart.", parts, max_mesh_parts));
    }
}

/// The corners of a triangle, in the coordinates of the regions.
using RegionPlaces = std::span<const glm::dvec3>;

double area_of(RegionPlaces places, const glm::uvec3& t) {
    return 0.5 * glm::length(glm::cross(places[t.y] - places[t.x], places[t.z] - places[t.x]));
}

std::string words_of_empty(const PartRegion& region, RegionPlaces places) {
    glm::dvec3 min = places.front(), max = places.front();
    for (const glm::dvec3& place : places) {
        min = glm::min(min, place);
        max = glm::max(max, place);
    }
    return fmt::format("area '{}' contains no triangle. The mesh reaches from ({:.6g}, {:.6g}, {:.6g}) to "
                       "({:.6g}, {:.6g}, {:.6g}) in the coordinates in which it is looked for.",
                       region.name, min.x, min.y, min.z, max.x, max.y, max.z);
}

/// The regions of one name are one bit.
using RegionMask = std::uint64_t;

struct NamedRegions {
    std::vector<std::string> names; ///< each once, by bit
    std::vector<RegionMask> bits;   ///< by region

    explicit NamedRegions(std::span<const PartRegion> regions) {
        for (const PartRegion& region : regions) {
            const auto at = std::ranges::find(names, region.name) - names.begin();
            if (at == std::ssize(names))
                names.push_back(region.name);
            bits.push_back(RegionMask{1} << at);
        }
    }
};

void find_unknown_groups(const Mesh& mesh, bool is_divided, const PartRegion& region, AreaFaults& faults) {
    for (const std::string& group : region.groups) {
        if (is_divided && std::ranges::find(mesh.part_names, group) != mesh.part_names.end())
            continue;
        faults.push_back(
            {region.name,
             fmt::format("area '{}' is said to have the group '{}', but the mesh {}.", region.name, group,
                         is_divided ? fmt::format("has '{}'", fmt::join(mesh.part_names, "', '"))
                                    : std::string("file labels no groups, and no file of labels "
                                                  "is given"))});
    }
}

/// Of each triangle, the regions that have it. Throws AreaError if one has none, with the faults that others
/// have.
std::vector<RegionMask> regions_of(const Mesh& mesh, std::span<const PartRegion> regions,
                                   const NamedRegions& named, RegionPlaces places, AreaFaults faults) {
    std::vector<bool> is_used(regions.size(), false);
    std::vector<RegionMask> found(mesh.triangles.size(), 0);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3& t = mesh.triangles[i];
        const glm::dvec3 centroid = (places[t.x] + places[t.y] + places[t.z]) / 3.0;
        const std::string& part = mesh.part_names[mesh.triangle_parts[i]];
        for (std::size_t r = 0; r < regions.size(); ++r) {
            if (!regions[r].contains(centroid, part))
                continue;
            found[i] |= named.bits[r];
            is_used[r] = true;
        }
    }
    for (std::size_t r = 0; r < regions.size(); ++r) {
        const bool is_told =
            std::ranges::find(faults, regions[r].name, &AreaError::Fault::area) != faults.end();
        if (!is_used[r] && !is_told)
            faults.push_back({regions[r].name, words_of_empty(regions[r], places)});
    }
    if (!faults.empty())
        throw AreaError(std::move(faults));
    return found;
}

/// Triangles that had the same part and are in the same regions.
struct AreaCell {
    PartIndex part;
    RegionMask regions;
    friend auto operator<=>(const AreaCell&, const AreaCell&) = default;
};

/// The names of the areas that a cell belongs to, each once; regions first.
std::vector<std::string> names_of_cell(const AreaCell& cell, bool is_divided, const Mesh& mesh,
                                       const NamedRegions& named) {
    std::vector<std::string> names;
    for (std::size_t bit = 0; bit < named.names.size(); ++bit) {
        if (cell.regions >> bit & 1)
            names.push_back(named.names[bit]);
    }
    const std::string& own = mesh.part_names[cell.part];
    if ((is_divided || names.empty()) && std::ranges::find(names, own) == names.end())
        names.push_back(own);
    return names;
}

} // namespace

AreaError::AreaError(std::vector<Fault> faults)
    : InputError([&] {
          std::string all;
          for (const Fault& fault : faults)
              all += (all.empty() ? "" : " ") + fault.message;
          return all;
      }()),
      faults_(std::move(faults)) {}

AreaError::AreaError(const std::string& file, const AreaError& error)
    : InputError(fmt::format("{}: {}", file, error.what())), faults_(error.faults_) {}

bool PartRegion::contains(const glm::dvec3& position, std::string_view part) const {
    const bool is_everywhere = spheres.empty() && boxes.empty() && groups.empty();
    const bool is_in_one =
        is_everywhere ||
        std::ranges::any_of(
            spheres, [&](auto& sphere) { return glm::distance(position, glm::dvec3(sphere)) <= sphere.w; }) ||
        std::ranges::any_of(boxes,
                            [&](auto& box) {
                                return glm::all(glm::lessThanEqual(box[0], position)) &&
                                       glm::all(glm::lessThanEqual(position, box[1]));
                            }) ||
        std::ranges::find(groups, part) != groups.end();
    return is_in_one &&
           std::ranges::all_of(half_spaces, [&](const HalfSpace& half) { return half.contains(position); });
}

std::vector<std::string> label_parts(Mesh& mesh, std::span<const PartRegion> regions,
                                     std::span<const glm::dvec3> places) {
    const bool is_divided = mesh.part_names.size() > 1;
    AreaFaults faults;
    for (const PartRegion& region : regions) {
        find_impossible(region, faults);
        find_unknown_groups(mesh, is_divided, region, faults);
    }
    std::vector<glm::dvec3> own;
    if (places.empty()) {
        own.assign(mesh.positions.begin(), mesh.positions.end());
        places = own;
    }
    std::set<std::string> names(mesh.part_names.begin(), mesh.part_names.end());
    for (const PartRegion& region : regions)
        names.insert(region.name);
    expect_few(names.size());
    std::set<std::string> region_names;
    for (const PartRegion& region : regions)
        region_names.insert(region.name);
    if (region_names.size() > most_regions)
        throw InputError(fmt::format("{} areas are described; at most {} can be, beside those that the mesh "
                                     "file labels.",
                                     region_names.size(), most_regions));
    const NamedRegions named(regions);
    const std::vector<RegionMask> region_of = regions_of(mesh, regions, named, places, std::move(faults));

    // What there is of each cell, in the order of the parts that the mesh had; those of no triangle stay.
    std::map<AreaCell, double> sizes;
    for (std::size_t part = 0; part < mesh.part_names.size(); ++part) {
        if (is_divided)
            sizes[{static_cast<PartIndex>(part), 0}];
    }
    std::map<AreaCell, bool> is_met;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const AreaCell cell{mesh.triangle_parts[i], region_of[i]};
        sizes[cell] += area_of(places, mesh.triangles[i]);
        is_met[cell] = true;
    }
    std::map<std::string, double> area_sizes;
    std::vector<bool> part_is_met(mesh.part_names.size(), false);
    for (const auto& [cell, size] : sizes) {
        for (const std::string& name : names_of_cell(cell, is_divided, mesh, named))
            area_sizes[name] += size;
        if (is_met.contains(cell))
            part_is_met[cell.part] = true;
    }
    std::vector<std::string> part_names;
    std::map<AreaCell, PartIndex> part_of_cell;
    for (const auto& [cell, size] : sizes) {
        if (!is_met.contains(cell) && part_is_met[cell.part])
            continue; // all of the part lies in regions
        std::vector<std::string> of_cell = names_of_cell(cell, is_divided, mesh, named);
        std::ranges::stable_sort(of_cell, std::greater(), [&](auto& name) { return area_sizes.at(name); });
        const std::string name = fmt::format("{}", fmt::join(of_cell, std::string_view(&between_areas, 1)));
        const auto at = std::ranges::find(part_names, name) - part_names.begin();
        if (at == std::ssize(part_names))
            part_names.push_back(name);
        expect_few(part_names.size());
        part_of_cell[cell] = static_cast<PartIndex>(at);
    }
    std::vector<std::string> sentences;
    for (const std::string& name : named.names) {
        if (is_divided && std::ranges::find(mesh.part_names, name) != mesh.part_names.end())
            sentences.push_back(
                fmt::format("Part '{0}' is labelled, and a region of that name is given: what "
                            "either says is area '{0}'.",
                            name));
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        mesh.triangle_parts[i] = part_of_cell.at({mesh.triangle_parts[i], region_of[i]});
    mesh.part_names = std::move(part_names);
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
