#include "experiment/surface/coloured_mesh_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/base/error.h"
#include "experiment/base/json_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/scene/surface_appearance.h"
#include "experiment/surface/colour_scale.h"

namespace overt {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class T> void append_bytes(std::string& bytes, T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes.append(raw, sizeof(T));
}

// +z up and the front towards -y become +y up and the front towards +z.
glm::vec3 gltf_position(const glm::vec3& p) { return {p.x, p.z, -p.y}; }

void pad(std::string& bytes, char with) { bytes.append((4 - bytes.size() % 4) % 4, with); }

constexpr int array_buffer = 34962, element_array_buffer = 34963;
constexpr int type_float = 5126, type_ushort = 5123, type_uint = 5125;

} // namespace

void write_glb(const std::filesystem::path& path, const ColouredMesh& coloured) {
    const Mesh& mesh = coloured.mesh;
    const std::size_t count = mesh.positions.size();
    OVERT_EXPECTS(coloured.values.size() == count && coloured.srgb.size() == count &&
                  !mesh.triangles.empty());
    using Json = nlohmann::ordered_json;
    std::string binary;
    Json views = Json::array(), accessors = Json::array();
    const auto add_view = [&](std::size_t begin, int target, std::size_t stride) {
        Json view{{"buffer", 0}, {"byteOffset", begin}, {"byteLength", binary.size() - begin}};
        if (stride > 0)
            view["byteStride"] = stride;
        view["target"] = target;
        views.push_back(view);
    };
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (const glm::vec3& position : mesh.positions) {
        const glm::vec3 p = gltf_position(glm::vec3(coloured.scale * glm::dvec3(position)));
        low = glm::min(low, p);
        high = glm::max(high, p);
        for (int axis = 0; axis < 3; ++axis)
            append_bytes(binary, p[axis]);
    }
    add_view(0, array_buffer, 12);
    accessors.push_back({{"bufferView", 0},
                         {"componentType", type_float},
                         {"count", count},
                         {"type", "VEC3"},
                         {"min", {low.x, low.y, low.z}},
                         {"max", {high.x, high.y, high.z}}});
    // Four channels of 16 bits: attributes of a vertex begin at multiples of four bytes.
    std::array<std::uint16_t, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i)
        linear[i] = static_cast<std::uint16_t>(
            std::lround(65535.0 * double{linear_of_srgb(static_cast<std::uint8_t>(i))}));
    std::size_t begin = binary.size();
    for (const auto& colour : coloured.srgb) {
        for (const std::uint8_t channel : colour)
            append_bytes(binary, linear[channel]);
        append_bytes(binary, std::uint16_t{65535});
    }
    add_view(begin, array_buffer, 8);
    accessors.push_back({{"bufferView", 1},
                         {"componentType", type_ushort},
                         {"normalized", true},
                         {"count", count},
                         {"type", "VEC4"}});
    begin = binary.size();
    const auto [least, most] = std::ranges::minmax_element(coloured.values);
    for (const float value : coloured.values)
        append_bytes(binary, value);
    add_view(begin, array_buffer, 4);
    accessors.push_back({{"bufferView", 2},
                         {"componentType", type_float},
                         {"count", count},
                         {"type", "SCALAR"},
                         {"min", {*least}},
                         {"max", {*most}}});
    begin = binary.size();
    for (const glm::uvec3& t : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner)
            append_bytes(binary, t[corner]);
    }
    add_view(begin, element_array_buffer, 0);
    accessors.push_back({{"bufferView", 3},
                         {"componentType", type_uint},
                         {"count", 3 * mesh.triangles.size()},
                         {"type", "SCALAR"}});

    Json legend = Json::object();
    for (const auto& [name, text] : coloured.legend)
        legend[name] = text;
    const Json document{
        {"asset", {{"version", "2.0"}, {"generator", "overt"}}},
        {"extensionsUsed", {"KHR_materials_unlit"}},
        {"scene", 0},
        {"scenes", {{{"name", coloured.title}, {"nodes", {0}}}}},
        {"nodes", {{{"name", coloured.title}, {"mesh", 0}}}},
        {"materials",
         {{{"name", "map"},
           {"pbrMetallicRoughness",
            {{"baseColorFactor", {1, 1, 1, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}},
           {"doubleSided", true},
           {"extensions", {{"KHR_materials_unlit", Json::object()}}}}}},
        {"meshes",
         {{{"name", coloured.title},
           {"primitives",
            {{{"attributes", {{"POSITION", 0}, {"COLOR_0", 1}, {"_SALIENCY", 2}}},
              {"indices", 3},
              {"material", 0},
              {"mode", 4}}}},
           {"extras", {{"legend", legend}}}}}},
        {"buffers", {{{"byteLength", binary.size()}}}},
        {"bufferViews", views},
        {"accessors", accessors}};
    std::string text = json_text(document);
    pad(text, ' ');
    pad(binary, '\0');
    std::string file = "glTF";
    append_bytes(file, std::uint32_t{2});
    append_bytes(file, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + binary.size()));
    append_bytes(file, static_cast<std::uint32_t>(text.size()));
    file += "JSON";
    file += text;
    append_bytes(file, static_cast<std::uint32_t>(binary.size()));
    file.append("BIN\0", 4);
    file += binary;
    write_whole_file(path, file);
}

void write_coloured_ply(const std::filesystem::path& path, const ColouredMesh& coloured) {
    const Mesh& mesh = coloured.mesh;
    OVERT_EXPECTS(coloured.values.size() == mesh.positions.size() &&
                  coloured.srgb.size() == mesh.positions.size());
    std::string file = "ply\nformat binary_little_endian 1.0\n";
    const auto comment = [&](std::string line) {
        std::replace_if(
            line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
        file += fmt::format("comment {}\n", line);
    };
    comment(coloured.title);
    for (const auto& [name, text] : coloured.legend)
        comment(fmt::format("{}: {}", name, text));
    file += fmt::format("element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
                        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                        "property float saliency\nelement face {}\n"
                        "property list uchar int vertex_indices\nend_header\n",
                        mesh.positions.size(), mesh.triangles.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::vec3 position(coloured.scale * glm::dvec3(mesh.positions[v]));
        for (int axis = 0; axis < 3; ++axis)
            append_bytes(file, position[axis]);
        for (const std::uint8_t channel : coloured.srgb[v])
            append_bytes(file, channel);
        append_bytes(file, coloured.values[v]);
    }
    for (const glm::uvec3& t : mesh.triangles) {
        append_bytes(file, std::uint8_t{3});
        for (int corner = 0; corner < 3; ++corner)
            append_bytes(file, static_cast<std::int32_t>(t[corner]));
    }
    write_whole_file(path, file);
}

} // namespace overt
