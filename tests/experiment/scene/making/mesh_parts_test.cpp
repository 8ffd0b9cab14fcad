#include "experiment/scene/making/mesh_parts.h"

#include <bit>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/scene/areas.h"
#include "experiment/scene/files/mesh_reader.h"
#include "experiment/scene/files/ply_writer.h"
#include "tests/experiment/scene/mesh_fixtures.h"
#include "tests/support/figures.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;

namespace {

std::string labelled_ply(std::string_view type, std::string_view element, std::string_view comments,
                         const std::vector<std::string>& vertex_labels,
                         const std::vector<std::string>& face_labels) {
    const auto property = [&](std::string_view of) {
        return element == of ? fmt::format("property {} label\n", type) : std::string();
    };
    std::string text =
        fmt::format("ply\nformat ascii 1.0\n{}element vertex 4\nproperty float x\nproperty float y\n"
                    "property float z\n{}element face 2\nproperty list uchar int vertex_indices\n{}"
                    "end_header\n",
                    comments, property("vertex"), property("face"));
    const char* positions[] = {"0 0 0", "1 0 0", "1 1 0", "0 1 1"};
    for (std::size_t i = 0; i < 4; ++i) {
        text += fmt::format("{} {}\n", positions[i], element == "vertex" ? vertex_labels[i] : "");
    }
    const char* faces[] = {"3 0 1 2", "3 0 2 3"};
    for (std::size_t i = 0; i < 2; ++i)
        text += fmt::format("{} {}\n", faces[i], element == "face" ? face_labels[i] : "");
    return text;
}

bool same_bits(const Mesh& a, const Mesh& b) {
    return a.positions.size() == b.positions.size() &&
           std::memcmp(a.positions.data(), b.positions.data(), a.positions.size() * sizeof(glm::vec3)) == 0 &&
           a.triangles == b.triangles && a.triangle_parts == b.triangle_parts && a.part_names == b.part_names;
}

} // namespace

TEST_CASE("a region is the union of its spheres on the positive side of every plane", "[unit]") {
    const PartRegion region{
        "head", {{0, 0, 0, 1}, {3, 0, 0, 1}}, {{{0, 0, 0.5}, {0, 0, 2}}, {{0, 0, 0}, {0, 1, 0}}}};
    CHECK(region.contains({0.0, 0.1, 0.6}));
    CHECK(region.contains({3.0, 0.1, 0.6}));
    CHECK_FALSE(region.contains({1.5, 0.1, 0.6}));
    CHECK_FALSE(region.contains({0.0, 0.1, 0.4}));
    CHECK_FALSE(region.contains({0.0, -0.1, 0.6}));
    CHECK(PartRegion{"top", {}, {{{0, 0, 0}, {0, 0, 1}}}}.contains({9.0, 9.0, 1.0}));
}

TEST_CASE("each triangle belongs to all areas that contain its centroid, or to the rest", "[unit]") {
    Mesh mesh = bumpy_ball(20, 30);
    const std::vector<PartRegion> regions{{"head", {{0, 0, 1.2, 0.5}}, {}},
                                          {"hand", {{0.9, 0, 0, 0.4}}, {}},
                                          {"head", {{0, 0, 0.9, 0.5}}, {{{0, 0, 0}, {1, 0, 0}}}}};
    label_parts(mesh, regions);
    const Areas areas(mesh.part_names);
    CHECK(areas.names() == std::vector<std::string>{"body", "head", "hand"});
    std::set<int> seen;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        std::set<std::string> expected;
        for (const PartRegion& region : regions) {
            if (region.contains(centroid(mesh, i)))
                expected.insert(region.name);
        }
        if (expected.empty())
            expected.insert("body");
        for (std::size_t area = 0; area < areas.size(); ++area)
            REQUIRE(areas.holds(area, mesh.triangle_parts[i]) == expected.contains(areas.names()[area]));
        seen.insert(mesh.triangle_parts[i]);
    }
    CHECK(seen == std::set<int>{0, 1, 2});
}

