#include "experiment/scene/making/mesh_cleaning.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/scene/making/vertex_welder.h"
#include "experiment/scene/mesh_topology.h"

namespace overt {
namespace {

// Differences of floats and their products are exact in double precision (barring extreme ratios), so the
// cross product is zero exactly when the corners lie on a line.
bool is_degenerate(const Mesh& mesh, const glm::uvec3& triangle) {
    if (triangle.x == triangle.y || triangle.y == triangle.z || triangle.z == triangle.x)
        return true;
    const glm::dvec3 a(mesh.positions[triangle.x]), b(mesh.positions[triangle.y]),
        c(mesh.positions[triangle.z]);
    return glm::cross(b - a, c - a) == glm::dvec3(0.0);
}

void weld(Mesh& mesh, double tolerance, MeshCleaningReport& report) {
    const std::size_t before = mesh.positions.size();
    VertexWelder welder(tolerance, before);
    std::vector<std::uint32_t> place_of(before);
    for (std::size_t i = 0; i < before; ++i) {
        const glm::dvec3 position(mesh.positions[i]);
        place_of[i] = welder.index_of(position);
        report.vertices_moved += welder.positions()[place_of[i]] != position ? 1 : 0;
    }
    mesh.positions.assign(welder.positions().begin(), welder.positions().end());
    for (glm::uvec3& triangle : mesh.triangles)
        triangle = {place_of[triangle.x], place_of[triangle.y], place_of[triangle.z]};
    report.weld_tolerance = tolerance;
    report.vertices_welded = before - mesh.positions.size();
}

// Keeps the triangles, with their parts and where they come from, for whose index `keep` says so; gives the
// number dropped.
template <class Keep>
std::size_t drop_triangles(Mesh& mesh, std::vector<CornersFrom>* from, const Keep& keep) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (!keep(i))
            continue;
        mesh.triangles[kept] = mesh.triangles[i];
        mesh.triangle_parts[kept] = mesh.triangle_parts[i];
        if (from)
            (*from)[kept] = (*from)[i];
        ++kept;
    }
    const std::size_t dropped = mesh.triangles.size() - kept;
    mesh.triangles.resize(kept);
    mesh.triangle_parts.resize(kept);
    if (from)
        from->resize(kept);
    return dropped;
}

// The same triangle, beginning with its lowest index.
glm::uvec3 lowest_first(const glm::uvec3& t) {
    if (t.x <= t.y && t.x <= t.z)
        return t;
    return t.y <= t.z ? glm::uvec3(t.y, t.z, t.x) : glm::uvec3(t.z, t.x, t.y);
}

// Triangles are compared within bins of the same lowest index.
std::size_t drop_duplicates(Mesh& mesh, std::vector<CornersFrom>* from) {
    const std::vector<glm::uvec3>& triangles = mesh.triangles;
    std::vector<std::uint32_t> bin_ends(mesh.positions.size() + 1, 0);
    for (const glm::uvec3& triangle : triangles)
        ++bin_ends[lowest_first(triangle).x];
    std::exclusive_scan(bin_ends.begin(), bin_ends.end(), bin_ends.begin(), 0u);
    std::vector<std::uint32_t> by_bin(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        by_bin[bin_ends[lowest_first(triangles[i]).x]++] = i;

    std::vector<bool> repeated(triangles.size(), false);
    const auto key = [&](std::uint32_t i) {
        const glm::uvec3 turned = lowest_first(triangles[i]);
        return std::array{turned.y, turned.z, i};
    };
    std::size_t begin = 0;
    for (std::size_t bin = 0; bin < mesh.positions.size(); ++bin) {
        const std::size_t end = bin_ends[bin];
        std::sort(by_bin.data() + begin, by_bin.data() + end,
                  [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
        for (std::size_t i = begin + 1; i < end; ++i) {
            repeated[by_bin[i]] =
                lowest_first(triangles[by_bin[i]]) == lowest_first(triangles[by_bin[i - 1]]);
        }
        begin = end;
    }
    return drop_triangles(mesh, from, [&](std::size_t i) { return !repeated[i]; });
}

std::size_t drop_unreferenced(Mesh& mesh) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const glm::uvec3& triangle : mesh.triangles) {
        used[triangle.x] = used[triangle.y] = used[triangle.z] = true;
    }
    std::vector<std::uint32_t> index_of(mesh.positions.size());
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (!used[i])
            continue;
        mesh.positions[kept] = mesh.positions[i];
        index_of[i] = kept++;
    }
    const std::size_t dropped = mesh.positions.size() - kept;
    mesh.positions.resize(kept);
    if (dropped > 0) {
        for (glm::uvec3& triangle : mesh.triangles) {
            triangle = {index_of[triangle.x], index_of[triangle.y], index_of[triangle.z]};
        }
    }
    return dropped;
}

