/// Where a mesh lies, and what belongs to it: far from the origin, not quite at the same place, nowhere.
#include "experiment/scene/files/mesh_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "experiment/scene/areas.h"
#include "experiment/scene/mesh_topology.h"
#include "tests/experiment/scene/mesh_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

std::filesystem::path mesh_case(const char* name) {
    return std::filesystem::path(OVERT_SOURCE_DIR) / "tests/data/meshes" / name;
}

/// A text PLY or OBJ of a mesh that was moved, with all digits of its doubles.
std::string moved_text(const Mesh& mesh, glm::dvec3 by, double scale, bool as_ply) {
    std::string text;
    if (as_ply)
        text = fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
                           "property double z\nelement face {}\nproperty list uchar int vertex_indices\n"
                           "end_header\n",
                           mesh.positions.size(), mesh.triangles.size());
    for (const glm::vec3& p : mesh.positions) {
        const glm::dvec3 place = by + scale * glm::dvec3(p);
        text += fmt::format("{}{} {} {}\n", as_ply ? "" : "v ", place.x, place.y, place.z);
    }
    for (const glm::uvec3& t : mesh.triangles)
        text += as_ply ? fmt::format("3 {} {} {}\n", t.x, t.y, t.z)
                       : fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
    return text;
}

const std::string triangle_header =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

} // namespace

TEST_CASE("a mesh far from its origin keeps its shape, in every format that has the digits", "[unit]") {
    const TemporaryFolder folder;
    const Mesh ball = bumpy_ball(20, 30);
    const double area = ball.area();
    for (const glm::dvec3 by : {glm::dvec3(565412.0, 5934211.0, 35.0), glm::dvec3(-1e7, 3e5, 0.0),
                                glm::dvec3(4.2e6, 1.7e5, 4.78e6)}) {
        for (const double scale : {1.0, 0.02}) {
            for (const bool as_ply : {true, false}) {
                const auto file = folder.file("far.ply", moved_text(ball, by, scale, as_ply));
                for (const char* up : {"z", "y", "-x"}) {
                    CAPTURE(by.x, scale, as_ply, up);
                    MeshImport import;
                    import.scale = 1000.0;
                    import.up = up_axis_named(up);
                    import.weld_tolerance = 1e-6;
                    MeshCleaningReport report;
                    const Mesh mesh = import_mesh(file, import, report);
                    CHECK(mesh.triangles.size() == ball.triangles.size());
                    CHECK(report.vertices_welded == 0);
                    CHECK(mesh.area() == Approx(area * 1e6 * scale * scale).epsilon(1e-5));
                    // The report says where the object's origin lies in the file.
                    const glm::dvec3 there = report.origin + glm::dvec3(mesh.positions.front());
                    const glm::dvec3 in_file = glm::transpose(z_up_from_file(import.up)) * there / 1000.0;
                    const glm::dvec3 written = by + scale * glm::dvec3(ball.positions.front());
                    CHECK(glm::distance(in_file, written) < 1e-6 * scale * 3.0 + 1e-9 * glm::length(by));
                    CHECK(glm::length(mesh.bounds().centre()) < 2.0 * mesh.bounds().diagonal());
                    REQUIRE(report.rounding > 0.0);
                    CHECK_THAT(describe(report).front(), Catch::Contains("far from the origin"));
                }
            }
        }
    }
}

TEST_CASE("a mesh whose coordinates fit 32-bit floats keeps them, wherever it lies", "[unit]") {
    const TemporaryFolder folder;
    Mesh ball = bumpy_ball();
    for (const glm::vec3 by :
         {glm::vec3(0.0f), glm::vec3(10.0f, 0.0f, -20.0f), glm::vec3(4096.0f, 0.0f, 0.0f)}) {
        Mesh moved = ball;
        for (glm::vec3& position : moved.positions)
            position += by;
        MeshCleaningReport report;
        const Mesh mesh =
            import_mesh(folder.file("m.ply", as_ply(moved, PlyForm::little_endian)), {}, report);
        CHECK(mesh.positions == moved.positions);
        CHECK(report.origin == glm::dvec3(0.0));
        CHECK(report.rounding == 0.0);
    }
}

