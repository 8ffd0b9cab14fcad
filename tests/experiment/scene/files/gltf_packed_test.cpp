#include <catch2/catch.hpp>
#include <meshoptimizer.h>

#include "experiment/base/error.h"
#include "experiment/pictures/picture_file.h"
#include "experiment/scene/files/mesh_reader.h"
#include "tests/experiment/scene/mesh_fixtures.h"
#include "tests/support/glb_maker.h"

using namespace overt;
using test::GlbMaker;

namespace {

/// A view of bytes that meshoptimizer packed, with a buffer without bytes of its own to fall back on.
int packed_view(GlbMaker& maker, std::string_view packed, std::string_view mode, std::size_t count,
                std::size_t stride, std::string_view filter = "NONE") {
    const int view = maker.view(packed);
    nlohmann::json& made = maker.json["bufferViews"][static_cast<std::size_t>(view)];
    made["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                     {"byteOffset", made["byteOffset"]},
                                                     {"byteLength", packed.size()},
                                                     {"mode", mode},
                                                     {"count", count},
                                                     {"byteStride", stride},
                                                     {"filter", filter}};
    made["buffer"] = 1;
    made["byteOffset"] = 0;
    made["byteLength"] = count * stride;
    if (mode == "ATTRIBUTES")
        made["byteStride"] = stride;
    return view;
}

std::string packed_vertices(const void* items, std::size_t count, std::size_t stride) {
    std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(count, stride));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), items, count, stride));
    return {bytes.begin(), bytes.end()};
}

GlbMaker packed_cube(bool as_sequence) {
    GlbMaker maker;
    const Mesh cube = test::cube();
    const std::size_t vertices = cube.positions.size();
    std::vector<std::uint32_t> corners;
    for (const glm::uvec3& triangle : cube.triangles)
        corners.insert(corners.end(), {triangle.x, triangle.y, triangle.z});
    std::vector<unsigned char> bytes(std::max(meshopt_encodeIndexBufferBound(corners.size(), vertices),
                                              meshopt_encodeIndexSequenceBound(corners.size(), vertices)));
    bytes.resize(as_sequence
                     ? meshopt_encodeIndexSequence(bytes.data(), bytes.size(), corners.data(), corners.size())
                     : meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), corners.data(), corners.size()));
    const int places = maker.accessor(
        packed_view(maker, packed_vertices(cube.positions.data(), vertices, 12), "ATTRIBUTES", vertices, 12),
        5126, "VEC3", vertices);
    const int indices = maker.accessor(packed_view(maker, std::string(bytes.begin(), bytes.end()),
                                                   as_sequence ? "INDICES" : "TRIANGLES", corners.size(), 4),
                                       5125, "SCALAR", corners.size());
    maker.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    maker.show({{{"attributes", {{"POSITION", places}}}, {"indices", indices}}});
    maker.json["buffers"] = {
        {{"byteLength", maker.binary.size()}},
        {{"byteLength", 4096}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    return maker;
}

} // namespace

TEST_CASE("what meshoptimizer packed is the mesh that was packed", "[unit]") {
    const test::TemporaryFolder folder;
    const Mesh cube = test::cube();
    for (const bool as_sequence : {false, true}) {
        const RawMesh read = read_mesh_file(folder.file("cube.glb", packed_cube(as_sequence).glb()));
        REQUIRE(read.positions.size() == cube.positions.size());
        for (std::size_t i = 0; i < cube.positions.size(); ++i)
            CHECK(read.positions[i] == glm::dvec3(cube.positions[i]));
        REQUIRE(read.triangles.size() == cube.triangles.size());
        // The codec turns the corners of triangles round, but no triangle over.
        for (std::size_t i = 0; i < cube.triangles.size(); ++i) {
            const glm::uvec3 &is = read.triangles[i], &was = cube.triangles[i];
            CHECK((is == was || is == glm::uvec3(was.y, was.z, was.x) ||
                   is == glm::uvec3(was.z, was.x, was.y)));
        }
    }
}

TEST_CASE("numbers of a mantissa and an exponent are numbers again", "[unit]") {
    const test::TemporaryFolder folder;
    // 24 bits of the one, 8 of the other: 3 x 2^-1, -5 x 2^2, 1 x 2^0.
    const auto number = [](int mantissa, int exponent) {
        return (static_cast<std::uint32_t>(exponent) << 24) |
               (static_cast<std::uint32_t>(mantissa) & 0xffffffu);
    };
    std::vector<std::uint32_t> items{number(3, -1), number(-5, 2), number(1, 0)};
    items.resize(9, number(0, 0));
    items[3] = items[7] = number(1, 3);
    GlbMaker maker;
    const int places = maker.accessor(
        packed_view(maker, packed_vertices(items.data(), 3, 12), "ATTRIBUTES", 3, 12, "EXPONENTIAL"), 5126,
        "VEC3", 3);
    maker.show({{{"attributes", {{"POSITION", places}}}}});
    maker.json["buffers"] = {{{"byteLength", maker.binary.size()}}, {{"byteLength", 4096}}};
    const RawMesh read = read_mesh_file(folder.file("exponents.glb", maker.glb()));
    CHECK(read.positions.at(0) == glm::dvec3(1.5, -20.0, 1.0));
    CHECK(read.positions.at(1) == glm::dvec3(8.0, 0.0, 0.0));
}

TEST_CASE("a picture in WebP is read as one in PNG is, and one with alpha is refused", "[unit]") {
    const test::TemporaryFolder folder;
    const auto webp_of = [&](std::vector<std::string> channels, std::vector<std::uint8_t> codes) {
        PictureHeader header;
        header.size_px = {2, 2};
        header.channels = std::move(channels);
        header.type = PixelType::bits8;
        const std::filesystem::path file = folder.path() / "picture.webp";
        write_picture(file, header, PixelType::bits8, codes.data());
        std::ifstream stream(file, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    const auto glb_with = [&](const std::string& webp) {
        GlbMaker maker;
        const Mesh cube = test::cube();
        nlohmann::json primitive = maker.primitive(cube);
        primitive["attributes"]["TEXCOORD_0"] =
            maker.floats<2>(std::vector<glm::vec2>(cube.positions.size(), glm::vec2(0.5f)));
        primitive["material"] = maker.painted_material(webp);
        nlohmann::json& texture = maker.json["textures"][0];
        texture["extensions"]["EXT_texture_webp"]["source"] = texture["source"];
        texture.erase("source");
        maker.json["extensionsRequired"] = {"EXT_texture_webp"};
        maker.show({primitive});
        return maker.glb();
    };
    std::vector<std::uint8_t> grey(12, 128), veiled(16, 128);
    const RawMesh read = read_mesh_file(folder.file("webp.glb", glb_with(webp_of({"R", "G", "B"}, grey))),
                                        MeshWanted::appearance);
    REQUIRE(read.appearance.pictures.size() == 1);
    const glm::u8vec4 texel = read.appearance.pictures[0]->texels.at(0);
    CHECK(std::abs(int(texel.r) - 128) <= 2); // packed with losses
    CHECK(texel.a == 255);
    CHECK(read.appearance.pictures[0]->file == "images[0]");
    const auto refused = folder.file("alpha.glb", glb_with(webp_of({"R", "G", "B", "A"}, veiled)));
    CHECK_THAT(test::message_of<InputError>([&] { read_mesh_file(refused, MeshWanted::appearance); }),
               Catch::Contains("/images/0: this picture is WebP with alpha"));
}
