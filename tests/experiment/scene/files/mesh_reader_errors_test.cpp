#include "experiment/scene/files/mesh_reader.h"

#include <cstdlib>
#include <limits>

#include <catch2/catch.hpp>
#include <sys/stat.h>

#include "experiment/base/error.h"
#include "tests/experiment/scene/mesh_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

const TemporaryFolder& folder() {
    static const TemporaryFolder shared;
    return shared;
}

// What read_mesh_file says of a file, without the folder in front.
std::string complaint(const std::string& name, std::string_view content) {
    const auto path = folder().file(name, content);
    std::string message = message_of<InputError>([&] { read_mesh_file(path); });
    const std::string prefix = folder().path().string() + "/";
    if (message.starts_with(prefix))
        message.erase(0, prefix.size());
    return message;
}

std::string replaced(std::string text, std::string_view what, std::string_view with) {
    const std::size_t at = text.find(what);
    REQUIRE(at != text.npos);
    return text.replace(at, what.size(), with);
}

// Lines 1 to 9 are the header, 10 to 12 the vertices, 13 the face.
const std::string text_ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list char int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string binary_ply(std::string_view body, std::string_view counts = "uchar") {
    return "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
           "property float z\nelement face 1\nproperty list " +
           std::string(counts) + " int vertex_indices\nend_header\n" + std::string(body);
}

std::string vertices() {
    std::string bytes;
    for (const float value : {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f})
        bytes += stored(value);
    return bytes;
}

std::string corners(int a, int b, int c) { return stored(a) + stored(b) + stored(c); }

/// A part of a file that is right, what stands there instead, and how the complaint begins.
struct Fault {
    const char *what, *with, *expected;
};
void check_complaints(const std::string& name, const std::string& right, const std::vector<Fault>& faults) {
    for (const auto& [what, with, expected] : faults)
        CHECK_THAT(complaint(name, replaced(right, what, with)), Catch::StartsWith(expected));
}

} // namespace

TEST_CASE("files that are not there, not files, empty or of no known format are refused", "[unit]") {
    using Catch::Contains;
    const auto message = [](const std::filesystem::path& path) {
        return message_of<InputError>([&] { read_mesh_file(path); });
    };
    CHECK_THAT(message(folder().path() / "absent.ply"),
               Contains("absent.ply") && Contains("no such mesh file"));
    CHECK_THAT(message(folder().path()), Contains("folder"));
    REQUIRE(::mkfifo((folder().path() / "pipe.ply").c_str(), 0600) == 0);
    CHECK_THAT(message(folder().path() / "pipe.ply"), Contains("not a regular file"));
    CHECK_THAT(message(folder().file("file", "") / "below"), Contains("cannot be opened"));
    CHECK_THAT(complaint("empty.ply", ""), Contains("empty.ply: ") && Contains("empty"));
    CHECK_THAT(complaint("picture.png", "\x89PNG\r\n"),
               Contains("no mesh in a known format (PLY, OBJ, STL or glTF)"));
    CHECK_THAT(complaint("plan.ply", "plan\n"), Contains("does not begin with the line 'ply'"));
}

TEST_CASE("errors in a PLY header name their line and column", "[unit]") {
    check_complaints(
        "m.ply", text_ply,
        {
            {"format ascii", "format utf8", "m.ply:2:8: 'utf8' is no PLY format"},
            {"ascii 1.0", "ascii 2.0", "m.ply:2:14: the PLY version is '2.0'"},
            {"format ascii 1.0\n", "", "m.ply: the PLY header has no line 'format'"},
            {"vertex 3", "vertex -3", "m.ply:3:16: '-3' is no possible number of vertex elements"},
            {"vertex 3", "vertex some", "m.ply:3:16: 'some' is no possible number"},
            {"vertex 3", "vertex 99999999999999999999",
             "m.ply:3:16: '99999999999999999999' is no possible number"},
            {"vertex 3", "vertex 4294967296",
             "m.ply:3:16: the header promises 4294967296 vertices; at most 2147483647"},
            {"element vertex 3\n", "", "m.ply:3:1: this property stands before the first element"},
            {"float y", "real y", "m.ply:5:10: 'real' is no PLY type"},
            {"float y", "float", "m.ply:5:15: this property has no name"},
            {"float y", "float x", "m.ply:5:16: property x of element vertex is there twice"},
            {"float z", "float w", "m.ply: the PLY header gives element vertex no property z"},
            {"float z", "list uchar float z", "m.ply: the PLY header gives element vertex no property z"},
            {"element face", "element vertex", "m.ply:7:9: element vertex is there twice"},
            {"element face", "element edge", "m.ply: this PLY file has no faces"},
            {"face 1", "face 0", "m.ply: this PLY file has no faces"},
            {"list char", "list float", "m.ply:8:15: the length of a list must be an integer"},
            {"vertex_indices", "corners", "m.ply: the PLY header gives element face no list vertex_indices"},
            {"end_header", "endheader", "m.ply:9:1: 'endheader' is no word of a PLY header"},
        });
}

