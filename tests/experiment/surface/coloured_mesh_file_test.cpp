#include <catch2/catch.hpp>

#include <cstring>

#include <nlohmann/json.hpp>

#include "experiment/base/json_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/scene/files/mesh_reader.h"
#include "experiment/scene/surface_appearance.h"
#include "experiment/surface/colour_scale.h"
#include "experiment/surface/coloured_mesh_file.h"
#include "tests/experiment/surface/flat_and_round.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using Json = nlohmann::ordered_json;

namespace {

template <class T> T at(const std::string& bytes, std::size_t place) {
    T value{};
    REQUIRE(place + sizeof(T) <= bytes.size());
    std::memcpy(&value, bytes.data() + place, sizeof(T));
    return value;
}

/// A sphere with values that rise with z and colours of viridis.
struct Sample {
    Mesh mesh = test::icosphere(2.0, 2);
    std::vector<float> values;
    std::vector<std::array<std::uint8_t, 3>> colours;

    Sample() {
        for (const glm::vec3& position : mesh.positions) {
            values.push_back(position.z + 2.0f);
            colours.push_back(colour_table(ColourMap::viridis)[static_cast<std::size_t>(
                std::clamp(255.0f * values.back() / 4.0f, 0.0f, 255.0f))]);
        }
    }
    ColouredMesh coloured() const {
        return {mesh,         values, colours,
                "a \"ball\"", 1.0,    {{"quantity", "ms per mm^2"}, {"grey", "never\nvisible"}}};
    }
};

} // namespace

TEST_CASE("a GLB keeps the rules of glTF 2.0", "[unit]") {
    const test::TemporaryFolder folder;
    const Sample sample;
    write_glb(folder.path() / "map.glb", sample.coloured());
    const std::string file = read_whole_file(folder.path() / "map.glb");
    CHECK(file.substr(0, 4) == "glTF");
    CHECK(at<std::uint32_t>(file, 4) == 2);
    CHECK(at<std::uint32_t>(file, 8) == file.size());
    const std::size_t json_bytes = at<std::uint32_t>(file, 12);
    CHECK(file.substr(16, 4) == "JSON");
    CHECK(json_bytes % 4 == 0);
    const std::size_t binary = 20 + json_bytes + 8;
    CHECK(file.substr(binary - 4, 4) == std::string("BIN\0", 4));
    const std::size_t binary_bytes = at<std::uint32_t>(file, binary - 8);
    CHECK(binary_bytes % 4 == 0);
    CHECK(binary + binary_bytes == file.size());

    const Json json = parse_json(file.substr(20, json_bytes));
    REQUIRE(!json.is_discarded());
    CHECK(json["asset"]["version"] == "2.0");
    CHECK(json["extensionsUsed"] == Json::array({"KHR_materials_unlit"}));
    CHECK(json["meshes"][0]["extras"]["legend"]["quantity"] == "ms per mm^2");
    const std::size_t length = json["buffers"][0]["byteLength"];
    CHECK(length <= binary_bytes);
    CHECK(binary_bytes < length + 4);
    const Json& attributes = json["meshes"][0]["primitives"][0]["attributes"];
    std::size_t end = 0;
    for (const Json& accessor : json["accessors"]) {
        const Json& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        const std::size_t offset = view["byteOffset"], bytes = view["byteLength"];
        CHECK(offset % 4 == 0);
        CHECK(offset == end);
        end = offset + bytes;
        const std::size_t size = accessor["componentType"] == 5123 ? 2 : 4;
        const std::size_t parts = accessor["type"] == "VEC3" ? 3 : accessor["type"] == "VEC4" ? 4 : 1;
        CHECK(bytes == size * parts * accessor["count"].get<std::size_t>());
        const bool is_index = &accessor == &json["accessors"].back();
        CHECK(view["target"] == (is_index ? 34963 : 34962));
        CHECK(view.contains("byteStride") == !is_index);
    }
    CHECK(end == length);

    // +z up becomes +y up; the bounds are those of the numbers.
    const auto place_of = [&](const char* attribute) {
        const std::size_t accessor = attributes[attribute];
        return binary + json["bufferViews"][accessor]["byteOffset"].get<std::size_t>();
    };
    glm::vec3 low(1e9f), high(-1e9f);
    for (std::size_t v = 0; v < sample.mesh.positions.size(); ++v) {
        const glm::vec3 p(at<float>(file, place_of("POSITION") + 12 * v),
                          at<float>(file, place_of("POSITION") + 12 * v + 4),
                          at<float>(file, place_of("POSITION") + 12 * v + 8));
        REQUIRE(glm::vec3(p.x, -p.z, p.y) == sample.mesh.positions[v]);
        low = glm::min(low, p);
        high = glm::max(high, p);
        REQUIRE(at<float>(file, place_of("_SALIENCY") + 4 * v) == sample.values[v]);
        // Linear light: coded again as sRGB it is the colour of the table.
        for (std::size_t c = 0; c < 3; ++c) {
            const double linear = at<std::uint16_t>(file, place_of("COLOR_0") + 8 * v + 2 * c) / 65535.0;
            const double srgb =
                linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
            REQUIRE(std::lround(255.0 * srgb) == sample.colours[v][c]);
        }
        REQUIRE(at<std::uint16_t>(file, place_of("COLOR_0") + 8 * v + 6) == 65535);
    }
    const Json& positions = json["accessors"][attributes["POSITION"].get<std::size_t>()];
    for (int axis = 0; axis < 3; ++axis) {
        CHECK(positions["min"][static_cast<std::size_t>(axis)].get<float>() == low[axis]);
        CHECK(positions["max"][static_cast<std::size_t>(axis)].get<float>() == high[axis]);
    }
}

