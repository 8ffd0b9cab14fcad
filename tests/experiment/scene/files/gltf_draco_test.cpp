/// glTF files whose triangles Draco packed: what was packed comes back, and lies are refused.
#include <algorithm>
#include <array>

#include <catch2/catch.hpp>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

#include "experiment/base/error.h"
#include "experiment/scene/files/gltf_reader.h"
#include "tests/experiment/scene/mesh_fixtures.h"
#include "tests/support/damaged_bytes.h"
#include "tests/support/glb_maker.h"

using namespace overt;
using test::GlbMaker;
using Json = nlohmann::json;

namespace {

/// What a corner of the packed figure has beside its place: made of the triangle, so that corners of one
/// place differ and seams must stay where they are.
glm::vec2 uv_of(std::size_t triangle, int corner) {
    return {static_cast<float>(triangle) / 64.0f, static_cast<float>(corner) / 4.0f};
}
std::array<std::uint8_t, 4> colour_of(std::size_t triangle) {
    return {static_cast<std::uint8_t>(10 * triangle), 255, 51, 255};
}

struct Packed {
    std::string bytes;
    std::size_t vertices = 0;
};

Packed packed(const Mesh& mesh, int method, int bits) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(static_cast<int>(mesh.triangles.size()));
    const int places = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int uvs = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    const int colours = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8, true);
    const int areas = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 1, draco::DT_UINT16);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const draco::FaceIndex face(static_cast<std::uint32_t>(t));
        const glm::uvec3& corners = mesh.triangles[t];
        builder.SetAttributeValuesForFace(places, face, &mesh.positions[corners.x],
                                          &mesh.positions[corners.y], &mesh.positions[corners.z]);
        const glm::vec2 a = uv_of(t, 0), b = uv_of(t, 1), c = uv_of(t, 2);
        builder.SetAttributeValuesForFace(uvs, face, &a, &b, &c);
        const auto colour = colour_of(t);
        builder.SetAttributeValuesForFace(colours, face, &colour, &colour, &colour);
        const auto area = static_cast<std::uint16_t>(t % 3);
        builder.SetAttributeValuesForFace(areas, face, &area, &area, &area);
    }
    const auto made = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetEncodingMethod(method);
    if (bits > 0)
        encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, bits);
    draco::EncoderBuffer buffer;
    REQUIRE(encoder.EncodeMeshToBuffer(*made, &buffer).ok());
    return {{buffer.data(), buffer.size()}, made->num_points()};
}

/// A file of one such primitive, painted so that places on a picture are asked for.
GlbMaker draco_file(const Packed& of, std::size_t triangles) {
    GlbMaker maker;
    const auto accessor = [&](int type, const char* kind, std::size_t count, bool is_normalised = false) {
        const int index = maker.accessor(0, type, kind, count, is_normalised);
        maker.json["accessors"].back().erase("bufferView");
        return index;
    };
    Json primitive{{"attributes",
                    {{"POSITION", accessor(5126, "VEC3", of.vertices)},
                     {"TEXCOORD_0", accessor(5126, "VEC2", of.vertices)},
                     {"COLOR_0", accessor(5121, "VEC4", of.vertices, true)},
                     {"_AOI", accessor(5123, "SCALAR", of.vertices)}}},
                   {"indices", accessor(5125, "SCALAR", 3 * triangles)},
                   {"material", maker.painted_material(test::png_of({1, 1}, {{255, 255, 255}}))}};
    primitive["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", maker.view(of.bytes)},
        {"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}, {"COLOR_0", 2}, {"_AOI", 3}}}};
    maker.json["extensionsUsed"] = maker.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    maker.show({primitive});
    return maker;
}

RawMesh read(const GlbMaker& maker) {
    const test::TemporaryFolder folder;
    return read_gltf(MeshSource(folder.file("m.glb", maker.glb())), MeshWanted::appearance);
}

std::string refused(const GlbMaker& maker) {
    try {
        (void)read(maker);
        return {};
    } catch (const InputError& error) {
        const std::string what = error.what();
        return what.substr(what.find("m.glb: ") + 7);
    }
}

Json& extension_of(GlbMaker& maker) {
    return maker.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
}

/// The first bytes of a packed mesh that claims so many vertices and triangles, and no more than that.
std::string claim(std::uint8_t method, std::uint32_t vertices, std::uint32_t triangles,
                  std::uint8_t kind = draco::TRIANGULAR_MESH) {
    std::string bytes = "DRACO";
    bytes += {2, 2, static_cast<char>(kind), static_cast<char>(method), 0, 0};
    const auto number = [&](std::uint32_t value) {
        for (; value > 127; value >>= 7)
            bytes.push_back(static_cast<char>(value | 128));
        bytes.push_back(static_cast<char>(value));
    };
    if (method == draco::MESH_EDGEBREAKER_ENCODING) {
        bytes.push_back('\0');
        number(vertices);
        number(triangles);
    } else {
        number(triangles);
        number(vertices);
    }
    return bytes;
}

} // namespace

