#include "experiment/maps/glass_sight.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "tests/support/cast_maps.h"

using namespace overt;
using test::CastScene;

namespace {

constexpr double crown_index = 1.5168; // N-BK7 at 587.6 nm

/// Where a line that meets a ball about the origin leaves it by Snell's law: in the plane of the line and the
/// middle, a half turn less twice the angle inside from where it came in (an isosceles triangle).
glm::dvec3 far_side_of_ball(const glm::dvec3& from, const glm::dvec3& front, double index) {
    const glm::dvec3 along = glm::normalize(front - from), out = glm::normalize(front);
    const double sine = std::min(1.0, glm::length(glm::cross(along, out)));
    const double turn = std::numbers::pi - 2.0 * std::asin(sine / index);
    glm::dvec3 aside = along - glm::dot(along, out) * out;
    aside = glm::length(aside) > 1e-12 ? glm::normalize(aside) : glm::dvec3(0.0);
    return glm::length(front) * (std::cos(turn) * out + std::sin(turn) * aside);
}

/// A bar along the line of sight, y, between two walls of which the front one is slanted in x: its corner
/// lies at (0, 0), the other at (run, rise).
Mesh prism(double back) {
    Mesh mesh;
    for (const double z : {-10.0, 10.0})
        for (const glm::dvec2& corner :
             {glm::dvec2(-10.0, 0.0), glm::dvec2(10.0, 0.0), glm::dvec2(-10.0, back)})
            mesh.positions.emplace_back(corner.x, corner.y, z);
    mesh.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
    mesh.triangle_parts.assign(mesh.triangles.size(), PartIndex{0});
    mesh.part_names = {"body"};
    return mesh;
}

/// The front and the far point at a place of the image, both there.
struct Sighted {
    SurfacePoint front;
    std::optional<FarPoint> far;
};
std::optional<Sighted> sighted(const CoordinateMaps& maps, const GlassSight& glass, PoseIndex pose,
                               glm::dvec2 place) {
    const std::optional<SurfacePoint> front = maps.surface_at(pose, place);
    return front ? std::optional(Sighted{*front, glass.far_point(pose, *front)}) : std::nullopt;
}

} // namespace

TEST_CASE("the far point of a glass ball is where Snell's law has it", "[unit]") {
    // Of lines all alike, the numbers of a parallel beam: of impact 0.2, 0.5, 0.8 radii the exit lies this
    // far from the axis.
    for (const auto& [impact, beside] : {std::pair{0.2, 0.06308}, {0.5, 0.14771}, {0.8, 0.18281}}) {
        const glm::dvec3 front(impact, -std::sqrt(1.0 - impact * impact), 0.0);
        const glm::dvec3 far = far_side_of_ball(front - glm::dvec3(0.0, 1.0, 0.0), front, crown_index);
        CHECK(std::abs(far.x) == Approx(beside).margin(5e-6));
    }
    const CastScene scene(test::ball({0.0, 0.0, 0.0}, 50.0, 160, 320), {{0.0}, {35.0}});
    const CoordinateMaps maps = scene.maps();
    const GlassSight glass(maps, crown_index);
    int compared = 0;
    for (const PoseIndex pose : {PoseIndex{0}, PoseIndex{1}}) {
        for (int y = 2; y < 160; y += 13) {
            for (int x = 2; x < 160; x += 13) {
                const auto seen = sighted(maps, glass, pose, {x + 0.3, y + 0.7});
                if (!seen || seen->front.incidence.value > 80.0)
                    continue;
                REQUIRE(seen->far);
                ++compared;
                const glm::dvec3 known =
                    far_side_of_ball(maps.sight_lines(pose).origin(), seen->front.position, crown_index);
                CAPTURE(x, y, seen->front.incidence.value);
                // The ball is a polyhedron of a relative depth of 5e-5; its normals are those of the ball.
                CHECK(glm::distance(seen->far->surface.position, known) < 0.05);
                CHECK(seen->far->reflections == 0);
                const SurfacePoint& far = seen->far->surface;
                CHECK(far.depth == Approx(maps.sight_lines(pose).project(far.position).z).epsilon(1e-12));
                // The angle inside is the same at both ends of a chord.
                CHECK(std::sin(to_radians(far.incidence).value) * crown_index ==
                      Approx(std::sin(to_radians(seen->front.incidence).value)).margin(0.05));
                const glm::uvec3 corners = scene.mesh.triangles[far.triangle];
                glm::dvec3 of_triangle(0.0);
                for (int corner = 0; corner < 3; ++corner)
                    of_triangle +=
                        far.barycentric[corner] * glm::dvec3(scene.mesh.positions[corners[corner]]);
                CHECK(glm::distance(of_triangle, far.position) < 1e-9 * 50.0);
            }
        }
    }
    CHECK(compared > 100);
}

