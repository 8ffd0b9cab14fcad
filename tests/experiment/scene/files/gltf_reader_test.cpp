#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/scene/files/mesh_reader.h"
#include "experiment/scene/mesh_topology.h"
#include "tests/experiment/scene/mesh_fixtures.h"
#include "tests/support/damaged_bytes.h"
#include "tests/support/glb_maker.h"

using namespace overt;
using test::GlbMaker;

namespace {

/// Its triangles as places, each beginning with its lowest corner, in order.
std::vector<std::array<double, 9>> places_in(const std::vector<glm::dvec3>& positions,
                                             const std::vector<glm::uvec3>& triangles) {
    std::vector<std::array<double, 9>> places;
    for (const glm::uvec3& triangle : triangles) {
        std::array<std::array<double, 9>, 3> turns{};
        for (int turn = 0; turn < 3; ++turn)
            for (int corner = 0; corner < 3; ++corner)
                for (int axis = 0; axis < 3; ++axis)
                    turns[static_cast<std::size_t>(turn)][static_cast<std::size_t>(3 * corner + axis)] =
                        positions[triangle[(turn + corner) % 3]][axis] + 0.0;
        places.push_back(*std::ranges::min_element(turns));
    }
    std::ranges::sort(places);
    return places;
}

std::vector<std::array<double, 9>> places_in(const RawMesh& mesh) {
    return places_in(mesh.positions, mesh.triangles);
}

std::vector<std::array<double, 9>> places_in(const Mesh& mesh) {
    return places_in({mesh.positions.begin(), mesh.positions.end()}, mesh.triangles);
}

Mesh moved(Mesh mesh, glm::dvec3 by) {
    for (glm::vec3& position : mesh.positions)
        position = glm::vec3(glm::dvec3(position) + by);
    return mesh;
}

GlbMaker shown_cube() {
    GlbMaker maker;
    maker.show({maker.primitive(test::cube())});
    return maker;
}

double volume_of(const RawMesh& raw) {
    Mesh mesh;
    mesh.positions.assign(raw.positions.begin(), raw.positions.end());
    mesh.triangles = raw.triangles;
    return signed_volume(mesh);
}

} // namespace

TEST_CASE("a cube is the same cube in every form that glTF has for its bytes", "[unit]") {
    const test::TemporaryFolder folder;
    const auto cube = places_in(test::cube());
    const GlbMaker maker = shown_cube();
    CHECK(places_in(read_mesh_file(folder.file("cube.glb", maker.glb()))) == cube);
    CHECK(places_in(read_mesh_file(folder.file("cube.gltf", maker.gltf()))) == cube);
    // Told by its content, whatever its name says.
    CHECK(places_in(read_mesh_file(folder.file("cube.obj", maker.glb()))) == cube);
    folder.file("my bytes.bin", maker.binary);
    CHECK(places_in(read_mesh_file(folder.file("beside.gltf", maker.gltf("my%20bytes.bin")))) == cube);
    // Bytes behind the last chunk's, and chunks of other kinds, are nobody's business.
    CHECK(places_in(read_mesh_file(folder.file("longer.glb", maker.glb() + "more"))) == cube);
}