TEST_CASE("errors in a text PLY body name their line and column", "[unit]") {
    check_complaints(
        "m.ply", text_ply,
        {
            {"1 0 0\n", "1 nan 0\n",
             "m.ply:11:3: y of vertex 1 (counted from 0) is nan; coordinates must be finite"},
            {"1 0 0\n", "-inf 0 0\n", "m.ply:11:1: x of vertex 1 (counted from 0) is -inf"},
            {"1 0 0\n", "1e39 0 0\n", "m.ply:11:1: x of vertex 1 (counted from 0) is 1e+39"},
            {"1 0 0\n", "1 0,5 0\n",
             "m.ply:11:3: y of vertex 1 (counted from 0) is '0,5', which is no number"},
            {"1 0 0\n", "1 +-5 0\n",
             "m.ply:11:3: y of vertex 1 (counted from 0) is '+-5', which is no number"},
            {"1 0 0\n", "1 0\n", "m.ply:11:4: the line of vertex 1 (counted from 0) lacks a value"},
            {"1 0 0\n", "1 0 0 7\n", "m.ply:11:7: the line of vertex 1 (counted from 0) goes on with '7'"},
            {"3 0 1 2", "3 0 1 3",
             "m.ply:13:7: face 0 (counted from 0) uses vertex 3, but the vertices are 0 to 2"},
            {"3 0 1 2", "3 0 -1 2", "m.ply:13:5: face 0 (counted from 0) uses vertex -1"},
            {"3 0 1 2", "3 0 1 1.5", "m.ply:13:7: '1.5' in face 0 (counted from 0) is no integer"},
            {"3 0 1 2", "2 0 1", "m.ply:13:1: face 0 (counted from 0) has 2 corners; a face has at least 3"},
            {"3 0 1 2", "-3 0 1 2", "m.ply:13:1: the list vertex_indices has the impossible length -3"},
            {"3 0 1 2", "4 0 1 2", "m.ply:13:8: the line of face 0 (counted from 0) lacks a value"},
            {"3 0 1 2\n", "3 0 1",
             "m.ply:13:6: the file ends inside face 0 (counted from 0): the header promises 1 of "},
            {"3 0 1 2\n", "3 0 1 2\n3 2 1 0\n", "m.ply:14:1: the file goes on after the last element"},
            {"3 0 1 2\n", "",
             "m.ply:13:1: the file ends inside face 0 (counted from 0): the header promises 1 of them, 0 are "
             "complete"},
        });
}

TEST_CASE("errors in a binary PLY body name their byte", "[unit]") {
    using Catch::StartsWith;
    const std::size_t body = binary_ply("").size();
    const std::string face = stored(std::uint8_t{3}) + corners(0, 1, 2);
    REQUIRE(complaint("m.ply", binary_ply(vertices() + face)).empty());
    REQUIRE(complaint("m.ply", binary_ply(vertices() + face + "\r\n")).empty());

    std::string bad = vertices();
    bad.replace(16, 4, stored(std::numeric_limits<float>::quiet_NaN()));
    CHECK_THAT(complaint("m.ply", binary_ply(bad + face)),
               StartsWith(fmt::format("m.ply: byte {}: y of vertex 1 (counted from 0) is nan", body + 16)));
    CHECK_THAT(
        complaint("m.ply", binary_ply(vertices() + stored(std::uint8_t{3}) + corners(0, 3, 2))),
        StartsWith(fmt::format("m.ply: byte {}: face 0 (counted from 0) uses vertex 3", body + 36 + 5)));
    CHECK_THAT(complaint("m.ply", binary_ply(vertices() + stored(std::uint8_t{2}) + corners(0, 1, 2))),
               StartsWith(fmt::format("m.ply: byte {}: face 0 (counted from 0) has 2 corners", body + 36)));
    CHECK_THAT(
        complaint("m.ply", binary_ply(vertices() + stored(std::int8_t{-1}) + corners(0, 1, 2), "char")),
        StartsWith(fmt::format("m.ply: byte {}: the list vertex_indices has the impossible length -1",
                               body - 1 + 36)));
    CHECK_THAT(
        complaint("m.ply", binary_ply(vertices() + face.substr(0, 11))),
        StartsWith(fmt::format("m.ply: byte {}: the file ends inside face 0 (counted from 0): the header "
                               "promises 1 of them, 0 are complete",
                               body + 36 + 11)));
    CHECK_THAT(complaint("m.ply", binary_ply(vertices().substr(0, 35))),
               StartsWith(fmt::format(
                   "m.ply: byte {}: the header promises 3 vertex elements, but the 35 bytes", body)));
    CHECK_THAT(
        complaint("m.ply", binary_ply(vertices() + face + face)),
        StartsWith(fmt::format("m.ply: byte {}: the file goes on after the last element", body + 36 + 13)));
}