TEST_CASE("a coloured PLY is a mesh with colours and values", "[unit]") {
    const test::TemporaryFolder folder;
    const Sample sample;
    write_coloured_ply(folder.path() / "map.ply", sample.coloured());
    const RawMesh mesh = read_mesh_file(folder.path() / "map.ply");
    CHECK(std::vector<glm::vec3>(mesh.positions.begin(), mesh.positions.end()) == sample.mesh.positions);
    CHECK(mesh.triangles == sample.mesh.triangles);
    const std::string file = read_whole_file(folder.path() / "map.ply");
    CHECK(file.find("comment grey: never visible\n") != file.npos);
    const std::size_t body = file.find("end_header\n") + 11;
    CHECK(at<std::uint8_t>(file, body + 19 * 5 + 13) == sample.colours[5][1]);
    CHECK(at<float>(file, body + 19 * 5 + 15) == sample.values[5]);
}

TEST_CASE("the colour maps begin and end as published", "[unit]") {
    using Colour = std::array<std::uint8_t, 3>;
    CHECK(colour_table(ColourMap::viridis).front() == Colour{68, 1, 84});
    CHECK(colour_table(ColourMap::viridis).back() == Colour{253, 231, 37});
    CHECK(colour_table(ColourMap::cividis).back() == Colour{254, 232, 56});
    // Moreland (2009): blue (59, 76, 192) to red (180, 4, 38), and the same light grey on both sides of 0.
    CHECK(colour_table(ColourMap::coolwarm).front() == Colour{59, 76, 192});
    CHECK(colour_table(ColourMap::coolwarm).back() == Colour{180, 4, 38});
    // The lightness of viridis rises all the way: a grey print keeps the order.
    double before = -1.0;
    for (const Colour& c : colour_table(ColourMap::viridis)) {
        const double luminance = 0.2126 * double{linear_of_srgb(c[0])} +
                                 0.7152 * double{linear_of_srgb(c[1])} +
                                 0.0722 * double{linear_of_srgb(c[2])};
        REQUIRE(luminance > before - 2e-3);
        before = luminance;
    }
}
