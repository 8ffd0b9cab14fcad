#include "experiment/scene/making/face_cutting.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/base/whole_file.h"
#include "experiment/scene/files/mesh_reader.h"
#include "experiment/scene/making/orientation.h"
#include "experiment/scene/mesh_topology.h"
#include "tests/experiment/scene/mesh_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

using Polygon = std::vector<glm::ivec2>;

long long lattice_turn(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
    const glm::i64vec2 ab = glm::i64vec2(b) - glm::i64vec2(a), ac = glm::i64vec2(c) - glm::i64vec2(a);
    return ab.x * ac.y - ab.y * ac.x;
}

int sign_of_turn(long long value) { return (value > 0) - (value < 0); }

bool is_on_edge(glm::ivec2 a, glm::ivec2 b, glm::ivec2 p) {
    return lattice_turn(a, b, p) == 0 && glm::all(glm::lessThanEqual(glm::min(a, b), p)) &&
           glm::all(glm::lessThanEqual(p, glm::max(a, b)));
}

/// Whether two segments have any point in common.
bool edges_meet(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c, glm::ivec2 d) {
    if (sign_of_turn(lattice_turn(a, b, c)) * sign_of_turn(lattice_turn(a, b, d)) < 0 &&
        sign_of_turn(lattice_turn(c, d, a)) * sign_of_turn(lattice_turn(c, d, b)) < 0)
        return true;
    return is_on_edge(a, b, c) || is_on_edge(a, b, d) || is_on_edge(c, d, a) || is_on_edge(c, d, b);
}

bool is_simple(const Polygon& p) {
    const std::size_t n = p.size();
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = i + 1; k < n; ++k) {
            const bool follows = k == i + 1, precedes = i == 0 && k == n - 1;
            if (follows    ? is_on_edge(p[i], p[k], p[(k + 1) % n]) && n > 3
                : precedes ? is_on_edge(p[k], p[i], p[1]) || is_on_edge(p[0], p[1], p[k])
                           : edges_meet(p[i], p[i + 1], p[k], p[(k + 1) % n]))
                return false;
            if (follows && is_on_edge(p[k], p[(k + 1) % n], p[i]))
                return false;
        }
    }
    return true;
}

long long twice_area(const Polygon& p) {
    long long sum = 0;
    for (std::size_t i = 1; i + 1 < p.size(); ++i)
        sum += lattice_turn(p[0], p[i], p[i + 1]);
    return sum;
}

/// Corners on a small lattice, so that many lie on a line, joined in a way that does not cross itself.
Polygon random_polygon(std::mt19937& random, int corners, int lattice) {
    while (true) {
        std::set<std::pair<int, int>> places;
        while (static_cast<int>(places.size()) < corners)
            places.insert({static_cast<int>(random() % static_cast<unsigned>(lattice)),
                           static_cast<int>(random() % static_cast<unsigned>(lattice))});
        Polygon polygon;
        for (const auto& [x, y] : places)
            polygon.emplace_back(x, y);
        std::shuffle(polygon.begin(), polygon.end(), random);
        // Where two edges cross, turning what is between them round makes the outline shorter.
        for (int step = 0; step < 4000 && !is_simple(polygon); ++step) {
            const std::size_t i = random() % polygon.size(), k = random() % polygon.size();
            const std::size_t from = std::min(i, k), to = std::max(i, k);
            if (to - from < 2)
                continue;
            const auto next = [&](std::size_t at) { return polygon[(at + 1) % polygon.size()]; };
            const auto length = [](glm::ivec2 a, glm::ivec2 b) { return glm::length(glm::dvec2(a - b)); };
            if (length(polygon[from], polygon[to]) + length(next(from), next(to)) <
                length(polygon[from], next(from)) + length(polygon[to], next(to)))
                std::reverse(polygon.begin() + static_cast<std::ptrdiff_t>(from) + 1,
                             polygon.begin() + static_cast<std::ptrdiff_t>(to) + 1);
        }
        if (!is_simple(polygon) || twice_area(polygon) == 0)
            continue;
        if (twice_area(polygon) < 0)
            std::reverse(polygon.begin(), polygon.end());
        return polygon;
    }
}

/// The polygon in a plane through space that lies exactly on its numbers; vertices are numbered by `numbers`.
RawMesh cut_face(const Polygon& polygon, const std::vector<std::uint32_t>& numbers, glm::dvec3 right,
                 glm::dvec3 up) {
    RawMesh mesh;
    mesh.positions.resize(polygon.size());
    for (std::size_t i = 0; i < polygon.size(); ++i)
        mesh.positions[numbers[i]] =
            glm::dvec3(7.0, -3.0, 11.0) + right * double(polygon[i].x) + up * double(polygon[i].y);
    FaceFans fans(mesh);
    fans.begin_face();
    for (const std::uint32_t number : numbers)
        fans.add_corner(number);
    fans.cut();
    return mesh;
}

