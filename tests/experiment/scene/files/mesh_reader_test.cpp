#include "experiment/scene/files/mesh_reader.h"

#include <algorithm>
#include <random>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/scene/mesh_topology.h"
#include "tests/experiment/scene/mesh_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr std::array all_ply_forms{PlyForm::text, PlyForm::little_endian, PlyForm::big_endian};

// A PLY file of random convex polygons, with coordinates, indices and much else in random types and orders.
struct RandomPly {
    std::mt19937 random;
    std::vector<glm::dvec3> positions;
    std::vector<std::vector<std::uint32_t>> polygons;

    explicit RandomPly(unsigned seed) : random(seed) {
        // Any corners of a parabola make a convex polygon.
        const double height = coordinate(), step = 1.0 / (1 << below(8));
        for (unsigned i = 0, count = 9 + below(90); i < count; ++i)
            positions.emplace_back(step * i, step * i * i, height);
        for (unsigned i = 0, count = 1 + below(60); i < count; ++i) {
            std::set<std::uint32_t> corners;
            for (unsigned wanted = 3 + below(6); corners.size() < wanted;)
                corners.insert(below(static_cast<unsigned>(positions.size())));
            polygons.emplace_back(corners.begin(), corners.end());
            std::ranges::rotate(polygons.back(), polygons.back().begin() + below(3));
        }
    }

    unsigned below(unsigned bound) { return static_cast<unsigned>(random() % bound); }
    double coordinate() { return below(2000001) / 1024.0 - 1000.0; }

    // One property in the header, and how its value is written.
    struct Column {
        std::string header;
        int axis; // 0, 1, 2; or 3: something else; 4: a list of something else
        bool wide;
    };

    std::string file(PlyForm form) {
        std::vector<Column> columns;
        for (int axis = 0; axis < 3; ++axis) {
            const bool wide = below(2) == 0;
            columns.push_back(
                {fmt::format("property {} {}", wide ? "double" : "float32", "xyz"[axis]), axis, wide});
        }
        if (below(2) == 0)
            columns.push_back({"property uchar red", 3, false});
        if (below(2) == 0)
            columns.push_back({"property list ushort double weights", 4, false});
        std::shuffle(columns.begin(), columns.end(), random);
        const unsigned index_type = below(4);
        const bool faces_first = below(2) == 0, extra_element = below(2) == 0, list_last = below(2) == 0;
        const std::string line_end = form == PlyForm::text ? "\n" : "";

        std::string vertex_header = fmt::format("element vertex {}\n", positions.size()), vertices;
        for (const Column& column : columns)
            vertex_header += column.header + "\n";
        for (const glm::dvec3& position : positions) {
            for (const Column& column : columns) {
                if (column.axis == 4) {
                    vertices +=
                        ply_value(form, std::uint16_t{2}) + ply_value(form, 0.5) + ply_value(form, 1e300);
                } else if (column.axis == 3) {
                    vertices += ply_value(form, std::uint8_t{200});
                } else if (column.wide) {
                    vertices += ply_value(form, position[column.axis]);
                } else {
                    vertices += ply_value(form, static_cast<float>(position[column.axis]));
                }
            }
            vertices += line_end;
        }
        constexpr std::array index_names{"uchar", "int16", "uint", "double"};
        const std::string list =
            fmt::format("property list {} {} {}\n", below(2) == 0 ? "uchar" : "uint8",
                        index_names[index_type], below(2) == 0 ? "vertex_indices" : "vertex_index");
        std::string face_header = fmt::format("element face {}\n", polygons.size()), faces;
        face_header += list_last ? "property float quality\n" + list : list + "property float quality\n";
        for (const auto& polygon : polygons) {
            std::string corners = ply_value(form, static_cast<std::uint8_t>(polygon.size()));
            for (const std::uint32_t corner : polygon) {
                corners += index_type == 0   ? ply_value(form, static_cast<std::uint8_t>(corner))
                           : index_type == 1 ? ply_value(form, static_cast<std::int16_t>(corner))
                           : index_type == 2 ? ply_value(form, corner)
                                             : ply_value(form, static_cast<double>(corner));
            }
            const std::string quality = ply_value(form, 0.25f);
            faces += (list_last ? quality + corners : corners + quality) + line_end;
        }
        std::string text =
            "ply\n" + ply_format_line(form) + "comment nothing of importance\nobj_info neither\n";
        std::string body;
        if (faces_first) {
            text += face_header;
            body += faces;
        }
        if (extra_element) {
            text += "element camera 2\nproperty short angle\nproperty list char float pose\n";
            for (int i = 0; i < 2; ++i) {
                body += ply_value(form, std::int16_t{-3}) + ply_value(form, std::int8_t{1}) +
                        ply_value(form, 2.5f) + line_end;
            }
        }
        text += vertex_header;
        body += vertices;
        if (!faces_first) {
            text += face_header;
            body += faces;
        }
        return text + "end_header\n" + body;
    }