TEST_CASE("a scan in the coordinates of a country's grid keeps all of its faces", "[unit]") {
    MeshImport import;
    import.scale = 1000.0;
    MeshCleaningReport report;
    const Mesh mesh = import_mesh(mesh_case("S_utm.ply"), import, report);
    CHECK(mesh.triangles.size() == 3968);
    CHECK(report.boundary_edges == 0);
    CHECK(report.components == 1);
}

TEST_CASE("regions and vertices of no face are taken in the file's coordinates, however far", "[unit]") {
    const TemporaryFolder folder;
    const Mesh ball = bumpy_ball(20, 30);
    const glm::dvec3 by(565412.0, 5934211.0, 35.0);
    std::string text = moved_text(ball, by, 1.0, false);
    // At the origin of the file, and without a place: neither makes the mesh's box larger.
    text = "v 0 0 0\nv nan 0 0\n" + text;
    for (std::size_t at = 0; (at = text.find("\nf ", at)) != text.npos; ++at) {
        unsigned a = 0, b = 0, c = 0;
        REQUIRE(std::sscanf(text.c_str() + at, "\nf %u %u %u", &a, &b, &c) == 3);
        const std::size_t end = text.find('\n', at + 1);
        text.replace(at, end - at, fmt::format("\nf {} {} {}", a + 2, b + 2, c + 2));
    }
    MeshImport import;
    import.weld_tolerance = 1e-6;
    import.regions = {{ "head", {{ by.x, by.y, by.z + 1.2, 0.5 }}, {} }};
    MeshCleaningReport report;
    const Mesh mesh = import_mesh(folder.file("far.obj", text), import, report);
    Mesh near = ball;
    label_parts(near, std::vector<PartRegion>{{"head", {{0, 0, 1.2, 0.5}}, {}}});
    CHECK(mesh.triangle_parts == near.triangle_parts);
    CHECK(mesh.triangles == near.triangles);
    CHECK(report.vertices_welded == 0);
    CHECK(report.unreferenced_vertices_dropped == 1);
    CHECK(report.vertices_without_place == 1);
}

TEST_CASE("a vertex without a place is left aside if no face uses it, and refused at its place if one does",
          "[unit]") {
    const TemporaryFolder folder;
    MeshCleaningReport report;
    const Mesh mesh = import_mesh(mesh_case("S_nan_unused_vertex.ply"), {}, report);
    CHECK(mesh.triangles.size() == 3968);
    CHECK(report.vertices_without_place == 1);
    CHECK_THAT(describe(report).front(), Catch::Contains("1 vertex") && Catch::Contains("no face uses"));
    for (const char* number :
         {"nan", "-nan", "NaN", "inf", "-inf", "1e39", "1e999", "-1.#IND", "1.#QNAN", "1.#INF00"}) {
        CAPTURE(number);
        const auto text = [&](const char* face) {
            return triangle_header + "0 0 0\n1 0 0\n0 1 0\n0 " + number + " 0\n" + face + "\n";
        };
        CHECK(import_mesh(folder.file("n.ply", text("3 0 1 2")), {}, report).triangles.size() == 1);
        CHECK(report.vertices_without_place == 1);
        CHECK_THAT(message_of<InputError>([&] { read_mesh_file(folder.file("n.ply", text("3 0 1 3"))); }),
                   Catch::Contains("n.ply:13:3: y of vertex 3 (counted from 0)"));
        const auto obj = [&](const char* face) {
            return fmt::format("v 0 0 0\nv 0 {} 0\nv 1 0 0\nv 0 1 0\n{}\n", number, face);
        };
        CHECK(import_mesh(folder.file("n.obj", obj("f 1 3 4")), {}, report).triangles.size() == 1);
        CHECK_THAT(message_of<InputError>([&] { read_mesh_file(folder.file("n.obj", obj("f 1 2 4"))); }),
                   Catch::Contains("n.obj:2:5: y of vertex 2 is"));
    }
}