TEST_CASE("what Draco packed is the mesh that was packed, each corner with its own", "[unit]") {
    const Mesh cube = test::cube();
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        for (const int bits : {0, 14}) {
            INFO("method " << method << ", " << bits << " bits");
            const RawMesh mesh = read(draco_file(packed(cube, method, bits), cube.triangles.size()));
            REQUIRE(mesh.triangles.size() == cube.triangles.size());
            REQUIRE(mesh.appearance.uvs[0].size() == mesh.triangles.size());
            REQUIRE(mesh.appearance.colours.size() == mesh.triangles.size());
            CHECK(mesh.are_areas_labelled);
            std::vector<bool> found(cube.triangles.size());
            for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
                // Edgebreaker has the triangles in another order, and begins them elsewhere.
                const auto number =
                    static_cast<std::size_t>(std::lround(64.0f * mesh.appearance.uvs[0][t][0].x));
                REQUIRE(number < found.size());
                found[number] = true;
                CHECK(mesh.triangle_labels[t] == static_cast<PartLabel>(number % 3));
                for (int corner = 0; corner < 3; ++corner) {
                    const auto c = static_cast<std::size_t>(corner);
                    const glm::vec2 uv = mesh.appearance.uvs[0][t][c];
                    const int own = static_cast<int>(std::lround(4.0f * uv.y));
                    CHECK(uv == uv_of(number, own));
                    CHECK(mesh.appearance.colours[t][c].x ==
                          Approx(static_cast<double>(number) * 10.0 / 255.0));
                    CHECK(mesh.appearance.colours[t][c].z == Approx(0.2));
                    const glm::dvec3 place = mesh.positions[mesh.triangles[t][corner]];
                    CHECK(glm::distance(place, glm::dvec3(cube.positions[cube.triangles[number][own]])) <
                          (bits > 0 ? 1.0 / (1 << bits) : 1e-9));
                }
                const int first = static_cast<int>(std::lround(4.0f * mesh.appearance.uvs[0][t][0].y));
                CHECK(static_cast<int>(std::lround(4.0f * mesh.appearance.uvs[0][t][1].y)) ==
                      (first + 1) % 3);
            }
            CHECK(std::ranges::count(found, true) == std::ssize(found));
        }
    }
}

TEST_CASE("what Draco packed is refused where it is not what the file says", "[unit]") {
    const Mesh cube = test::cube();
    const Packed of = packed(cube, draco::MESH_EDGEBREAKER_ENCODING, 14);
    const GlbMaker whole = draco_file(of, 12);
    const std::string at = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
    CHECK(refused(whole).empty());
    {
        GlbMaker maker = draco_file(of, 13);
        CHECK(refused(maker) == at + ": its packed bytes have 12 triangles, and its indices say 39 corners.");
    }
    {
        GlbMaker maker = draco_file({of.bytes, of.vertices + 1}, 12);
        CHECK(refused(maker).starts_with(at + "/attributes/POSITION: its packed bytes have "));
    }
    {
        GlbMaker maker = whole;
        extension_of(maker)["attributes"]["TEXCOORD_0"] = 9;
        CHECK(refused(maker) == at + "/attributes/TEXCOORD_0: its packed bytes have no attribute 9.");
        extension_of(maker)["attributes"]["TEXCOORD_0"] = 0;
        CHECK(refused(maker) ==
              at + "/attributes/TEXCOORD_0: its packed bytes have 3 numbers for each vertex, and "
                   "its accessor 2.");
    }
    {
        GlbMaker maker = whole;
        extension_of(maker)["attributes"].erase("POSITION");
        CHECK(refused(maker) == at + "/attributes: \"POSITION\" is missing.");
    }
    {
        GlbMaker maker = whole;
        maker.json["meshes"][0]["primitives"][0]["mode"] = 6;
        CHECK(refused(maker) == "/meshes/0/primitives/0/mode: Draco packs triangles and strips.");
    }
    for (const std::size_t size : {std::size_t{3}, std::size_t{12}, of.bytes.size() / 2}) {
        const GlbMaker maker = draco_file({of.bytes.substr(0, size), of.vertices}, 12);
        CHECK(refused(maker).starts_with(at + ": its packed bytes are damaged"));
    }
}

TEST_CASE("a few bytes that claim a gigabyte of Draco's triangles are refused before anything is made",
          "[unit]") {
    for (const std::uint8_t method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        const auto said = [&](std::uint32_t vertices, std::uint32_t triangles) {
            return refused(draco_file({claim(method, vertices, triangles), 8}, triangles));
        };
        CHECK(said(40'000'000, 80'000'000).find("claim 80000000 triangles of 40000000 vertices, which ") !=
              std::string::npos);
        CHECK(said(4'000'000'000, 12).find("claim 12 triangles of 4000000000 vertices") != std::string::npos);
        CHECK(said(8, 12).find("its packed bytes are damaged") != std::string::npos);
    }
    CHECK(refused(draco_file({claim(0, 8, 12, draco::POINT_CLOUD), 8}, 12))
              .ends_with("these are points, not triangles: mesh them first."));
}

TEST_CASE("damaged bytes of Draco are read or refused", "[unit]") {
    const Packed of = packed(test::cube(), draco::MESH_EDGEBREAKER_ENCODING, 14);
    int read_whole = 0, refused_whole = 0;
    test::each_damage(of.bytes, 300, [&](std::string_view bytes) {
        try {
            (void)read(draco_file({std::string(bytes), of.vertices}, 12));
            ++read_whole;
        } catch (const Error&) {
            ++refused_whole;
        }
    });
    CHECK(read_whole + refused_whole == 300);
    CHECK(refused_whole > 50);
}
