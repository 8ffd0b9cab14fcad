#include <numeric>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/scene/files/mesh_reader.h"
#include "tests/experiment/scene/mesh_fixtures.h"
#include "tests/support/glb_maker.h"

using namespace overt;
using test::GlbMaker;

namespace {

/// The cube whose lower two triangles, of z = 0, have one colour and all else another, by `row` of a vertex
/// or a face in PLY. Faces are told apart by their number.
std::string cube_with_face_colours(std::string_view lower, std::string_view upper) {
    const Mesh cube = test::cube();
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty "
        "float z\nelement face 12\nproperty list uchar int vertex_indices\nproperty uchar "
        "red\nproperty uchar green\nproperty uchar blue\nend_header\n";
    for (const glm::vec3& p : cube.positions)
        text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
    for (std::size_t i = 0; i < cube.triangles.size(); ++i)
        text += fmt::format("3 {} {} {} {}\n", cube.triangles[i].x, cube.triangles[i].y, cube.triangles[i].z,
                            i < 2 ? lower : upper);
    return text;
}

std::string refusal_by(const std::filesystem::path& mesh, const std::filesystem::path& labels) {
    MeshImport import;
    import.labels = labels;
    MeshCleaningReport report;
    try {
        import_mesh(mesh, import, report);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

struct Labelled {
    Mesh mesh;
    std::vector<std::string> remarks;
};
Labelled labelled_by(const std::filesystem::path& mesh, const std::filesystem::path& labels) {
    MeshImport import;
    import.labels = labels;
    MeshCleaningReport report;
    Labelled labelled;
    labelled.mesh = import_mesh(mesh, import, report);
    labelled.remarks = report.part_remarks;
    return labelled;
}

double area_of_part(const Mesh& mesh, const std::string& name) {
    const auto at = std::ranges::find(mesh.part_names, name);
    REQUIRE(at != mesh.part_names.end());
    return mesh.part_areas()[static_cast<std::size_t>(at - mesh.part_names.begin())];
}

bool is_remarked(const std::vector<std::string>& remarks, std::string_view words) {
    return std::ranges::any_of(remarks,
                               [&](const std::string& remark) { return remark.find(words) != remark.npos; });
}

/// Numbers with their most significant byte first.
std::string big_endian(std::int32_t number) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes += static_cast<char>(static_cast<std::uint32_t>(number) >> shift & 255);
    return bytes;
}
std::string big_endian(float number) { return big_endian(std::bit_cast<std::int32_t>(number)); }
std::string counted_text(const std::string& text) {
    return big_endian(static_cast<std::int32_t>(text.size() + 1)) + text + '\0';
}

std::string freesurfer_cube() {
    const Mesh cube = test::cube();
    std::string bytes = "\xFF\xFF\xFE"
                        "created by somebody on a day\n\n" +
                        big_endian(8) + big_endian(12);
    for (const glm::vec3& p : cube.positions)
        bytes += big_endian(p.x) + big_endian(p.y) + big_endian(p.z);
    for (const glm::uvec3& t : cube.triangles)
        for (int corner = 0; corner < 3; ++corner)
            bytes += big_endian(static_cast<std::int32_t>(t[corner]));
    return bytes;
}

/// The vertices of z = 1 belong to the region "top", of colour 1, 2, 3; the others to none.
std::string annotation_of_cube() {
    std::string bytes = big_endian(8);
    for (int vertex = 7; vertex >= 0; --vertex) // in any order
        bytes += big_endian(vertex) + big_endian(vertex >= 4 ? 1 + 2 * 256 + 3 * 65536 : 0);
    return bytes + big_endian(1) + big_endian(-2) + big_endian(2) + counted_text("table.txt") +
           big_endian(2) + big_endian(0) + counted_text("bottom") + big_endian(9) + big_endian(9) +
           big_endian(9) + big_endian(0) + big_endian(1) + counted_text("top") + big_endian(1) +
           big_endian(2) + big_endian(3) + big_endian(0);
}

} // namespace

TEST_CASE("parts are told by colours that are painted on the faces of a mesh", "[unit]") {
    const test::TemporaryFolder folder;
    const auto mesh = folder.file("cube.ply", cube_with_face_colours("255 0 0", "0 128 255"));
    const auto labels =
        folder.file("areas.txt", "# what was painted\n# colour #ff0000 the base\n# colour 1 127 254 rest\n");
    const Labelled by = labelled_by(mesh, labels);
    CHECK(by.mesh.part_names == std::vector<std::string>{"the base", "rest"});
    CHECK(area_of_part(by.mesh, "the base") == Approx(1.0));
    CHECK(area_of_part(by.mesh, "rest") == Approx(5.0));
    CHECK_FALSE(is_remarked(by.remarks, "colour"));
    // Two colours of one part, and one that nothing has.
    const Labelled one = labelled_by(
        mesh, folder.file("one.txt", "# colour #ff0000 all\n# color #0080ff all\n# colour #00ff00 leaf\n"));
    CHECK(area_of_part(one.mesh, "all") == Approx(6.0));
    CHECK(area_of_part(one.mesh, "leaf") == 0.0);
    CHECK(is_remarked(one.remarks, "Nothing of the mesh has the colour #00ff00 of leaf."));
}

TEST_CASE("a colour that no part has is refused where it is more than an edge", "[unit]") {
    const test::TemporaryFolder folder;
    const auto mesh = folder.file("cube.ply", cube_with_face_colours("255 0 0", "0 128 255"));
    const std::string refusal = refusal_by(mesh, folder.file("a.txt", "# colour 0 128 255 rest\n"));
    CHECK(refusal.find("a.txt: cube.ply: 16.7 % of the area has none of the colours") != std::string::npos);
    CHECK(refusal.find("triangle 1 has #ff0000") != std::string::npos);
    CHECK(refusal_by(mesh, folder.file("b.txt", "# colour 0 128 256 rest\n")).find("b.txt:1:16: '256'") !=
          std::string::npos);
    CHECK(refusal_by(mesh, folder.file("c.txt", "# colour #f00 rest\n")).find("#RRGGBB is expected") !=
          std::string::npos);
    CHECK(refusal_by(mesh, folder.file("d.txt", "# colour #ff0000 a\n# colour #fe0101 b\n"))
              .find("#ff0000 of a and #fe0101 of b cannot be told apart") != std::string::npos);
    CHECK(refusal_by(mesh, folder.file("e.txt", "# colour #ff0000\n")).find("the name of the part") !=
          std::string::npos);
    CHECK(refusal_by(mesh, folder.file("f.txt", "# colour #ff0000 a\n1 2 3\n")).find("numbers, too") !=
          std::string::npos);
    const auto plain = folder.file("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    CHECK(refusal_by(plain, folder.file("g.txt", "# colour #ff0000 a\n"))
              .find("plain.obj: has no colours of vertices or faces and no picture") != std::string::npos);
    // A painted copy has to be one.
    folder.file("other.ply", cube_with_face_colours("255 0 0", "255 0 0"));
    CHECK(refusal_by(plain, folder.file("h.txt", "# colours other.ply\n# colour #ff0000 a\n"))
              .find("other.ply has 12 triangles, and the mesh has 1") != std::string::npos);
    for (const std::string outside : {"../other.ply", "/other.ply"})
        CHECK(refusal_by(mesh, folder.file("j.txt", "# colours " + outside + "\n# colour #ff0000 a\n"))
                  .find("outside of its folder") != std::string::npos);
    CHECK(labelled_by(mesh, folder.file("i.txt", "# colours other.ply\n# colour #ff0000 a\n"))
              .mesh.part_names == std::vector<std::string>{"a"});
}

TEST_CASE("a picture that is painted on a surface gives each triangle the part that has most of it",
          "[unit]") {
    // A square of two triangles, whose picture is red to the left of a quarter and green to its right: one
    // triangle, with its right angle on the right, is green by far, the other half red by its corner.
    const test::TemporaryFolder folder;
    GlbMaker maker;
    Mesh square;
    square.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}};
    square.triangles = {{0, 1, 2}, {0, 2, 3}};
    const glm::u8vec3 red(200, 10, 10), green(10, 200, 10);
    nlohmann::json primitive = maker.primitive(test::with_one_part(square));
    primitive["attributes"]["TEXCOORD_0"] = maker.floats<2>({{0, 1}, {1, 1}, {1, 0}, {0, 0}});
    primitive["material"] =
        maker.painted_material(test::png_of({4, 2}, {red, red, green, green, red, red, green, green}));
    maker.show({primitive});
    const auto mesh = folder.file("square.glb", maker.glb());
    const Labelled by =
        labelled_by(mesh, folder.file("a.txt", "# colour 200 10 10 left\n# colour 10 200 10 right\n"));
    CHECK(area_of_part(by.mesh, "left") == Approx(0.5));
    CHECK(area_of_part(by.mesh, "right") == Approx(0.5));
    CHECK(is_remarked(by.remarks, "100.0 % of the area is of triangles with several colours"));
    // Where the sharp edge of the picture lies, no colour is a mixture of both.
    CHECK_FALSE(is_remarked(by.remarks, "none of the colours"));
    // Which triangle is which: the left one has the corner 3.
    for (std::size_t i = 0; i < by.mesh.triangles.size(); ++i) {
        float left = 1.0f;
        for (int corner = 0; corner < 3; ++corner)
            left = std::min(left, by.mesh.positions[by.mesh.triangles[i][corner]].x + 1.0f -
                                      by.mesh.positions[by.mesh.triangles[i][corner]].z);
        const bool has_upper_left = left == 0.0f;
        CHECK(by.mesh.part_names[by.mesh.triangle_parts[i]] == (has_upper_left ? "left" : "right"));
    }
}