TEST_CASE("corners that differ by rounding are one within the tolerance, which is a share of the box",
          "[unit]") {
    const TemporaryFolder folder;
    for (const double size : {1.0, 1e-3, 1e4}) {
        // What sin(pi) and its like leave instead of 0, and a last digit that differs.
        std::string text = "solid noise\n";
        const Mesh box = cube();
        int number = 0;
        for (const glm::uvec3& t : box.triangles) {
            text += "facet normal 0 0 0\nouter loop\n";
            for (int corner = 0; corner < 3; ++corner) {
                const glm::dvec3 p = size * glm::dvec3(box.positions[t[corner]]);
                const double noise = ++number % 2 == 0 ? -2.7e-16 : 1.2e-7;
                text += fmt::format("vertex {} {} {}\n", p.x + noise * size, p.y - noise * size,
                                    p.z + noise * size);
            }
            text += "endloop\nendfacet\n";
        }
        const auto file = folder.file("noise.stl", text + "endsolid noise\n");
        MeshImport import;
        import.weld_tolerance = 1e-6;
        MeshCleaningReport report;
        const Mesh mesh = import_mesh(file, import, report);
        CHECK(mesh.positions.size() == 8);
        CHECK(report.boundary_edges == 0);
        CHECK(report.collapsed_faces_dropped == 0);
        REQUIRE(report.vertices_moved > 0);
        CHECK(report.weld_tolerance == Approx(1e-6 * std::sqrt(3.0) * size).epsilon(1e-4));
        CHECK_THAT(describe(report).front(),
                   Catch::Contains("welded to another within") && Catch::Contains("weld_tolerance"));
        import.weld_tolerance = 0.0;
        CHECK(import_mesh(file, import, report).positions.size() > 8);
        CHECK(report.boundary_edges > 0);
    }
}

TEST_CASE("welding that takes a face its area says so, and says how to keep it", "[unit]") {
    const TemporaryFolder folder;
    Mesh mesh = bumpy_ball();
    const auto file = folder.file("ball.ply", as_ply(mesh, PlyForm::little_endian));
    MeshImport import;
    import.weld_tolerance = 0.2;
    MeshCleaningReport report;
    import_mesh(file, import, report);
    REQUIRE(report.collapsed_faces_dropped > 0);
    CHECK(report.collapsed_faces_dropped == report.degenerate_faces_dropped);
    std::string all;
    for (const std::string& sentence : describe(report))
        all += sentence + "\n";
    CHECK_THAT(all, Catch::Contains(fmt::format("{} faces were dropped: welding left them no area",
                                                report.collapsed_faces_dropped)) &&
                        !Catch::Contains("dropped: no area"));
}

TEST_CASE("a PLY file may have its triangles as strips", "[unit]") {
    const TemporaryFolder folder;
    MeshCleaningReport report;
    const Mesh strips = import_mesh(mesh_case("S_tristrips.ply"), {}, report);
    CHECK(report.boundary_edges == 0);
    CHECK(report.conflicting_edges == 0);
    CHECK_FALSE(report.flipped);
    const Mesh faces = import_mesh(mesh_case("S_nan_unused_vertex.ply"), {}, report);
    CHECK(strips.triangles.size() == faces.triangles.size());
    CHECK(strips.area() == Approx(faces.area()).epsilon(1e-6));

    const auto read = [&](std::string_view type, std::string_view strip) {
        return read_mesh_file(folder.file(
            "s.ply",
            fmt::format("ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
                        "property float z\nelement tristrips 1\nproperty list int {} vertex_indices\n"
                        "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n{}\n",
                        type, strip)));
    };
    using Triangles = std::vector<glm::uvec3>;
    CHECK(read("int", "6 0 1 2 3 4 5").triangles == Triangles{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}});
    // The first of a new strip is not turned, wherever it begins.
    CHECK(read("int", "7 0 1 2 3 -1 2 3").triangles == Triangles{{0, 1, 2}, {2, 1, 3}});
    CHECK(read("int", "8 0 1 2 3 -1 3 4 5").triangles == Triangles{{0, 1, 2}, {2, 1, 3}, {3, 4, 5}});
    CHECK(read("uint", "7 0 1 2 4294967295 3 5 4").triangles == Triangles{{0, 1, 2}, {3, 5, 4}});
    // Strips that are joined by a corner twice keep the turns.
    CHECK(read("int", "8 0 1 2 2 3 3 5 4").triangles == Triangles{{0, 1, 2}, {5, 3, 4}});
    const auto complaint = [&](std::string_view strip) {
        return message_of<InputError>([&] { read("int", strip); });
    };
    CHECK_THAT(complaint("3 0 1 6"), Catch::Contains("s.ply:16:7: strip 0 (counted from 0) uses vertex 6"));
    CHECK_THAT(complaint("4 0 1 -1 2"), Catch::Contains("have no triangles"));
    CHECK_THAT(complaint("3 0 1 -2"), Catch::Contains("uses vertex -2"));
}

