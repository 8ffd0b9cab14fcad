#include "experiment/maps/reconstruction_file.h"

#include <bit>
#include <cstring>
#include <iterator>
#include <system_error>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"

namespace overt {

namespace {

template <class T> void append(std::string& bytes, T value) {
    static_assert(std::endian::native == std::endian::little, "PLY is written as it stands in memory");
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes.append(raw, sizeof(T));
}

void append(std::string& bytes, const glm::vec3& value) {
    append(bytes, value.x);
    append(bytes, value.y);
    append(bytes, value.z);
}

std::string as_ply(const Reconstruction& made, std::span<const std::string> part_names) {
    std::string bytes = "ply\nformat binary_little_endian 1.0\n";
    for (std::size_t part = 0; part < part_names.size(); ++part)
        bytes += fmt::format("comment part {} {}\n", part, part_names[part]);
    bytes += fmt::format("element vertex {}\n", made.positions.size());
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
        bytes += fmt::format("property float {}\n", name);
    bytes += "property uchar part\nproperty ushort views\n";
    if (!made.triangles.empty())
        bytes +=
            fmt::format("element face {}\nproperty list uchar int vertex_indices\n", made.triangles.size());
    bytes += "end_header\n";
    bytes.reserve(bytes.size() + 27 * made.positions.size() + 13 * made.triangles.size());
    for (std::size_t i = 0; i < made.positions.size(); ++i) {
        append(bytes, made.positions[i]);
        append(bytes, made.normals[i]);
        append(bytes, made.parts[i]);
        append(bytes, made.views[i]);
    }
    for (const glm::uvec3& triangle : made.triangles) {
        append(bytes, std::uint8_t{3});
        for (int corner = 0; corner < 3; ++corner)
            append(bytes, static_cast<std::int32_t>(triangle[corner]));
    }
    return bytes;
}

std::string as_obj(const Reconstruction& made, std::span<const std::string> part_names) {
    std::string text = "# object coordinates, +z up\n";
    auto into = std::back_inserter(text);
    for (const glm::vec3& position : made.positions)
        fmt::format_to(into, "v {} {} {}\n", position.x, position.y, position.z);
    for (const glm::vec3& normal : made.normals)
        fmt::format_to(into, "vn {} {} {}\n", normal.x, normal.y, normal.z);
    for (std::size_t part = 0; part < part_names.size(); ++part) {
        const auto is_of_part = [&](std::size_t point) { return made.parts[point] == part; };
        fmt::format_to(into, "g {}\n", part_names[part]);
        for (const glm::uvec3& triangle : made.triangles) {
            if (is_of_part(triangle.x))
                fmt::format_to(into, "f {0}//{0} {1}//{1} {2}//{2}\n", triangle.x + 1, triangle.y + 1,
                               triangle.z + 1);
        }
        for (std::size_t point = 0; made.triangles.empty() && point < made.positions.size(); ++point) {
            if (is_of_part(point))
                fmt::format_to(into, "p {}\n", point + 1);
        }
    }
    return text;
}

} // namespace

void write_reconstruction(const std::filesystem::path& file, const Reconstruction& reconstruction,
                          std::span<const std::string> part_names) {
    std::string content;
    if (file.extension() == ".ply") {
        content = as_ply(reconstruction, part_names);
    } else if (file.extension() == ".obj") {
        content = as_obj(reconstruction, part_names);
    } else {
        throw InputError(
            fmt::format("{}: a reconstruction is written as .ply or .obj: end the name so", file.string()));
    }
    if (replace_file(file, std::as_bytes(std::span(content))) != 0)
        throw RecordError(
            fmt::format("{}: cannot be written: check the folder and the disk's space", file.string()));
}

} // namespace overt