TEST_CASE("an attribute _AOI of glTF says which parts there are, before nodes and materials do", "[unit]") {
    const test::TemporaryFolder folder;
    const auto with_numbers = [&](std::vector<float> numbers, const std::string& name) {
        GlbMaker maker;
        nlohmann::json primitive = maker.primitive(test::cube());
        primitive["attributes"]["_AOI"] =
            maker.accessor(maker.view(test::bytes_of_items(numbers)), 5126, "SCALAR", numbers.size());
        primitive["material"] = maker.add("materials", {{"name", "clay"}});
        maker.show({primitive});
        return folder.file(name, maker.glb());
    };
    const auto mesh = with_numbers({2, 2, 2, 2, 5, 5, 5, 5}, "cube.glb");
    MeshCleaningReport report;
    CHECK(import_mesh(mesh, {}, report).part_names == std::vector<std::string>{"part 2", "part 5"});
    // A file of names alone names them.
    const Mesh named = labelled_by(mesh, folder.file("names.txt", "# part 2 foot\n# part 5 crown\n")).mesh;
    CHECK(named.part_names == std::vector<std::string>{"foot", "crown"});
    // Of each side wall one triangle has two corners below, and one has two above.
    CHECK(area_of_part(named, "foot") == Approx(1.0 + 4 * 0.5));
    CHECK(area_of_part(named, "crown") == Approx(1.0 + 4 * 0.5));
    MeshImport by_material;
    by_material.parts_by_material = true;
    CHECK(import_mesh(mesh, by_material, report).part_names.size() == 1);
    CHECK_THROWS_WITH(import_mesh(with_numbers({0, 0, 0, 0.5, 1, 1, 1, 1}, "half.glb"), {}, report),
                      Catch::Contains("vertex 3 has the area 0.5: a whole number is expected"));
    CHECK_THROWS_WITH(import_mesh(with_numbers({0, 0, 0}, "few.glb"), {}, report),
                      Catch::Contains("has 3 elements, but POSITION has 8"));
}