TEST_CASE("the mark of UTF-8 is no part of a mesh, and UTF-16 is named", "[unit]") {
    const TemporaryFolder folder;
    const std::string mark = "\xEF\xBB\xBF";
    for (const std::string& text : {as_ply(cube(), PlyForm::text), as_ply(cube(), PlyForm::big_endian),
                                    as_obj(cube()), as_text_stl(cube())}) {
        for (const char* name : {"m.ply", "m.obj", "m.dat"})
            CHECK(corners_of(read_mesh_file(folder.file(name, mark + text))) == corners_of(cube()));
    }
    CHECK_THAT(message_of<InputError>([&] { read_mesh_file(folder.file("e.ply", mark)); }),
               Catch::Contains("empty"));
    std::string wide = "\xFF\xFE";
    for (const char c : as_obj(cube()))
        wide += {c, '\0'};
    CHECK_THAT(message_of<InputError>([&] { read_mesh_file(folder.file("wide.obj", wide)); }),
               Catch::Contains("wide.obj") && Catch::Contains("UTF-16"));
    // A byte is counted from the file's first.
    const std::string cut = (mark + as_ply(cube(), PlyForm::little_endian)).substr(0, 300);
    CHECK_THAT(message_of<InputError>([&] { read_mesh_file(folder.file("cut.ply", cut)); }),
               Catch::Contains("byte 300"));
    // Labels, too.
    MeshImport import;
    import.labels =
        folder.file("labels.txt", mark + "# part 1 left\n# part 2 right\n1 1 1 1 1 1 2 2 2 2 2 2\n");
    MeshCleaningReport report;
    CHECK(import_mesh(folder.file("m.obj", as_obj(cube())), import, report).part_names ==
          std::vector<std::string>{"left", "right"});
}