TEST_CASE("counts that the file has no room for are refused before anything is allocated", "[unit]") {
    using Catch::Contains;
    // 2147483647 vertices would take 26 GB, 9223372036854775807 faces cannot be had at all.
    const std::string face = stored(std::uint8_t{3}) + corners(0, 1, 2);
    const std::string good = binary_ply(vertices() + face);
    CHECK_THAT(complaint("m.ply", replaced(good, "vertex 3", "vertex 2147483647")), Contains("too few"));
    CHECK_THAT(complaint("m.ply", replaced(good, "face 1", "face 9223372036854775807")), Contains("too few"));
    CHECK_THAT(complaint("m.ply", replaced(text_ply, "vertex 3", "vertex 2147483647")), Contains("too few"));
    CHECK_THAT(complaint("m.ply", replaced(text_ply, "face 1", "face 9223372036854775807")),
               Contains("too few"));
    CHECK_THAT(complaint("m.ply", binary_ply(vertices() + stored(0xffffffffu) + corners(0, 1, 2), "uint")),
               Contains("ends inside face 0"));
    // 2^61 doubles take 2^64 bytes, which is 0 in 64 bits.
    const std::string list = replaced(good, "end_header", "property list uint64 double weights\nend_header");
    REQUIRE(complaint("m.ply", list + stored(std::uint64_t{0})).empty());
    CHECK_THAT(complaint("m.ply", list + stored(std::uint64_t{1} << 61)), Contains("ends inside face 0"));
    std::string stl = as_binary_stl(cube());
    stl.replace(80, 4, stored(0xffffffffu));
    CHECK_THAT(complaint("m.stl", stl), Contains("promises 4294967295 triangles") && Contains("12 complete"));
}

TEST_CASE("errors in an OBJ file name their line and column", "[unit]") {
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    REQUIRE(complaint("m.obj", obj).empty());
    check_complaints(
        "m.obj", obj,
        {
            {"v 1 0 0", "v 1 0", "m.obj:2:6: vertex 2 has no z coordinate"},
            {"v 1 0 0", "v 1 nan 0", "m.obj:2:5: y of vertex 2 is 'nan'; coordinates must be finite"},
            {"v 1 0 0", "v 1 1e99 0", "m.obj:2:5: y of vertex 2 is '1e99'; coordinates must be finite"},
            {"v 1 0 0", "v 1 \\\n oops 0", "m.obj:3:2: y of vertex 2 is 'oops', which is no number"},
            {"f 1 2 3", "f 1 2", "m.obj:4:6: this face has 2 corners; a face has at least 3"},
            {"f 1 2 3", "f 1 2 4", "m.obj:4:7: this face uses vertex 4, but the file has only 3 vertices"},
            {"f 1 2 3", "f 0 1 2", "m.obj:4:3: this face uses vertex 0"},
            {"f 1 2 3", "f 1 2 -4", "m.obj:4:7: this face uses vertex -4, but 3 vertices were read so far"},
            {"f 1 2 3", "f 1 2 99999999999", "m.obj:4:7: this face uses vertex 99999999999"},
            {"f 1 2 3", "f 1 2 x/1", "m.obj:4:7: 'x/1' is no corner of a face"},
            {"f 1 2 3", "p 1 2 3", "m.obj: this OBJ file has no faces"},
        });
}