    std::vector<glm::uvec3> fans() const {
        std::vector<glm::uvec3> triangles;
        for (const auto& polygon : polygons) {
            for (std::size_t i = 2; i < polygon.size(); ++i) {
                triangles.emplace_back(polygon[0], polygon[i - 1], polygon[i]);
            }
        }
        return triangles;
    }
};

} // namespace

TEST_CASE("a PLY file gives the same mesh in text and in both byte orders", "[unit]") {
    const TemporaryFolder folder;
    const Mesh ball = bumpy_ball();
    for (const PlyForm form : all_ply_forms) {
        const RawMesh raw = read_mesh_file(folder.file("ball.ply", as_ply(ball, form)));
        CHECK(in_floats(raw.positions) == ball.positions);
        CHECK(raw.triangles == ball.triangles);
        CHECK(raw.triangle_labels.empty());
    }
}

TEST_CASE("a PLY file may have any types, any order of properties and elements, polygons and extras",
          "[unit]") {
    const TemporaryFolder folder;
    for (unsigned seed = 0; seed < 60; ++seed) {
        RandomPly ply(seed);
        const PlyForm form = all_ply_forms[seed % 3];
        INFO("seed " << seed);
        const RawMesh raw = read_mesh_file(folder.file("random.ply", ply.file(form)));
        CHECK(in_floats(raw.positions) == in_floats(ply.positions));
        CHECK(raw.triangles == ply.fans());
    }
}

TEST_CASE("a text PLY file may have CR LF line ends, blank lines and plus signs", "[unit]") {
    const TemporaryFolder folder;
    const RawMesh raw = read_mesh_file(folder.file(
        "crlf.ply", "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float x\r\nproperty float "
                    "y\r\nproperty float z\r\nelement face 1\r\nproperty list uchar int "
                    "vertex_index\r\nend_header\r\n\r\n0 0 0\r\n+1.5e0 0 0\r\n0 1e-60 0\r\n\r\n3 0 1 2\r\n"));
    CHECK(raw.positions == std::vector<glm::dvec3>{{0, 0, 0}, {1.5, 0, 0}, {0, 1e-60, 0}});
    CHECK(raw.triangles == std::vector<glm::uvec3>{{0, 1, 2}});
}

TEST_CASE("an OBJ file gives the mesh that was written", "[unit]") {
    const TemporaryFolder folder;
    const Mesh ball = bumpy_ball();
    const RawMesh raw = read_mesh_file(folder.file("ball.obj", as_obj(ball)));
    CHECK(in_floats(raw.positions) == ball.positions);
    CHECK(raw.triangles == ball.triangles);
    CHECK(raw.triangle_labels.empty());
}