TEST_CASE("surfaces, annotations and labels of FreeSurfer are read", "[unit]") {
    const test::TemporaryFolder folder;
    const auto mesh = folder.file("lh.white", freesurfer_cube());
    const RawMesh raw = read_mesh_file(mesh);
    CHECK(raw.positions.size() == 8);
    CHECK(raw.triangles == test::cube().triangles);
    CHECK(raw.positions[6] == glm::dvec3(0, 1, 1));
    const Mesh annotated = labelled_by(mesh, folder.file("lh.a.annot", annotation_of_cube())).mesh;
    CHECK(annotated.part_names == std::vector<std::string>{"none", "top"});
    CHECK(area_of_part(annotated, "top") == Approx(3.0));
    // The earlier form of a table of colours.
    std::string earlier = annotation_of_cube();
    earlier.resize(4 + 8 * 8 + 4);
    earlier += big_endian(2) + counted_text("table.txt");
    for (const auto& [name, code] : {std::pair{"bottom", 0}, std::pair{"top", 1}})
        earlier += counted_text(name) + big_endian(code) + big_endian(2 * code) + big_endian(3 * code) +
                   big_endian(0);
    const Mesh of_earlier = labelled_by(mesh, folder.file("lh.b.annot", earlier)).mesh;
    CHECK(of_earlier.part_names == std::vector<std::string>{"bottom", "top"});
    CHECK(area_of_part(of_earlier, "top") == Approx(3.0));
    const Mesh region =
        labelled_by(mesh,
                    folder.file("lh.V1.label", "#!ascii label, from subject x\n4\n4 0 0 1 0\n5 1 0 1 0\n6 "
                                               "0 1 1 0\n7 1 1 1 0.5\n"))
            .mesh;
    CHECK(region.part_names == std::vector<std::string>{"body", "lh.V1"});
    CHECK(area_of_part(region, "lh.V1") == Approx(3.0));
}