TEST_CASE("through a slab of glass a line of sight goes on beside itself", "[unit]") {
    // 20 thick in y, turned so that the line comes in from aside.
    const CastScene scene(test::box({-60.0, -10.0, -60.0}, {60.0, 10.0, 60.0}), {{0.0}, {30.0}});
    const CoordinateMaps maps = scene.maps();
    for (const double index : {1.0, 1.3, crown_index, 2.4}) {
        const GlassSight glass(maps, index);
        int compared = 0;
        for (int y = 30; y < 130; y += 9) {
            for (int x = 60; x < 100; x += 7) {
                const auto seen = sighted(maps, glass, {1}, {x + 0.5, y + 0.5});
                if (!seen || std::abs(seen->front.position.y + 10.0) > 1e-6)
                    continue;
                const glm::dvec3 along =
                    glm::normalize(seen->front.position - maps.sight_lines({1}).origin());
                // Snell: the part along the wall becomes smaller by the index.
                const glm::dvec2 beside = glm::dvec2(along.x, along.z) / index;
                const glm::dvec2 far = glm::dvec2(seen->front.position.x, seen->front.position.z) +
                                       20.0 / std::sqrt(1.0 - glm::dot(beside, beside)) * beside;
                if (std::abs(far.x) > 59.0 || std::abs(far.y) > 59.0)
                    continue; // leaves by a side
                CAPTURE(index, x, y);
                REQUIRE(seen->far);
                CHECK(glm::distance(seen->far->surface.position, {far.x, 10.0, far.y}) < 1e-6);
                CHECK(seen->far->surface.incidence.value ==
                      Approx(to_degrees({std::asin(glm::length(beside))}).value).margin(1e-6));
                ++compared;
            }
        }
        CHECK(compared > 20);
    }
}