std::multiset<std::array<std::uint32_t, 3>> as_set(const RawMesh& mesh) {
    std::multiset<std::array<std::uint32_t, 3>> all;
    for (const glm::uvec3& t : mesh.triangles) {
        std::array<std::uint32_t, 3> corners{t.x, t.y, t.z};
        std::ranges::rotate(corners, std::ranges::min_element(corners));
        all.insert(corners);
    }
    return all;
}

std::vector<std::uint32_t> numbers_from(std::size_t first, std::size_t count) {
    std::vector<std::uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    std::ranges::rotate(numbers, numbers.begin() + static_cast<std::ptrdiff_t>(first));
    return numbers;
}

bool is_convex(const Polygon& p) {
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (lattice_turn(p[i], p[(i + 1) % p.size()], p[(i + 2) % p.size()]) < 0)
            return false;
    }
    return true;
}

std::filesystem::path field_case(const char* name) {
    return std::filesystem::path(OVERT_SOURCE_DIR) / "tests/data/meshes" / name;
}

} // namespace

TEST_CASE("the side of a line is told exactly, also where ordinary arithmetic errs", "[unit]") {
    std::mt19937_64 random(5);
    int near = 0, wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto whole = [&](std::uint64_t bound) {
            return static_cast<long long>(random() % bound) - static_cast<long long>(bound / 2);
        };
        const long long ax = whole(1ull << 50), ay = whole(1ull << 50), dx = whole(1ull << 25),
                        dy = whole(1ull << 25);
        const long long s = whole(1ull << 20), t = whole(1ull << 20);
        const long long bx = ax + s * dx, by = ay + s * dy, cx = ax + t * dx + whole(3),
                        cy = ay + t * dy + whole(3);
        const __int128 area =
            static_cast<__int128>(bx - ax) * (cy - ay) - static_cast<__int128>(by - ay) * (cx - ax);
        const int expected = (area > 0) - (area < 0);
        const glm::dvec2 a(ax, ay), b(bx, by), c(cx, cy);
        REQUIRE(orientation(a, b, c) == expected);
        REQUIRE(orientation(b, c, a) == expected);
        REQUIRE(orientation(b, a, c) == -expected);
        const double rounded = a.x * b.y - a.y * b.x + b.x * c.y - b.y * c.x + c.x * a.y - c.y * a.x;
        near += expected == 0;
        wrong += (rounded > 0.0) - (rounded < 0.0) != expected;
    }
    CHECK(near > 100);
    CHECK(wrong > 100);
}

TEST_CASE("any simple polygon keeps its area, its outline and its front, wherever its corners begin",
          "[unit]") {
    std::mt19937 random(20);
    int concave = 0, straight = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const int corners = 4 + trial % 14;
        const Polygon polygon = random_polygon(random, corners, 5 + trial % 6);
        const auto n = polygon.size();
        // Whole numbers, so that the plane holds all corners exactly; each axis is the steepest in turn.
        const glm::dvec3 right = trial % 3 == 0   ? glm::dvec3(3, 1, 0)
                                 : trial % 3 == 1 ? glm::dvec3(0, 4, 1)
                                                  : glm::dvec3(1, 0, 3),
                         up = trial % 3 == 0   ? glm::dvec3(-1, 2, 1)
                              : trial % 3 == 1 ? glm::dvec3(1, -1, 3)
                                               : glm::dvec3(4, 1, -1);
        const glm::dvec3 normal = glm::cross(right, up);
        std::multiset<std::array<std::uint32_t, 3>> first;
        for (std::size_t begin = 0; begin < n; ++begin) {
            Polygon turned = polygon;
            std::ranges::rotate(turned, turned.begin() + static_cast<std::ptrdiff_t>(begin));
            const RawMesh mesh = cut_face(turned, numbers_from(begin, n), right, up);
            REQUIRE(mesh.triangles.size() == n - 2);
            REQUIRE(mesh.crossing_faces == 0);
            std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
            double area = 0.0;
            for (const glm::uvec3& t : mesh.triangles) {
                const glm::dvec3 own = glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                                  mesh.positions[t.z] - mesh.positions[t.x]);
                // None is turned over, so that none overlaps another if the areas sum to the polygon's.
                REQUIRE(glm::dot(own, normal) > 0.0);
                area += glm::dot(own, normal) / glm::dot(normal, normal);
                for (int corner = 0; corner < 3; ++corner)
                    ++edges[{t[corner], t[(corner + 1) % 3]}];
            }
            REQUIRE(area == Approx(static_cast<double>(twice_area(polygon))).epsilon(1e-12));
            for (std::uint32_t i = 0; i < n; ++i)
                REQUIRE(edges[{i, static_cast<std::uint32_t>((i + 1) % n)}] == 1);
            std::size_t lone = 0;
            for (const auto& [edge, count] : edges) {
                const auto opposite = edges.find({edge.second, edge.first});
                lone += count == 1 && (opposite == edges.end() || opposite->second == 0);
            }
            REQUIRE(lone == n);
            if (is_convex(polygon))
                continue;
            if (begin == 0)
                first = as_set(mesh);
            REQUIRE(as_set(mesh) == first);
        }
        bool has_straight = false;
        for (std::size_t i = 0; i < n; ++i)
            has_straight =
                has_straight || lattice_turn(polygon[i], polygon[(i + 1) % n], polygon[(i + 2) % n]) == 0;
        straight += has_straight;
        concave += !is_convex(polygon);
    }
    CHECK(concave > 200);
    CHECK(straight > 50);
}