TEST_CASE("a row of a text PLY file may go on over lines, but begins and ends with one", "[unit]") {
    const TemporaryFolder folder;
    const auto read = [&](std::string_view body) {
        return read_mesh_file(folder.file("l.ply", triangle_header + std::string(body)));
    };
    const std::vector<glm::dvec3> places{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    for (const char* body :
         {"0 0 0\n1\n0\n\n0\n0 1\n0\n1 1 0\n3 0 1 2\n", "0 0\n0\n1 0 0\n0 1 0\n1 1 0\n3 0\n1\n2\n",
          "0 0 0\r\n1 0\r\n0\r\n0 1 0\r\n1 1 0\r\n3\r\n0 1 2"}) {
        const RawMesh mesh = read(body);
        CHECK(mesh.positions == places);
        CHECK(mesh.triangles == std::vector<glm::uvec3>{{0, 1, 2}});
    }
    // A value that is missing is not made up from the next row.
    CHECK_THAT(message_of<InputError>([&] { read("0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n"); }),
               Catch::Contains("l.ply:10:4: the line of vertex 0 (counted from 0) lacks a value"));
    CHECK_THAT(message_of<InputError>([&] { read("0 0 0 1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n"); }),
               Catch::Contains("l.ply:10:7: the line of vertex 0 (counted from 0) goes on with '1'"));
}

TEST_CASE("a head stands beside labels: a triangle belongs to both", "[unit]") {
    const TemporaryFolder folder;
    const Mesh ball = bumpy_ball(20, 30);
    const auto mesh_file = folder.file("ball.ply", as_ply(ball, PlyForm::little_endian));
    // By height of the centroid: eyes high up, a middle that the head cuts, and a base without any of it.
    std::string labels = "# part 0 base\n# part 1 middle\n# part 2 eyes\n";
    std::vector<int> label_of;
    std::vector<double> heights;
    for (const glm::uvec3& t : ball.triangles) {
        const double z =
            (double{ball.positions[t.x].z} + double{ball.positions[t.y].z} + double{ball.positions[t.z].z}) /
            3.0;
        heights.push_back(z);
        label_of.push_back(z > 0.9 ? 2 : z > 0.0 ? 1 : 0);
        labels += fmt::format("{}\n", label_of.back());
    }
    MeshImport import;
    import.labels = folder.file("labels.txt", labels);
    import.regions = {{ "head", {}, { { {0, 0, 0.5}, { 0, 0, 1 } } } }};
    MeshCleaningReport report;
    const Mesh mesh = import_mesh(mesh_file, import, report);
    CHECK(mesh.part_names == std::vector<std::string>{"base", "middle", "middle/head", "head/eyes"});
    const Areas areas(mesh.part_names);
    for (std::size_t i = 0; i < heights.size(); ++i) {
        REQUIRE(areas.holds(*areas.find("head"), mesh.triangle_parts[i]) == (heights[i] >= 0.5));
        REQUIRE(areas.holds(*areas.find("middle"), mesh.triangle_parts[i]) == (label_of[i] == 1));
        const std::string expected = label_of[i] == 2    ? "head/eyes"
                                     : heights[i] >= 0.5 ? "middle/head"
                                     : label_of[i] == 1  ? "middle"
                                                         : "base";
        REQUIRE(mesh.part_names[mesh.triangle_parts[i]] == expected);
    }
    const std::vector<AreaOverlap> overlaps = overlapping_areas(mesh);
    REQUIRE(overlaps.size() == 1); // the eyes lie in the head, and do not overlap it
    CHECK(overlaps[0].a == "middle");
    CHECK(overlaps[0].b == "head");
    CHECK(overlaps[0].shared_area == Approx(mesh.part_areas()[2]));
    CHECK(overlaps[0].share_of_b ==
          Approx(mesh.part_areas()[2] / (mesh.part_areas()[2] + mesh.part_areas()[3])));
    CHECK_FALSE(Areas(std::vector<std::string>{"body", "headless", "forehead"}).has("head"));

    // The labels of the mesh file itself are no different, and a part that is called head is head.
    std::string obj;
    for (const glm::vec3& p : ball.positions)
        obj += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    for (const int group : {0, 1, 2}) {
        obj += group == 0 ? "g base\n" : group == 1 ? "g middle\n" : "g head\n";
        for (std::size_t i = 0; i < label_of.size(); ++i) {
            if (label_of[i] == group)
                obj += fmt::format("f {} {} {}\n", ball.triangles[i].x + 1, ball.triangles[i].y + 1,
                                   ball.triangles[i].z + 1);
        }
    }
    import.labels.clear();
    const Mesh grouped = import_mesh(folder.file("g.obj", obj), import, report);
    CHECK(std::set<std::string>(grouped.part_names.begin(), grouped.part_names.end()) ==
          std::set<std::string>{"base", "middle", "middle/head", "head"});
    const std::vector<std::string> remarks = describe(report);
    CHECK(std::ranges::any_of(remarks, [](const std::string& remark) {
        return remark.find("'head' is labelled") != std::string::npos;
    }));
}