TEST_CASE("a line of sight is mirrored in a prism where nothing leaves, and ends where it is not", "[unit]") {
    // Its front is a leg, its slanted wall the hypotenuse: 45 degrees inside, where crown glass mirrors all.
    const CastScene scene(prism(20.0), {{0.0}});
    const CoordinateMaps maps = scene.maps();
    const glm::dvec3 eye = maps.sight_lines({0}).origin();
    const auto middle = [&](double index) {
        const glm::dvec3 place = maps.sight_lines({0}).project({-4.0, 0.0, 0.0});
        return *sighted(maps, GlassSight(maps, index), {0}, {place.x, place.y});
    };
    const Sighted mirrored = middle(crown_index);
    REQUIRE(mirrored.far);
    CHECK(mirrored.far->reflections == 1);
    // By the wall x + y = 10: what went along (a, b) goes along (-b, -a). It leaves by the other leg, x =
    // -10.
    const glm::dvec3 front = mirrored.front.position;
    glm::dvec3 inside = glm::normalize(front - eye);
    const double sine_x = inside.x / crown_index, sine_z = inside.z / crown_index;
    inside = {sine_x, std::sqrt(1.0 - sine_x * sine_x - sine_z * sine_z), sine_z};
    const double to_wall = (10.0 - front.x - front.y) / (inside.x + inside.y);
    const glm::dvec3 at_wall = front + to_wall * inside, after(-inside.y, -inside.x, inside.z);
    const glm::dvec3 known = at_wall + (-10.0 - at_wall.x) / after.x * after;
    CHECK(glm::distance(mirrored.far->surface.position, known) < 1e-6);
    // A thinner glass lets it out at the wall itself.
    const Sighted let_out = middle(1.3);
    REQUIRE(let_out.far);
    CHECK(let_out.far->reflections == 0);
    CHECK(let_out.far->surface.position.x + let_out.far->surface.position.y == Approx(10.0).margin(1e-6));
    // Without a back there is nothing to see it on.
    Mesh open = prism(20.0);
    open.triangles.resize(4);
    open.triangle_parts.resize(4);
    const CastScene front_alone(open, {{0.0}});
    const CoordinateMaps of_front = front_alone.maps();
    const glm::dvec3 place = of_front.sight_lines({0}).project({-4.0, 0.0, 0.0});
    CHECK_FALSE(sighted(of_front, GlassSight(of_front, crown_index), {0}, {place.x, place.y})->far);
}

TEST_CASE("a line of sight that goes on being mirrored has no far point", "[unit]") {
    // A rod, looked into by its end from aside: its walls mirror, as the lines of a hall of mirrors go on
    // straight through the rooms behind them.
    const auto along_rod = [](double length) {
        const CastScene scene(test::box({-1.0, -0.5 * length, -1.0}, {1.0, 0.5 * length, 1.0}), {{20.0}},
                              {400, 400});
        const CoordinateMaps maps = scene.maps();
        const glm::dvec3 place = maps.sight_lines({0}).project({0.0, -0.5 * length, 0.0});
        const auto seen = sighted(maps, GlassSight(maps, 2.4), {0}, {place.x, place.y});
        REQUIRE(seen);
        REQUIRE(seen->front.position.y == Approx(-0.5 * length));
        const glm::dvec3 along = glm::normalize(seen->front.position - maps.sight_lines({0}).origin());
        const double beside = along.x / 2.4, up = along.z / 2.4;
        const double per_length = 1.0 / std::sqrt(1.0 - beside * beside - up * up);
        const auto walls = [&](double from, double slope) {
            return static_cast<int>(std::abs(std::round(0.5 * (from + length * per_length * slope))));
        };
        return std::pair{seen->far,
                         walls(seen->front.position.x, beside) + walls(seen->front.position.z, up)};
    };
    const auto [of_short, few] = along_rod(40.0);
    REQUIRE(few >= 2);
    REQUIRE(few <= most_total_reflections);
    REQUIRE(of_short);
    CHECK(of_short->reflections == few);
    CHECK(of_short->surface.position.y == Approx(20.0).margin(1e-9));
    const auto [of_long, many] = along_rod(200.0);
    CHECK(many > most_total_reflections);
    CHECK_FALSE(of_long);
}

TEST_CASE("a map through glass has the far points of its pixels' centres", "[unit]") {
    const CastScene scene(test::ball({1.0, 2.0, 3.0}, 50.0), {{0.0}, {20.0}}, {40, 40});
    const CoordinateMaps maps = scene.maps();
    const GlassSight glass(maps, crown_index);
    const CoordinateImage image = glass.image({1});
    REQUIRE(image.size_px == glm::ivec2(40, 40));
    int covered = 0;
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 40; ++x) {
            const auto seen = sighted(maps, glass, {1}, {x + 0.5, y + 0.5});
            const bool is_seen = seen && seen->far;
            REQUIRE(image.covers(x, y) == is_seen);
            covered += is_seen;
            if (is_seen)
                CHECK(image.at(x, y) == glm::vec4(seen->far->surface.position, 1.0f));
        }
    }
    CHECK(covered > 500);
}