TEST_CASE("a convex face is the fan about its first corner, whichever that is", "[unit]") {
    // On a parabola, in whole numbers.
    Polygon polygon;
    for (int i = -4; i <= 4; ++i)
        polygon.emplace_back(i, i * i);
    for (std::size_t begin = 0; begin < polygon.size(); ++begin) {
        Polygon turned = polygon;
        std::ranges::rotate(turned, turned.begin() + static_cast<std::ptrdiff_t>(begin));
        const std::vector<std::uint32_t> numbers = numbers_from(begin, polygon.size());
        const RawMesh mesh = cut_face(turned, numbers, {1, 2, 0}, {0, 1, 5});
        std::vector<glm::uvec3> fan;
        for (std::size_t i = 2; i < numbers.size(); ++i)
            fan.emplace_back(numbers[0], numbers[i - 1], numbers[i]);
        CHECK(mesh.triangles == fan);
    }
    // A triangle that is written as a quadrilateral stays what it was.
    RawMesh padded;
    padded.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    FaceFans fans(padded);
    fans.begin_face();
    for (const std::uint32_t corner : {0u, 1u, 2u, 2u})
        fans.add_corner(corner);
    fans.cut();
    CHECK(padded.triangles == std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 2}});
}

TEST_CASE(
    "a quadrilateral with a corner pushed in is cut along the diagonal inside, also if it is not quite flat",
    "[unit]") {
    for (const double lift : {0.0, 0.05}) {
        for (std::size_t begin = 0; begin < 4; ++begin) {
            RawMesh mesh;
            mesh.positions = {{0, 0, 0}, {4, 0, 0}, {1, 1, lift}, {0, 4, 0}}; // an arrow; 2 is pushed in
            FaceFans fans(mesh);
            fans.begin_face();
            for (const std::uint32_t corner : numbers_from(begin, 4))
                fans.add_corner(corner);
            fans.cut();
            CHECK(as_set(mesh) == std::multiset<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}});
        }
    }
}

TEST_CASE("corners at one place take nothing from a concave face and add nothing to it", "[unit]") {
    // An L, of which each corner in turn is there twice, and once more as a vertex of its own.
    const Polygon corner{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};
    for (std::size_t doubled = 0; doubled < corner.size(); ++doubled) {
        for (const std::size_t times : {1u, 2u}) {
            Polygon polygon = corner;
            polygon.insert(polygon.begin() + static_cast<std::ptrdiff_t>(doubled), times, corner[doubled]);
            const RawMesh mesh = cut_face(polygon, numbers_from(0, polygon.size()), {1, 0, 0}, {0, 1, 0});
            REQUIRE(mesh.triangles.size() == polygon.size() - 2);
            double area = 0.0;
            for (const glm::uvec3& t : mesh.triangles) {
                const glm::dvec3 own = glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                                  mesh.positions[t.z] - mesh.positions[t.x]);
                CHECK(own.z >= 0.0);
                area += 0.5 * glm::length(own);
            }
            CHECK(area == 7.0);
            CHECK(mesh.crossing_faces == 0);
        }
    }
}

TEST_CASE("a face that crosses itself stays a fan and is counted", "[unit]") {
    RawMesh mesh;
    mesh.positions = {{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 3, 0}};
    FaceFans fans(mesh);
    fans.begin_face();
    for (const std::uint32_t corner : {0u, 1u, 2u, 3u})
        fans.add_corner(corner);
    fans.cut();
    CHECK(mesh.crossing_faces == 1);
    CHECK(mesh.triangles == std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("a C of two faces of 48 corners has the surface of the same C in triangles", "[unit]") {
    MeshCleaningReport report;
    const Mesh triangles = import_mesh(field_case("C_tri.ply"), {}, report);
    const TemporaryFolder folder;
    std::string marked = read_whole_file(field_case("C_ngon.ply"));
    for (const auto& file : {field_case("C_ngon.ply"), field_case("C_ngon.obj"),
                             folder.file("marked.ply", "\xEF\xBB\xBF" + marked)}) {
        const Mesh mesh = import_mesh(file, {}, report);
        CHECK(mesh.triangles.size() == triangles.triangles.size());
        CHECK(mesh.area() == Approx(triangles.area()).epsilon(1e-6));
        CHECK(signed_volume(mesh) == Approx(signed_volume(triangles)).epsilon(1e-6));
        CHECK(report.boundary_edges == 0);
        CHECK(describe(report).empty());
    }
}