TEST_CASE("an OBJ file may use all forms of corners, polygons, joined lines and later vertices", "[unit]") {
    const TemporaryFolder folder;
    const RawMesh raw = read_mesh_file(folder.file(
        "forms.obj",
        "\xEF\xBB\xBF# forms\r\nmtllib none.mtl\r\nv 0 0 0 1.0\r\nv 1 0 \\\r\n 0\r\nv 1 1 0\nvt 0 0\n"
        "vn 0 0 1\nf 1/1 2/1 3/1\nf -3//1 -2//1 \\\n-1//1\nf 1/1/1 2/1/1 3/1/1 4/1/1 # a square\n"
        "usemtl gold\ns off\nv 0 1 0\nf -4 -3 -2 -1"));
    CHECK(raw.positions == std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    CHECK(raw.triangles ==
          std::vector<glm::uvec3>{{0, 1, 2}, {0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("STL files, binary and text, give the triangles that were written with corners welded", "[unit]") {
    const TemporaryFolder folder;
    const Mesh ball = bumpy_ball();
    for (const std::string& content : {as_binary_stl(ball), as_binary_stl(ball, "solid, but binary"),
                                       as_text_stl(ball), as_text_stl(ball) + as_text_stl(cube())}) {
        const RawMesh raw = read_mesh_file(folder.file("ball.stl", content));
        std::vector<glm::vec3> corners = corners_of(ball);
        const bool two_solids = raw.triangles.size() > ball.triangles.size();
        if (two_solids) {
            const std::vector<glm::vec3> more = corners_of(cube());
            corners.insert(corners.end(), more.begin(), more.end());
        }
        CHECK(corners_of(raw) == corners);
        CHECK(raw.positions.size() == ball.positions.size() + (two_solids ? 8 : 0));
    }
}

TEST_CASE("the content decides the format, whatever the file is called", "[unit]") {
    const TemporaryFolder folder;
    for (const char* name : {"cube.ply", "cube.obj", "cube.stl", "cube.dat", "CUBE"}) {
        for (const std::string& content : {as_ply(cube(), PlyForm::text), as_ply(cube(), PlyForm::big_endian),
                                           as_binary_stl(cube(), "solid"), as_text_stl(cube())}) {
            CHECK(corners_of(read_mesh_file(folder.file(name, content))) == corners_of(cube()));
        }
    }
    CHECK(corners_of(read_mesh_file(folder.file("cube.txt", as_obj(cube())))) == corners_of(cube()));
}

TEST_CASE("an STL cube of separate triangles becomes a closed cube of eight vertices", "[unit]") {
    const TemporaryFolder folder;
    MeshCleaningReport report;
    const Mesh mesh = import_mesh(folder.file("cube.stl", as_binary_stl(cube())), {}, report);
    CHECK(mesh.positions.size() == 8);
    CHECK(mesh.triangles.size() == 12);
    CHECK(report.boundary_edges == 0);
    CHECK(signed_volume(mesh) == Approx(1.0));
    CHECK(describe(report).empty());
}

TEST_CASE("every up axis is turned to +z by a rotation that keeps the front where the words say", "[unit]") {
    const struct {
        const char* name;
        glm::dvec3 up, front;
    } cases[] = {{"z", {0, 0, 1}, {0, -1, 0}}, {"-z", {0, 0, -1}, {0, -1, 0}},
                 {"y", {0, 1, 0}, {0, 0, 1}},  {"-y", {0, -1, 0}, {0, 0, 1}},
                 {"x", {1, 0, 0}, {0, -1, 0}}, {"-x", {-1, 0, 0}, {0, -1, 0}}};
    for (const auto& [name, up, front] : cases) {
        INFO("up axis " << name);
        const glm::dmat3 turn = z_up_from_file(up_axis_named(name));
        CHECK(turn * up == glm::dvec3(0, 0, 1));
        CHECK(turn * front == glm::dvec3(0, -1, 0));
        CHECK(glm::determinant(turn) == 1.0);
        CHECK(turn * glm::transpose(turn) == glm::dmat3(1.0));
    }
    CHECK(z_up_from_file(UpAxis::y) * glm::dvec3(1, 2, 3) == glm::dvec3(1, -3, 2));
    CHECK_THROWS_AS(up_axis_named("Y"), InputError);
}

TEST_CASE("import keeps volume and handedness under every up axis, and scales lengths", "[unit]") {
    const TemporaryFolder folder;
    const auto path = folder.file("ball.ply", as_ply(bumpy_ball(), PlyForm::little_endian));
    const double volume = signed_volume(bumpy_ball());
    REQUIRE(volume > 3.0);
    for (const char* name : {"x", "y", "z", "-x", "-y", "-z"}) {
        MeshImport import;
        import.up = up_axis_named(name);
        import.scale = 2.5;
        MeshCleaningReport report;
        const Mesh mesh = import_mesh(path, import, report);
        CHECK(signed_volume(mesh) == Approx(volume * 2.5 * 2.5 * 2.5).epsilon(1e-5));
        CHECK(mesh.triangles == bumpy_ball().triangles);
        CHECK_FALSE(report.flipped);
    }
}

TEST_CASE("import labels by regions in the file's coordinates, before it turns and scales", "[unit]") {
    const TemporaryFolder folder;
    const auto path = folder.file("ball.ply", as_ply(bumpy_ball(), PlyForm::little_endian));
    MeshImport import;
    import.up = UpAxis::y;
    import.scale = 10.0;
    import.regions = {{ "head", {{ 0.0, 0.0, 1.2, 0.6 }}, {} }};
    MeshCleaningReport report;
    const Mesh mesh = import_mesh(path, import, report);
    Mesh in_file = bumpy_ball();
    label_parts(in_file, import.regions);
    CHECK(mesh.triangle_parts == in_file.triangle_parts);
    CHECK(mesh.part_names == std::vector<std::string>{"body", "head"});
}

TEST_CASE("import refuses impossible scales and surfaces without area, and names the file", "[unit]") {
    const TemporaryFolder folder;
    MeshCleaningReport report;
    const auto path = folder.file("cube.ply", as_ply(cube(), PlyForm::text));
    for (const double scale : {0.0, -1.0, 1e39, std::nan("")}) {
        MeshImport import;
        import.scale = scale;
        const std::string message = message_of<InputError>([&] { import_mesh(path, import, report); });
        CHECK_THAT(message, Catch::StartsWith(path.string()) && Catch::Contains("scale"));
    }
    const auto flat = folder.file("line.obj", "v 0 0 0\nv 1 1 1\nv 3 3 3\nf 1 2 3\nf 1 1 2\n");
    const std::string message = message_of<InputError>([&] { import_mesh(flat, {}, report); });
    CHECK_THAT(message, Catch::StartsWith(flat.string()) && Catch::Contains("no area"));
}
