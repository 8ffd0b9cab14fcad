/// glTF files for tests, made piece by piece.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "experiment/base/base64.h"
#include "experiment/pictures/plain_png.h"
#include "experiment/scene/mesh.h"

namespace overt::test {

/// The bytes of numbers one after another, as glTF has them.
template <class T> std::string bytes_of_items(const std::vector<T>& items) {
    static_assert(std::endian::native == std::endian::little);
    std::string bytes(items.size() * sizeof(T), '\0');
    if (!items.empty())
        std::memcpy(bytes.data(), items.data(), bytes.size());
    return bytes;
}

/// A PNG of such texels, row by row from the top.
inline std::string png_of(glm::ivec2 size_px, const std::vector<glm::u8vec3>& texels) {
    PictureHeader header;
    header.size_px = size_px;
    header.channels = {"R", "G", "B"};
    header.type = PixelType::bits8;
    header.attributes = {{"oiio:ColorSpace", std::string("sRGB")}};
    const auto bytes = encode_srgb_png(header, PixelType::bits8, texels.data()).value();
    return {bytes.begin(), bytes.end()};
}

class GlbMaker {
  public:
    nlohmann::json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}};
    std::string binary;

    /// The number of a view of these bytes.
    int view(std::string_view bytes, int stride = 0) {
        binary.resize((binary.size() + 3) / 4 * 4, '\0');
        nlohmann::json made{{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
        if (stride > 0)
            made["byteStride"] = stride;
        binary += bytes;
        return add("bufferViews", std::move(made));
    }
    int accessor(int view, int component_type, std::string_view type, std::size_t count,
                 bool normalised = false) {
        nlohmann::json made{
            {"bufferView", view}, {"componentType", component_type}, {"type", type}, {"count", count}};
        if (normalised)
            made["normalized"] = true;
        return add("accessors", std::move(made));
    }
    template <int components> int floats(const std::vector<glm::vec<components, float>>& items) {
        return accessor(view(bytes_of_items(items)), 5126, "VEC" + std::to_string(components), items.size());
    }
    int indices(const std::vector<std::uint32_t>& items) {
        return accessor(view(bytes_of_items(items)), 5125, "SCALAR", items.size());
    }
    int add(const std::string& list, nlohmann::json entry) {
        json[list].push_back(std::move(entry));
        return static_cast<int>(json[list].size()) - 1;
    }
    /// A primitive of a mesh's triangles.
    nlohmann::json primitive(const Mesh& mesh) {
        std::vector<std::uint32_t> corners;
        for (const glm::uvec3& triangle : mesh.triangles)
            corners.insert(corners.end(), {triangle.x, triangle.y, triangle.z});
        return {{"attributes", {{"POSITION", floats<3>(mesh.positions)}}}, {"indices", indices(corners)}};
    }
    /// A material of one picture, sRGB.
    int painted_material(const std::string& png, std::string_view name = "paint") {
        const int image = add("images", {{"bufferView", view(png)}, {"mimeType", "image/png"}});
        const int texture = add("textures", {{"source", image}});
        return add("materials", {{"name", name},
                                 {"pbrMetallicRoughness",
                                  {{"baseColorTexture", {{"index", texture}}}, {"metallicFactor", 0.0}}}});
    }
    /// A mesh of these primitives on a node of its own, of which the scene is.
    void show(nlohmann::json primitives) {
        add("nodes", {{"mesh", add("meshes", {{"primitives", std::move(primitives)}})}});
    }

    std::string glb() const {
        nlohmann::json whole = json;
        if (!whole.contains("buffers"))
            whole["buffers"] = {{{"byteLength", binary.size()}}};
        std::string text = whole.dump(), bytes = binary;
        text.resize((text.size() + 3) / 4 * 4, ' ');
        bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
        const auto number = [](std::size_t value) {
            return bytes_of_items(std::vector<std::uint32_t>{static_cast<std::uint32_t>(value)});
        };
        return "glTF" + number(2) + number(12 + 8 + text.size() + 8 + bytes.size()) + number(text.size()) +
               "JSON" + text + number(bytes.size()) + std::string("BIN\0", 4) + bytes;
    }
    /// As JSON, with its bytes in itself or where `uri` says.
    std::string gltf(std::string uri = {}) const {
        if (uri.empty())
            uri = "data:application/octet-stream;base64," + base64_of(std::as_bytes(std::span(binary)));
        nlohmann::json whole = json;
        whole["buffers"] = {{{"byteLength", binary.size()}, {"uri", uri}}};
        return whole.dump();
    }
};

} // namespace overt::test