TEST_CASE("errors in STL files name their line and column or their byte", "[unit]") {
    using Catch::StartsWith;
    const std::string text = as_text_stl(cube());
    CHECK_THAT(
        complaint("m.stl", replaced(text, "vertex 0 1 0", "vertex 0 inf 0")),
        StartsWith(
            "m.stl:5:16: y of a corner of facet 0 (counted from 0) is 'inf'; coordinates must be finite"));
    CHECK_THAT(complaint("m.stl", replaced(text, "vertex 0 1 0", "vertex 0 1")),
               StartsWith("m.stl:5:17: a corner of facet 0 (counted from 0) has no z coordinate"));
    CHECK_THAT(complaint("m.stl", replaced(text, "endloop", "vertex 0 0 0")),
               StartsWith("m.stl:7:5: 'vertex' stands where 'endloop' should be"));
    CHECK_THAT(
        complaint("m.stl", replaced(text, "endsolid a test\n", "")),
        StartsWith(
            "m.stl:86:1: the STL file ends where 'facet' or 'endsolid' should be; 12 facets are complete"));
    CHECK_THAT(complaint("m.stl", text + "surplus"),
               StartsWith("m.stl:87:1: 'surplus' stands where 'solid'"));
    CHECK_THAT(complaint("m.stl", "solid nothing\nendsolid nothing\n"),
               StartsWith("m.stl: this STL file has no facets"));

    std::string binary = as_binary_stl(cube());
    binary.replace(84 + 50 + 12 + 4, 4, stored(std::numeric_limits<float>::infinity()));
    CHECK_THAT(complaint("m.stl", binary),
               StartsWith("m.stl: byte 150: a corner of triangle 1 (counted from 0) has "
                          "the coordinate inf"));
    binary = as_binary_stl(cube());
    CHECK_THAT(
        complaint("m.stl", binary.substr(0, 300)),
        StartsWith(
            "m.stl: byte 300: the header promises 12 triangles, which take 684 bytes, but the file has "
            "300 bytes with 4 complete triangles"));
    CHECK_THAT(complaint("m.stl", binary + "surplus"),
               StartsWith("m.stl: byte 684: the file goes on after the 12"));
    CHECK_THAT(complaint("m.stl", as_binary_stl({})),
               StartsWith("m.stl: byte 80: this STL file has no triangles"));
}

TEST_CASE("a file cut off at any byte is refused or gives a whole mesh, in every format", "[unit]") {
    const struct {
        std::string name, content;
    } cases[] = {
        {"cut.ply", as_ply(cube(), PlyForm::text)},
        {"cut.ply", as_ply(cube(), PlyForm::little_endian)},
        {"cut.ply", as_ply(cube(), PlyForm::big_endian)},
        {"cut.obj", as_obj(cube())},
        {"cut.stl", as_text_stl(cube())},
        {"cut.stl", as_binary_stl(cube())},
        {"cut.stl", as_binary_stl(cube(), "solid ")},
    };
    for (const auto& [name, content] : cases) {
        std::size_t refused = 0;
        for (std::size_t length = 0; length < content.size(); ++length) {
            const auto path = folder().file(name, std::string_view(content).substr(0, length));
            try {
                const RawMesh mesh = read_mesh_file(path);
                REQUIRE_FALSE(mesh.triangles.empty());
                for (const glm::uvec3& t : mesh.triangles)
                    REQUIRE(std::max({t.x, t.y, t.z}) < mesh.positions.size());
            } catch (const InputError&) {
                ++refused;
            }
        }
        CHECK(refused > content.size() / 2);
    }
}

TEST_CASE("a file with any one byte changed is refused or gives a whole mesh", "[unit]") {
    for (const std::string& content :
         {as_ply(cube(), PlyForm::little_endian), as_binary_stl(cube()), as_obj(cube())}) {
        for (std::size_t at = 0; at < content.size(); ++at) {
            std::string damaged = content;
            damaged[at] = static_cast<char>(damaged[at] ^ (1 << (at % 8)));
            const auto path = folder().file("damaged.obj", damaged);
            try {
                const RawMesh mesh = read_mesh_file(path);
                REQUIRE_FALSE(mesh.triangles.empty());
                for (const glm::uvec3& t : mesh.triangles)
                    REQUIRE(std::max({t.x, t.y, t.z}) < mesh.positions.size());
            } catch (const InputError&) {
            }
        }
    }
}
