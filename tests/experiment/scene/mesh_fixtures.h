/// Meshes and mesh files for tests.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include "experiment/scene/mesh.h"
#include "tests/support/figures.h"
#include "tests/support/temporary_folder.h"

namespace overt::test {

inline Mesh with_one_part(Mesh mesh) {
    mesh.triangle_parts.assign(mesh.triangles.size(), PartIndex{0});
    mesh.part_names = {"body"};
    return mesh;
}

/// The cube from 0 to 1: 8 vertices, 12 triangles, volume 1, fronts outwards.
inline Mesh cube() {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return with_one_part(std::move(mesh));
}

/// A closed ball of radius 1 about the origin, with a bump so that no rotation leaves it as it is.
inline Mesh bumpy_ball(int rings = 9, int segments = 14) {
    Mesh mesh;
    mesh.positions.emplace_back(0.0f, 0.0f, 1.5f);
    for (int ring = 1; ring < rings; ++ring) {
        for (int segment = 0; segment < segments; ++segment) {
            const double polar = std::numbers::pi * ring / rings;
            const double azimuth = 2.0 * std::numbers::pi * segment / segments;
            const double radius = 1.0 + 0.2 * std::cos(azimuth - 0.3) * std::sin(polar);
            mesh.positions.emplace_back(radius * std::sin(polar) * std::cos(azimuth),
                                        radius * std::sin(polar) * std::sin(azimuth),
                                        radius * std::cos(polar));
        }
    }
    mesh.positions.emplace_back(0.0f, 0.0f, -1.0f);
    mesh.triangles = ball_triangles(rings, segments);
    return with_one_part(std::move(mesh));
}

/// Bytes of a number in the given order.
template <class T> std::string stored(T value, std::endian order = std::endian::little) {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    if (order != std::endian::native)
        std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

enum class PlyForm { text, little_endian, big_endian };

inline std::string ply_format_line(PlyForm form) {
    return form == PlyForm::text            ? "format ascii 1.0\n"
           : form == PlyForm::little_endian ? "format binary_little_endian 1.0\n"
                                            : "format binary_big_endian 1.0\n";
}

/// A value of a PLY body.
template <class T> std::string ply_value(PlyForm form, T value) {
    if (form == PlyForm::text)
        return fmt::format("{} ", value);
    return stored(value, form == PlyForm::little_endian ? std::endian::little : std::endian::big);
}

inline std::string as_ply(const Mesh& mesh, PlyForm form) {
    const std::string line_end = form == PlyForm::text ? "\n" : "";
    std::string text = "ply\n" + ply_format_line(form);
    text += fmt::format("element vertex {}\nproperty float x\nproperty float y\nproperty float z\n",
                        mesh.positions.size());
    text += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                        mesh.triangles.size());
    for (const glm::vec3& p : mesh.positions) {
        text += ply_value(form, p.x) + ply_value(form, p.y) + ply_value(form, p.z) + line_end;
    }
    for (const glm::uvec3& t : mesh.triangles) {
        text += ply_value(form, std::uint8_t{3});
        for (int corner = 0; corner < 3; ++corner)
            text += ply_value(form, std::int32_t(t[corner]));
        text += line_end;
    }
    return text;
}

inline std::string as_obj(const Mesh& mesh) {
    std::string text = "# a mesh\n";
    for (const glm::vec3& p : mesh.positions)
        text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    for (const glm::uvec3& t : mesh.triangles)
        text += fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
    return text;
}

inline std::string as_binary_stl(const Mesh& mesh, std::string_view comment = "made for a test") {
    std::string bytes(comment);
    bytes.resize(80, '\0');
    bytes += stored(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const glm::uvec3& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i)
            bytes += stored(0.0f);
        for (int corner = 0; corner < 3; ++corner) {
            for (int axis = 0; axis < 3; ++axis)
                bytes += stored(mesh.positions[t[corner]][axis]);
        }
        bytes += stored(std::uint16_t{0});
    }
    return bytes;
}

inline std::string as_text_stl(const Mesh& mesh) {
    std::string text = "solid a test\n";
    for (const glm::uvec3& t : mesh.triangles) {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec3& p = mesh.positions[t[corner]];
            text += fmt::format("      vertex {} {} {}\n", p.x, p.y, p.z);
        }
        text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid a test\n";
}

/// Corner positions of all triangles, which do not depend on how vertices are numbered.
template <class AnyMesh> std::vector<glm::vec3> corners_of(const AnyMesh& mesh) {
    std::vector<glm::vec3> corners;
    for (const glm::uvec3& t : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner)
            corners.push_back(mesh.positions[t[corner]]);
    }
    return corners;
}

inline std::vector<glm::vec3> in_floats(const std::vector<glm::dvec3>& places) {
    return {places.begin(), places.end()};
}

/// What the function's InputError says; empty if it throws none.
template <class Error, class Function> std::string message_of(const Function& function) {
    try {
        function();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

} // namespace overt::test