TEST_CASE("corners are told by indices of every size, by none, and by strips and fans", "[unit]") {
    const test::TemporaryFolder folder;
    const auto read = [&](GlbMaker& maker, nlohmann::json primitive) {
        maker.show({std::move(primitive)});
        return places_in(read_mesh_file(folder.file("m.glb", maker.glb())));
    };
    const std::vector<glm::vec3> square{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    Mesh as_strip, as_fan;
    as_strip.positions = as_fan.positions = square;
    as_strip.triangles = {{0, 1, 2}, {1, 3, 2}};
    as_fan.triangles = {{0, 1, 3}, {0, 3, 2}};
    const auto with = [&](GlbMaker& maker, int mode, int indices) -> nlohmann::json {
        nlohmann::json made{{"attributes", {{"POSITION", maker.floats<3>(square)}}}, {"mode", mode}};
        if (indices >= 0)
            made["indices"] = indices;
        return made;
    };
    {
        GlbMaker maker;
        CHECK(read(maker, with(maker, 5, -1)) == places_in(as_strip));
    }
    {
        GlbMaker maker;
        const int bytes = maker.accessor(
            maker.view(test::bytes_of_items(std::vector<std::uint8_t>{0, 1, 3, 2})), 5121, "SCALAR", 4);
        CHECK(read(maker, with(maker, 6, bytes)) == places_in(as_fan));
    }
    {
        GlbMaker maker;
        const int words =
            maker.accessor(maker.view(test::bytes_of_items(std::vector<std::uint16_t>{0, 1, 2, 1, 3, 2})),
                           5123, "SCALAR", 6);
        CHECK(read(maker, with(maker, 4, words)) == places_in(as_strip));
    }
}

TEST_CASE("nodes turn, scale, move and mirror what hangs on them, and a mirrored mesh keeps its outside",
          "[unit]") {
    const test::TemporaryFolder folder;
    const auto read = [&](const nlohmann::json& node, const nlohmann::json& parent) {
        GlbMaker maker = shown_cube();
        maker.json["nodes"][0].update(node);
        maker.json["nodes"].push_back(parent);
        maker.json["nodes"][1]["children"] = {0};
        maker.json["scenes"][0]["nodes"] = {1};
        return read_mesh_file(folder.file("m.glb", maker.glb()));
    };
    const double half = std::sqrt(0.5);
    // 90 degrees about z brings x to y; what is scaled first is then turned, and moved last.
    const RawMesh turned =
        read({{"scale", {2, 1, 1}}, {"rotation", {0, 0, half, half}}, {"translation", {10, 0, 0}}},
             {{"translation", {0, 0, 5}}});
    Bounds box{turned.positions.front(), turned.positions.front()};
    for (const glm::dvec3& place : turned.positions) {
        box.min = glm::min(box.min, place);
        box.max = glm::max(box.max, place);
    }
    CHECK(glm::length(box.min - glm::dvec3(9, 0, 5)) < 1e-12);
    CHECK(glm::length(box.max - glm::dvec3(10, 2, 6)) < 1e-12);
    // The same as a matrix, by columns.
    const RawMesh by_matrix =
        read({{"matrix", {0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1}}}, {{"translation", {0, 0, 5}}});
    for (std::size_t i = 0; i < by_matrix.positions.size(); ++i)
        CHECK(glm::length(by_matrix.positions[i] - turned.positions[i]) < 1e-12);

    CHECK(volume_of(turned) == Approx(2.0));
    CHECK(volume_of(read({{"scale", {-1, 1, 1}}}, {{"name", "parent"}})) == Approx(1.0));
    CHECK(volume_of(read({{"scale", {-1, 1, 1}}}, {{"scale", {1, -3, 1}}})) == Approx(3.0));
}

TEST_CASE("a mesh on two nodes is there twice, and its nodes are its groups", "[unit]") {
    const test::TemporaryFolder folder;
    GlbMaker maker = shown_cube();
    maker.json["nodes"][0]["name"] = "left";
    maker.json["nodes"].push_back({{"mesh", 0}, {"translation", {3, 0, 0}}, {"name", "right"}});
    maker.json["scenes"][0]["nodes"] = {0, 1};
    const std::filesystem::path file = folder.file("two.glb", maker.glb());
    MeshCleaningReport report;
    MeshImport by_group;
    by_group.parts_by_material = false;
    const Mesh mesh = import_mesh(file, by_group, report);
    CHECK(mesh.part_names == std::vector<std::string>{"left", "right"});
    CHECK(mesh.part_areas()[1] == Approx(6.0));
    CHECK(report.components == 2);
    CHECK(import_mesh(file, {}, report).part_names == std::vector<std::string>{"body"});
}

TEST_CASE("numbers are read as their accessors say: quantised, with gaps, and in part replaced", "[unit]") {
    const test::TemporaryFolder folder;
    const std::vector<std::uint32_t> corner_list{0, 1, 2};
    GlbMaker maker;
    const std::vector<std::int16_t> spaced{0, 0, 0, 99, 32767, 0, 0, 99, -32768, -16384, 0, 99};
    const int quantised = maker.accessor(maker.view(test::bytes_of_items(spaced), 8), 5122, "VEC3", 3, true);
    maker.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    maker.show({{{"attributes", {{"POSITION", quantised}}}, {"indices", maker.indices(corner_list)}}});
    const RawMesh read = read_mesh_file(folder.file("q.glb", maker.glb()));
    CHECK(read.positions.at(1) == glm::dvec3(1.0, 0.0, 0.0));
    CHECK(read.positions.at(2).x == -1.0); // the lowest number stands for -1, too
    CHECK(read.positions.at(2).y == Approx(-16384.0 / 32767.0));

    GlbMaker sparse;
    const int places = sparse.floats<3>(std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    sparse.json["accessors"][static_cast<std::size_t>(places)]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", sparse.view(std::string("\x02", 1))}, {"componentType", 5121}}},
        {"values", {{"bufferView", sparse.view(test::bytes_of_items(std::vector<glm::vec3>{{0, 5, 7}}))}}}};
    sparse.show({{{"attributes", {{"POSITION", places}}}}});
    CHECK(read_mesh_file(folder.file("s.glb", sparse.glb())).positions.at(2) == glm::dvec3(0, 5, 7));
}

TEST_CASE("materials of a glTF file are parts, by their names", "[unit]") {
    const test::TemporaryFolder folder;
    GlbMaker maker;
    const auto piece = [&](double at, int material) {
        nlohmann::json primitive = maker.primitive(moved(test::cube(), {at, 0, 0}));
        primitive["material"] = material;
        return primitive;
    };
    maker.json["materials"] = {{{"name", "glaze"}}, {{"name", "clay"}}, {{"name", "glaze"}}};
    maker.show({piece(0, 1), piece(3, 0), piece(6, 2)});
    MeshCleaningReport report;
    const Mesh mesh = import_mesh(folder.file("m.glb", maker.glb()), {}, report);
    REQUIRE(mesh.part_names == std::vector<std::string>{"glaze", "clay"});
    CHECK(mesh.part_areas()[0] == Approx(12.0));
}

namespace {

/// What is said of a file whose JSON was changed.
template <class Change> std::string said_of(const Change& change) {
    const test::TemporaryFolder folder;
    GlbMaker maker = shown_cube();
    change(maker);
    const std::filesystem::path file = folder.file("m.glb", maker.glb());
    return test::message_of<InputError>([&] {
        MeshCleaningReport report;
        SurfaceAppearance appearance;
        import_mesh(file, {}, report, &appearance);
    });
}

/// Its first view as the extension would have it packed: by a claim, of the bytes that are there.
void claim_packed(GlbMaker& maker, std::string_view mode, std::size_t count, std::size_t stride) {
    nlohmann::json& view = maker.json["bufferViews"][0];
    view["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                     {"byteOffset", view["byteOffset"]},
                                                     {"byteLength", view["byteLength"]},
                                                     {"mode", mode},
                                                     {"count", count},
                                                     {"byteStride", stride}};
}

} // namespace

TEST_CASE("a glTF file that lies about its bytes is refused at the place in its JSON", "[unit]") {
    struct Lie {
        std::string_view what;
        void (*tell)(GlbMaker& maker);
        std::string_view answer;
    };
    const Lie lies[] = {
        {"a count beyond the view", [](GlbMaker& m) { m.json["accessors"][0]["count"] = 9; },
         "/accessors/0: 9 elements"},
        {"a count that would wrap", [](GlbMaker& m) { m.json["accessors"][0]["count"] = 1.5e15; },
         "too many"},
        {"no elements", [](GlbMaker& m) { m.json["accessors"][0]["count"] = 0; }, "/accessors/0/count"},
        {"an offset behind the view",
         [](GlbMaker& m) { m.json["accessors"][0]["byteOffset"] = 9007199254740992.0; }, "do not lie in"},
        {"a negative offset", [](GlbMaker& m) { m.json["accessors"][0]["byteOffset"] = -12; },
         "/accessors/0/byteOffset: a whole number"},
        {"a view outside its buffer", [](GlbMaker& m) { m.json["bufferViews"][0]["byteLength"] = 1e9; },
         "/bufferViews/0: bytes"},
        {"a view that would wrap",
         [](GlbMaker& m) { m.json["bufferViews"][0]["byteOffset"] = 9007199254740992.0; },
         "outside its buffer"},
        {"a stride within an element", [](GlbMaker& m) { m.json["bufferViews"][0]["byteStride"] = 4; },
         "one every 4"},
        {"a stride of nothing", [](GlbMaker& m) { m.json["bufferViews"][0]["byteStride"] = 0; },
         "from 4 to 252"},
        {"a buffer longer than the file",
         [](GlbMaker& m) {
             m.json["buffers"] = {{{"byteLength", 1e12}}};
         },
         "cut off"},
        {"a second buffer without bytes",
         [](GlbMaker& m) {
             m.json["buffers"] = {{{"byteLength", 8}}, {{"byteLength", 8}}};
             m.json["bufferViews"][0]["buffer"] = 1;
         },
         "no \"uri\""},
        {"an accessor that is not there",
         [](GlbMaker& m) { m.json["meshes"][0]["primitives"][0]["indices"] = 17; },
         "/meshes/0/primitives/0/indices: there is no entry 17"},
        {"a type that is none", [](GlbMaker& m) { m.json["accessors"][0]["componentType"] = 5124; }, "5124"},
        {"whole numbers for places", [](GlbMaker& m) { m.json["accessors"][0]["componentType"] = 5125; },
         "no whole numbers of 32 bits"},
        {"floats for indices", [](GlbMaker& m) { m.json["accessors"][1]["componentType"] = 5126; },
         "indices are SCALAR"},
        {"an index of a vertex that is not there", [](GlbMaker& m) { m.json["accessors"][0]["count"] = 7; },
         "the vertices are 0 to 6"},
        {"the index that ends strips",
         [](GlbMaker& m) {
             const int bytes = m.accessor(m.view(std::string("\x00\x01\xff", 3)), 5121, "SCALAR", 3);
             m.json["meshes"][0]["primitives"][0]["indices"] = bytes;
         },
         "which glTF does not allow"},
        {"corners that make no triangles", [](GlbMaker& m) { m.json["accessors"][1]["count"] = 35; },
         "35 corners"},
        {"a place that is not finite",
         [](GlbMaker& m) {
             const float nan = std::numeric_limits<float>::quiet_NaN();
             std::memcpy(m.binary.data() + 8, &nan, 4);
         },
         "element 0"},
        {"zeros without end",
         [](GlbMaker& m) {
             m.json["accessors"][0].erase("bufferView");
             m.json["accessors"][0]["count"] = 2000000000;
         },
         "few bytes"},
        {"replaced elements that fall",
         [](GlbMaker& m) {
             m.json["accessors"][0]["sparse"] = {
                 {"count", 2},
                 {"indices", {{"bufferView", m.view(std::string("\x03\x02", 2))}, {"componentType", 5121}}},
                 {"values", {{"bufferView", m.view(std::string(24, '\0'))}}}};
         },
         "they rise"},
        {"more replaced than there are",
         [](GlbMaker& m) {
             m.json["accessors"][0]["sparse"] = {
                 {"count", 9}, {"indices", nlohmann::json::object()}, {"values", nlohmann::json::object()}};
         },
         "/accessors/0/sparse/count"},
        {"a node that hangs on itself", [](GlbMaker& m) { m.json["nodes"][0]["children"] = {0}; },
         "/nodes/0: this node hangs on two others, or on itself"},
        {"a node with two parents",
         [](GlbMaker& m) {
             m.json["nodes"].push_back({{"children", {0}}});
             m.json["scenes"][0]["nodes"] = {0, 1};
         },
         "hangs on two"},
        {"a node that is not there", [](GlbMaker& m) { m.json["nodes"][0]["children"] = {5}; },
         "/nodes/0/children/0"},
        {"a mesh that is not there", [](GlbMaker& m) { m.json["nodes"][0]["mesh"] = 3; }, "/nodes/0/mesh"},
        {"a matrix of projection",
         [](GlbMaker& m) { m.json["nodes"][0]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
         "the last row"},
        {"a scale beyond all floats",
         [](GlbMaker& m) {
             m.json["nodes"][0]["scale"] = {1e300, 1e300, 1e300};
         },
         "too large"},
        {"a turn by nothing",
         [](GlbMaker& m) {
             m.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
         },
         "no length"},
        {"scenes of which none is shown",
         [](GlbMaker& m) {
             m.json["scenes"].push_back(m.json["scenes"][0]);
             m.json.erase("scene");
         },
         "has 2 scenes"},
        {"a skeleton", [](GlbMaker& m) { m.json["nodes"][0]["skin"] = 0; }, "apply the armature"},
        {"morph targets",
         [](GlbMaker& m) {
             m.json["meshes"][0]["weights"] = {0, 0.5};
         },
         "morph targets"},
        {"points alone", [](GlbMaker& m) { m.json["meshes"][0]["primitives"][0]["mode"] = 0; },
         "mesh it first"},
        {"an extension that nobody knows", [](GlbMaker& m) { m.json["extensionsRequired"] = {"ACME_shape"}; },
         "'ACME_shape'"},
        {"packed bytes of no mode",
         [](GlbMaker& m) {
             m.json["bufferViews"][0]["extensions"] = {{"EXT_meshopt_compression", nlohmann::json::object()}};
         },
         "/bufferViews/0/extensions/EXT_meshopt_compression: \"mode\" is missing"},
        {"packed bytes that claim a gigabyte",
         [](GlbMaker& m) { claim_packed(m, "ATTRIBUTES", 1u << 26, 16); },
         "/bufferViews/0/extensions/EXT_meshopt_compression/count: claims 67108864 elements of 16 bytes"},
        {"packed bytes that claim what wraps",
         [](GlbMaker& m) { claim_packed(m, "ATTRIBUTES", std::size_t{1} << 52, 256); }, "cannot be"},
        {"packed bytes of a stride of nothing", [](GlbMaker& m) { claim_packed(m, "ATTRIBUTES", 8, 0); },
         "/byteStride: a whole number of fours"},
        {"packed triangles of a stride that is none",
         [](GlbMaker& m) { claim_packed(m, "TRIANGLES", 9, 12); }, "/byteStride: 2 or 4"},
        {"packed triangles that are no triangles", [](GlbMaker& m) { claim_packed(m, "TRIANGLES", 10, 4); },
         "/count: whole triangles"},
        {"packed bytes that are none", [](GlbMaker& m) { claim_packed(m, "ATTRIBUTES", 8, 12); },
         "/bufferViews/0/extensions/EXT_meshopt_compression: its packed bytes are damaged"},
        {"packed bytes outside the buffer",
         [](GlbMaker& m) {
             claim_packed(m, "ATTRIBUTES", 8, 12);
             m.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["byteOffset"] = 1e15;
         },
         "outside its buffer"},
        {"a picture that claims 60000 x 60000 px",
         [](GlbMaker& m) {
             std::string png = test::png_of({1, 1}, {{1, 2, 3}});
             // IHDR: length, name, width, height … and the check sum of name and content.
             const std::string claimed("\0\0\xea\x60\0\0\xea\x60", 8);
             png.replace(16, 8, claimed);
             std::uint32_t sum = 0xffffffffu;
             for (std::size_t i = 12; i < 29; ++i) {
                 sum ^= static_cast<unsigned char>(png[i]);
                 for (int bit = 0; bit < 8; ++bit)
                     sum = (sum >> 1) ^ (0xedb88320u & (0u - (sum & 1u)));
             }
             for (std::size_t i = 0; i < 4; ++i)
                 png[29 + i] = static_cast<char>(~sum >> (24 - 8 * i));
             m.painted_material(png);
         },
         "/images/0: "},
        {"a WebP that claims 16 million px aside",
         [](GlbMaker& m) {
             std::string webp("RIFF\x16\0\0\0WEBPVP8X\x0a\0\0\0\0\0\0\0", 24);
             m.painted_material(webp + std::string(6, '\xff'));
         },
         "/images/0: this picture claims 16777216 x 16777216 px"},
        {"a glTF of old", [](GlbMaker& m) { m.json["asset"]["version"] = "1.0"; }, "/asset/version"},
        {"a list that is a text", [](GlbMaker& m) { m.json["nodes"] = "all"; }, "/nodes: a list"},
        {"a material of old",
         [](GlbMaker& m) {
             m.json["materials"] = {
                 {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", nlohmann::json::object()}}}}};
         },
         "/materials/0: is written in the old form"},
        {"a colour of three numbers",
         [](GlbMaker& m) {
             m.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1}}}}}};
         },
         "/materials/0/pbrMetallicRoughness/baseColorFactor: four numbers"},
        {"a picture of no format", [](GlbMaker& m) { m.painted_material("no picture"); },
         "/images/0: this picture is of no format"},
        {"a picture for the card", [](GlbMaker& m) { m.painted_material("\xabKTX 20\xbb"); }, "is KTX2"},
        {"half a picture",
         [](GlbMaker& m) {
             m.painted_material(test::png_of({1, 1}, {{1, 2, 3}}).substr(0, 40));
         },
         "/images/0: "},
        {"a picture and no places on it",
         [](GlbMaker& m) {
             m.json["meshes"][0]["primitives"][0]["material"] =
                 m.painted_material(test::png_of({1, 1}, {{1, 2, 3}}));
         },
         "TEXCOORD_0"},
        {"holes",
         [](GlbMaker& m) {
             m.json["materials"] = {
                 {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.5}}}}}};
             m.json["meshes"][0]["primitives"][0]["material"] = 0;
         },
         "has holes"}};
    for (const Lie& lie : lies) {
        CAPTURE(lie.what);
        CHECK_THAT(said_of(lie.tell), Catch::Contains(std::string(lie.answer)));
    }
}