TEST_CASE("impossible regions and regions that miss the mesh are refused with their name", "[unit]") {
    const double nan = std::nan("");
    const std::vector<PartRegion> impossible{
        {"head", {}, {}},
        {"head", {{0, 0, 0, 0}}, {}},
        {"head", {{0, 0, 0, -1}}, {}},
        {"head", {{0, nan, 0, 1}}, {}},
        {"head", {{0, 0, 0, 1}}, {{{0, 0, 0}, {0, 0, 0}}}},
        {"head", {{0, 0, 0, 1}}, {{{0, 0, nan}, {0, 0, 1}}}},
        {"head", {{100, 0, 0, 1}}, {}},
    };
    for (const PartRegion& region : impossible) {
        Mesh mesh = cube();
        CHECK_THAT(message_of<InputError>([&] { label_parts(mesh, std::vector{region}); }),
                   Catch::Contains("'head'"));
    }
    Mesh mesh = cube();
    CHECK_THROWS_AS(label_parts(mesh, std::vector<PartRegion>{{"", {{0, 0, 0, 1}}, {}}}), InputError);
    std::vector<PartRegion> many;
    for (int i = 0; i < 256; ++i)
        many.push_back({fmt::format("part {}", i), {{0, 0, 0, 1}}, {}});
    CHECK_THAT(message_of<InputError>([&] { label_parts(mesh, many); }), Catch::Contains("257 parts"));
}

TEST_CASE("integer labels of PLY faces become parts in the labels' order", "[unit]") {
    const TemporaryFolder folder;
    MeshCleaningReport report;
    const auto read = [&](const std::string& text) {
        return import_mesh(folder.file("l.ply", text), {}, report);
    };
    Mesh mesh = read(labelled_ply("int", "face", "", {}, {"70000", "-3"}));
    CHECK(mesh.part_names == std::vector<std::string>{"part -3", "part 70000"});
    CHECK(mesh.triangle_parts == std::vector<PartIndex>{1, 0});

    mesh = read(labelled_ply("uchar", "face", "comment part 2 the  head \ncomment part of a series\n", {},
                             {"2", "5"}));
    CHECK(mesh.part_names == std::vector<std::string>{"the  head ", "part 5"});
    CHECK(mesh.triangle_parts == std::vector<PartIndex>{0, 1});

    CHECK(read(labelled_ply("uchar", "face", "", {}, {"4", "4"})).part_names ==
          std::vector<std::string>{"body"});
    CHECK(read(labelled_ply("float", "face", "", {}, {"1", "2"})).part_names ==
          std::vector<std::string>{"body"});
    CHECK_THROWS_AS(read(labelled_ply("uint", "face", "", {}, {"4294967295", "0"})), InputError);
}

TEST_CASE("integer labels of PLY vertices label the triangles by their middle corner", "[unit]") {
    const TemporaryFolder folder;
    MeshCleaningReport report;
    const auto path = folder.file("l.ply", labelled_ply("short", "vertex", "", {"7", "1", "7", "9"}, {}));
    const Mesh mesh = import_mesh(path, {}, report);
    CHECK(mesh.part_names == std::vector<std::string>{"body"}); // 7 7 1 and 7 7 9: both 7, and it has no name
    const auto other = folder.file("l.ply", labelled_ply("short", "vertex", "", {"7", "1", "2", "7"}, {}));
    const Mesh divided = import_mesh(other, {}, report);
    CHECK(divided.part_names == std::vector<std::string>{"part 2", "part 7"});
    CHECK(divided.triangle_parts == std::vector<PartIndex>{0, 1});
}

TEST_CASE("OBJ groups become parts when there is more than one", "[unit]") {
    const TemporaryFolder folder;
    MeshCleaningReport report;
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\n";
    const auto read = [&](const std::string& faces) {
        return import_mesh(folder.file("g.obj", vertices + faces), {}, report);
    };
    Mesh mesh = read("o statue\ng head  left\nf 1 2 3\ng\nf 1 3 4\ng unused\ng head left\nf 2 4 3\n");
    CHECK(mesh.part_names == std::vector<std::string>{"body", "head left"});
    CHECK(mesh.triangle_parts == std::vector<PartIndex>{1, 0, 1});
    mesh = read("g head\nf 1 2 3\nf 1 3 4\ng hand\n");
    CHECK(mesh.part_names == std::vector<std::string>{"body"});
}

TEST_CASE("more than 256 parts are refused, unless regions take their place", "[unit]") {
    const TemporaryFolder folder;
    std::string text = as_obj(cube());
    for (int i = 0; i < 257; ++i)
        text += fmt::format("g part{}\nf {} {} 8\n", i, i % 6 + 1, i % 5 + 2);
    const auto path = folder.file("many.obj", text);
    MeshCleaningReport report;
    CHECK_THAT(message_of<InputError>([&] { import_mesh(path, {}, report); }),
               Catch::StartsWith(path.string()) && Catch::Contains("258 parts"));
    MeshImport import;
    import.regions = {{ "top", {}, { { {0, 0, 0.5}, { 0, 0, 1 } } } }};
    CHECK(import_mesh(path, import, report).part_names == std::vector<std::string>{"body", "top"});
    // Labels of a file of their own are meant, and are not left aside.
    std::string labels;
    for (std::size_t i = 0; i < cube().triangles.size() + 257; ++i)
        labels += fmt::format("{}\n", i);
    import.labels = folder.file("labels.txt", labels);
    CHECK_THAT(message_of<InputError>([&] { import_mesh(path, import, report); }), Catch::Contains("parts"));
}