std::string counted(std::size_t count, std::string_view one, std::string_view many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

} // namespace

MeshCleaningReport clean_mesh(Mesh& mesh, double weld_tolerance, std::vector<CornersFrom>* from) {
    OVERT_EXPECTS(mesh.triangle_parts.size() == mesh.triangles.size());
    OVERT_EXPECTS(mesh.triangles.size() <= 0xffffffffu);
    MeshCleaningReport report;
    report.vertices_read = mesh.positions.size();
    report.triangles_read = mesh.triangles.size();
    if (from) {
        from->assign(mesh.triangles.size(), {});
        for (std::uint32_t i = 0; i < from->size(); ++i)
            (*from)[i].triangle = i;
    }
    std::vector<bool> had_area(mesh.triangles.size());
    for (std::size_t i = 0; i < had_area.size(); ++i)
        had_area[i] = !is_degenerate(mesh, mesh.triangles[i]);
    weld(mesh, weld_tolerance, report);
    report.degenerate_faces_dropped = drop_triangles(mesh, from, [&](std::size_t i) {
        const bool has_area = !is_degenerate(mesh, mesh.triangles[i]);
        report.collapsed_faces_dropped += had_area[i] && !has_area ? 1 : 0;
        return has_area;
    });
    report.duplicate_faces_dropped = drop_duplicates(mesh, from);
    report.unreferenced_vertices_dropped = drop_unreferenced(mesh);

    const EdgeCounts edges = count_edges(mesh.triangles, mesh.positions.size());
    report.boundary_edges = edges.boundary;
    report.non_manifold_edges = edges.non_manifold;
    report.conflicting_edges = edges.conflicting;
    report.components = count_components(mesh.triangles, mesh.positions.size());
    report.inverted = signed_volume(mesh) < 0.0;
    if (report.inverted && edges.bounds_volume()) {
        for (glm::uvec3& triangle : mesh.triangles)
            std::swap(triangle.y, triangle.z);
        if (from)
            for (CornersFrom& corners : *from)
                std::swap(corners.corner[1], corners.corner[2]);
        report.flipped = true;
    }
    return report;
}

std::vector<std::string> describe(const MeshCleaningReport& report) {
    std::vector<std::string> sentences;
    const auto say = [&](std::size_t count, std::string_view one, std::string_view many,
                         std::string_view rest) {
        if (count > 0)
            sentences.push_back(fmt::format("{} {}", counted(count, one, many), rest));
    };
    sentences = report.part_remarks;
    if (report.rounding > 0.0) {
        sentences.push_back(fmt::format(
            "The mesh lies so far from the origin of its file that 32-bit coordinates from there would be "
            "wrong by up to {:.2g}: its own origin is the point ({}, {}, {}), turned and scaled as the mesh.",
            report.rounding, report.origin.x, report.origin.y, report.origin.z));
    }
    say(report.crossing_faces, "face", "faces",
        "of more than three corners cross themselves and have no inside; they were cut about their first "
        "corner.");
    say(report.vertices_without_place, "vertex was", "vertices were",
        "left aside: no face uses them, and their coordinates are no finite numbers.");
    // A file that has three vertices for each triangle, as every STL, says nothing by repeating them.
    if (report.vertices_read != 3 * report.triangles_read)
        say(report.vertices_welded - report.vertices_moved, "vertex was", "vertices were",
            "welded to another at the same place.");
    say(report.vertices_moved, "vertex was", "vertices were",
        fmt::format("welded to another within {:.2g} (weld_tolerance).", report.weld_tolerance));
    say(report.degenerate_faces_dropped - report.collapsed_faces_dropped, "face was", "faces were",
        "dropped: no area.");
    say(report.collapsed_faces_dropped, "face was", "faces were",
        "dropped: welding left them no area; a smaller weld_tolerance keeps them.");
    say(report.duplicate_faces_dropped, "face was", "faces were", "dropped: the same as another.");
    say(report.unreferenced_vertices_dropped, "vertex was", "vertices were", "dropped: no face uses it.");
    say(report.boundary_edges, "edge has", "edges have", "only one face: the surface has holes.");
    say(report.non_manifold_edges, "edge has", "edges have", "more than two faces.");
    say(report.conflicting_edges, "edge lies", "edges lie", "between faces whose fronts disagree.");
    if (report.components > 1) {
        sentences.push_back(fmt::format("The surface is in {} separate pieces.", report.components));
    }
    if (report.flipped) {
        sentences.emplace_back("The mesh was inside out; all its faces were turned round.");
    } else if (report.inverted) {
        sentences.emplace_back(
            "The mesh seems to be inside out, but was left so because it is not closed or its "
            "faces disagree; look at it with `overt play`.");
    }
    return sentences;
}

} // namespace overt