TEST_CASE("damaged files of FreeSurfer are refused where they are wrong", "[unit]") {
    const test::TemporaryFolder folder;
    const auto mesh = folder.file("lh.white", freesurfer_cube());
    const std::string annotation = annotation_of_cube(), surface = freesurfer_cube();
    CHECK(refusal_by(mesh, folder.file("b.annot", annotation.substr(0, annotation.size() - 2)))
              .find("is cut off") != std::string::npos);
    CHECK(refusal_by(mesh, folder.file("c.annot", annotation.substr(0, 40)))
              .find("8 vertices are said to follow") != std::string::npos);
    CHECK(refusal_by(mesh, folder.file("d.annot", big_endian(1) + big_endian(0) + big_endian(7)))
              .find("annotates 1 vertices, but the mesh has 8") != std::string::npos);
    CHECK(refusal_by(mesh, folder.file("e.label", "2\n1 0 0 0 0\n8 0 0 0 0\n"))
              .find("e.label:3:1: the mesh has 8") != std::string::npos);
    CHECK(refusal_by(mesh, folder.file("f.label", "2\n1 0 0 0 0\n")).find("and there are 1") !=
          std::string::npos);
    // None of all beginnings of the files is read as a whole one, or as far as beyond its end.
    for (std::size_t length = 1; length < surface.size(); ++length)
        CHECK_THROWS_AS(read_mesh_file(folder.file("cut.white", surface.substr(0, length))), InputError);
    std::string wrong = surface;
    wrong[wrong.size() - 1] = 8;
    CHECK_THROWS_WITH(read_mesh_file(folder.file("w.white", wrong)),
                      Catch::Contains("triangle 11 has the vertex 8, and there are 8"));
}
