#include "experiment/scene/files/ply_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"

namespace overt {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, std::string_view what) {
    throw RecordError(fmt::format("{}: the mesh cannot be written: {}. Make room, or check the folder's "
                                  "permissions.",
                                  path.string(), what));
}

template <class T> void put(std::string& content, T value) {
    auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if constexpr (std::endian::native == std::endian::big)
        std::reverse(bytes.begin(), bytes.end());
    content.append(bytes.data(), bytes.size());
}

std::string header_of(const std::filesystem::path& path, const Mesh& mesh) {
    std::string header = "ply\nformat binary_little_endian 1.0\n";
    for (std::size_t part = 0; part < mesh.part_names.size(); ++part) {
        const std::string& name = mesh.part_names[part];
        if (name.find_first_of("\r\n") != std::string_view::npos)
            refuse(path, fmt::format("part name {} has a line end", part));
        header += fmt::format("comment part {} {}\n", part, name);
    }
    header += fmt::format("element vertex {}\nproperty float x\nproperty float y\nproperty float z\n",
                          mesh.positions.size());
    header += fmt::format(
        "element face {}\nproperty list uchar int vertex_indices\nproperty uchar part\nend_header\n",
        mesh.triangles.size());
    return header;
}

} // namespace

void write_ply(const std::filesystem::path& path, const Mesh& mesh) {
    OVERT_EXPECTS(mesh.triangle_parts.size() == mesh.triangles.size());
    constexpr std::size_t vertex_bytes = 12, triangle_bytes = 14;
    std::string content = header_of(path, mesh);
    content.reserve(content.size() + vertex_bytes * mesh.positions.size() +
                    triangle_bytes * mesh.triangles.size());
    for (const glm::vec3& position : mesh.positions) {
        put(content, position.x);
        put(content, position.y);
        put(content, position.z);
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        put(content, std::uint8_t{3});
        for (int corner = 0; corner < 3; ++corner)
            put(content, mesh.triangles[i][corner]);
        put(content, mesh.triangle_parts[i]);
    }
    if (const int error = replace_file(path, std::as_bytes(std::span(content))); error != 0)
        refuse(path, std::generic_category().message(error));
}

} // namespace overt