TEST_CASE("a .glb that is cut off or no JSON is refused at the byte", "[unit]") {
    const test::TemporaryFolder folder;
    const auto said = [&](const std::string& bytes, const char* name = "m.glb") {
        const std::filesystem::path file = folder.file(name, bytes);
        return test::message_of<InputError>([&] { read_mesh_file(file); });
    };
    const std::string whole = shown_cube().glb();
    CHECK_THAT(said(whole.substr(0, whole.size() - 4)), Catch::Contains("cut off"));
    CHECK_THAT(said(whole.substr(0, 10)), Catch::Contains("ends in its header"));
    std::string one = whole;
    one[4] = 1;
    CHECK_THAT(said(one), Catch::Contains("glTF 1"));
    std::string long_chunk = whole;
    long_chunk.replace(12, 4, "\xff\xff\xff\xff");
    CHECK_THAT(said(long_chunk), Catch::Contains("byte 12: this chunk"));
    CHECK_THAT(said("{\"asset\": {\"version\": \"2.0\"", "m.gltf"), Catch::Contains("no JSON"));
    CHECK_THAT(said(std::string(500'000, '[') + "1", "m.gltf"), Catch::Contains("no JSON"));
    CHECK_THAT(said("{}", "m.gltf"), Catch::Contains("\"asset\" is missing"));
    CHECK_THAT(said("PK\x03\x04", "m.usdz"), Catch::Contains("convert it to glTF"));
}

TEST_CASE("a .gltf reads nothing but what lies in its folder", "[unit]") {
    const test::TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "inner");
    const GlbMaker maker = shown_cube();
    folder.file("outside.bin", maker.binary);
    std::filesystem::create_symlink(folder.path() / "outside.bin", folder.path() / "inner" / "link.bin");
    for (const std::string uri : {"../outside.bin", "%2e%2e/outside.bin", "/etc/passwd", "file:///etc/passwd",
                                  "http://a.org/b.bin", "link.bin", "not there.bin",
                                  "inner/../../outside.bin", "", "data:text/plain,abc", "data:;base64,%%%"}) {
        CAPTURE(uri);
        std::string text = maker.gltf("?");
        text.replace(text.find("\"?\""), 3, "\"" + uri + "\"");
        const std::filesystem::path file = folder.file("inner/m.gltf", text);
        CHECK_THAT(test::message_of<InputError>([&] { read_mesh_file(file); }),
                   Catch::Contains("/buffers/0/uri"));
    }
}

TEST_CASE("a small file that places its mesh a million times over is refused", "[unit]") {
    CHECK_THAT(said_of([](GlbMaker& maker) {
                   const nlohmann::json primitive = maker.json["meshes"][0]["primitives"][0];
                   for (int i = 0; i < 2000; ++i)
                       maker.json["meshes"][0]["primitives"].push_back(primitive);
                   maker.json["scenes"][0]["nodes"] = nlohmann::json::array();
                   maker.json["nodes"] = nlohmann::json::array();
                   for (int i = 0; i < 2000; ++i) {
                       maker.json["nodes"].push_back({{"mesh", 0}});
                       maker.json["scenes"][0]["nodes"].push_back(i);
                   }
               }),
               Catch::Contains("place its meshes less often"));
}

TEST_CASE("a damaged .glb is read or refused", "[unit]") {
    GlbMaker maker;
    nlohmann::json primitive = maker.primitive(test::cube());
    primitive["attributes"]["TEXCOORD_0"] = maker.floats<2>(std::vector<glm::vec2>(8, glm::vec2(0.25f)));
    primitive["attributes"]["COLOR_0"] = maker.floats<3>(std::vector<glm::vec3>(8, glm::vec3(0.5f)));
    primitive["material"] = maker.painted_material(test::png_of({2, 1}, {{255, 0, 0}, {0, 255, 0}}));
    maker.show({primitive});
    int read = 0, refused = 0;
    test::each_damage(maker.glb(), 300, [&](std::string_view bytes) {
        const test::TemporaryFolder folder;
        const std::filesystem::path file = folder.file("m.glb", std::string(bytes));
        MeshCleaningReport report;
        SurfaceAppearance appearance;
        try {
            import_mesh(file, {}, report, &appearance);
            ++read;
        } catch (const Error&) {
            ++refused;
        }
    });
    CHECK(read > 0);
    CHECK(refused > 50);
}