TEST_CASE("a mesh written as PLY is read back to the bit, with parts and their names", "[unit]") {
    const TemporaryFolder folder;
    Mesh mesh = bumpy_ball(40, 50);
    label_parts(mesh, std::vector<PartRegion>{{"the head", {{0, 0, 1.2, 0.5}}, {}},
                                              {"føtter", {{0, 0, -1, 0.3}}, {}}});
    mesh.part_names.emplace_back("of no triangle");
    mesh.part_names.emplace_back("");
    mesh.positions.front().x = -0.0f;
    write_ply(folder.path() / "m.ply", mesh);
    MeshCleaningReport report;
    CHECK(same_bits(import_mesh(folder.path() / "m.ply", {}, report), mesh));

    // Not clean: kept when it is not cleaned.
    mesh.positions.push_back(mesh.positions.front());
    mesh.triangles.emplace_back(1, 1, 1);
    mesh.triangle_parts.push_back(3);
    write_ply(folder.path() / "m.ply", mesh);
    CHECK(same_bits(mesh_with_labelled_parts(read_mesh_file(folder.path() / "m.ply")), mesh));
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}

TEST_CASE("a PLY that cannot be written leaves nothing behind, and what was there stays", "[unit]") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(write_ply(folder.path() / "absent" / "m.ply", cube()), RecordError);
    std::filesystem::create_directory(folder.path() / "taken.ply");
    CHECK_THROWS_AS(write_ply(folder.path() / "taken.ply", cube()), RecordError);
    folder.file("m.ply", "precious");
    Mesh mesh = cube();
    mesh.part_names = {"two\nlines"};
    CHECK_THAT(message_of<RecordError>([&] { write_ply(folder.path() / "m.ply", mesh); }),
               Catch::Contains("m.ply") && Catch::Contains("line end"));
    CHECK(std::filesystem::file_size(folder.path() / "m.ply") == 8);
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 2);
}

TEST_CASE("an id map labels triangles, or vertices, and names the parts", "[unit]") {
    const TemporaryFolder folder;
    const auto mesh = folder.file("mesh.ply", labelled_ply("int", "", "", {}, {}));
    MeshImport import;
    MeshCleaningReport report;
    const auto with_labels = [&](std::string_view text) {
        import.labels = folder.file("labels.txt", text);
        return import_mesh(mesh, import, report);
    };
    const Mesh by_triangle = with_labels("# part 7 head\n# part 3 body\n3 # the first\r\n7\n");
    CHECK(by_triangle.part_names == std::vector<std::string>{"body", "head"});
    CHECK(by_triangle.triangle_parts == std::vector<PartIndex>{0, 1});
    // Corners 0 1 2 and 0 2 3: two of three decide.
    const Mesh by_vertex = with_labels("-1 -1\n5 5");
    CHECK(by_vertex.part_names == std::vector<std::string>{"part -1", "part 5"});
    CHECK(by_vertex.triangle_parts == std::vector<PartIndex>{0, 1});
}

TEST_CASE("an id map that does not fit its mesh is refused with the place and both counts", "[unit]") {
    const TemporaryFolder folder;
    const auto mesh = folder.file("mesh.ply", labelled_ply("int", "", "", {}, {}));
    MeshImport import;
    MeshCleaningReport report;
    const auto refusal = [&](std::string_view text) {
        import.labels = folder.file("labels.txt", text);
        try {
            import_mesh(mesh, import, report);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK_THAT(refusal("1\n2\n3\n"), Catch::Contains("holds 3 labels") && Catch::Contains("2 triangles") &&
                                         Catch::Contains("4 vertices"));
    CHECK_THAT(refusal("1\n  head\n"), Catch::Contains("labels.txt:2:3: 'head' is no label"));
    CHECK_THAT(refusal("1\n4294967296\n"), Catch::Contains("labels.txt:2:1"));
    CHECK_THAT(refusal("1 2.5"), Catch::Contains("labels.txt:1:3"));
}
