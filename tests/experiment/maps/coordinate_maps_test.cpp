#include "experiment/maps/coordinate_maps.h"

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "tests/support/cast_maps.h"

using namespace overt;
using test::CastScene;

namespace {

/// Compares look-ups with rays at random places of all poses: how many differ by more than `share` of the
/// diagonal, or in whether there is a surface.
int differing_places(const CastScene& scene, const CoordinateMaps& maps, int places, double share = 1e-9) {
    RandomStream random(7, "places in the image");
    int differing = 0;
    const double diagonal = scene.mesh.bounds().diagonal();
    for (int i = 0; i < places; ++i) {
        const PoseIndex pose{i % static_cast<int>(scene.angles.size())};
        const glm::dvec2 place(random.uniform(0.0, scene.scene.view.image_px.x),
                               random.uniform(0.0, scene.scene.view.image_px.y));
        const auto hit = scene.hit(pose, place);
        const auto surface = maps.surface_at(pose, place);
        differing += hit.has_value() != surface.has_value() ||
                     (hit && glm::distance(hit->position, surface->position) > share * diagonal);
    }
    return differing;
}

/// A comb of blades far thinner than a pixel, in front of a wall.
Mesh blades() {
    Mesh mesh;
    test::add_part(mesh, test::box({-100.0, 40.0, 0.0}, {100.0, 60.0, 150.0}), "body");
    for (int i = 0; i < 12; ++i) {
        const double x = -80.0 + 13.7 * i;
        test::add_part(mesh, test::box({x, -20.0, 20.0}, {x + 0.3, 10.0, 170.0}), "head");
    }
    return mesh;
}

/// A ball with a hole through which its inner side is seen, edge and all.
Mesh cracked_ball() {
    Mesh mesh = test::ball({0.0, 0.0, 0.0}, 50.0);
    Mesh cracked = mesh;
    cracked.triangles.clear();
    for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::vec3 corner = mesh.positions[triangle.x];
        if (!(corner.y < -20.0f && corner.z > 0.0f && corner.x > -20.0f && corner.x < 15.0f))
            cracked.triangles.push_back(triangle);
    }
    cracked.triangle_parts.assign(cracked.triangles.size(), PartIndex{0});
    return cracked;
}

} // namespace

TEST_CASE("a look-up gives what a ray through the same place meets, at edges too", "[unit]") {
    const CastScene balls(test::two_balls(), {{0.0}, {25.0}, {-13.7}});
    CHECK(differing_places(balls, balls.maps(), 30000) == 0);
    const CastScene bust(test::bust(), {{0.0}, {-25.0}});
    CHECK(differing_places(bust, bust.maps(), 20000) == 0);
}

TEST_CASE("what is too thin for the pixels is met where rays meet it", "[unit]") {
    const CastScene comb(blades(), {{0.0}, {10.0}});
    CHECK(differing_places(comb, comb.maps(), 20000) == 0);
}

TEST_CASE("a mesh with a hole shows its inner side through it", "[unit]") {
    const CastScene ball(cracked_ball(), {{0.0}, {20.0}});
    CHECK(differing_places(ball, ball.maps(), 20000) == 0);
}

TEST_CASE("where a mesh passes through itself, look-ups still follow the nearer surface", "[unit]") {
    Mesh mesh;
    test::add_part(mesh, test::ball({0.0, 0.0, 0.0}, 50.0), "body");
    test::add_part(mesh, test::ball({20.0, -15.0, 30.0}, 40.0), "head");
    const CastScene balls(std::move(mesh), {{0.0}, {15.0}});
    CHECK(differing_places(balls, balls.maps(), 20000) <= 2);
}

TEST_CASE("a map that took the wrong one of two surfaces at some pixels does no harm", "[unit]") {
    const CastScene balls(test::two_balls(), {{0.0}});
    TriangleMap map = balls.map({0});
    RandomStream random(3, "wrong pixels");
    int damaged = 0;
    for (std::uint32_t& code : map.codes) {
        if (code != 0 && random.below(200) == 0) {
            code = 1 + random.below(static_cast<std::uint32_t>(balls.mesh.triangles.size()));
            ++damaged;
        }
    }
    REQUIRE(damaged > 20);
    const CoordinateMaps maps(balls.mesh, balls.scene, balls.angles, {map});
    CHECK(differing_places(balls, maps, 20000) == 0);
}

TEST_CASE("a full turn shows the same as none", "[unit]") {
    const CastScene bust(test::bust(), {{0.0}, {360.0}});
    const CoordinateMaps maps = bust.maps();
    RandomStream random(5, "places");
    int compared = 0;
    for (int i = 0; i < 5000; ++i) {
        const glm::dvec2 place(random.uniform(0.0, 160.0), random.uniform(0.0, 160.0));
        const auto before = maps.surface_at({0}, place), after = maps.surface_at({1}, place);
        REQUIRE(before.has_value() == after.has_value());
        if (!before)
            continue;
        ++compared;
        CHECK(glm::distance(before->position, after->position) < 1e-9);
    }
    CHECK(compared > 1000);
}

TEST_CASE("maps of half the resolution give the same surface at the same place", "[unit]") {
    CastScene fine(test::bust(), {{10.0}});
    CastScene coarse(test::bust(), {{10.0}}, {80, 80});
    coarse.scene.view.camera = fine.scene.view.camera;
    const CoordinateMaps fine_maps = fine.maps(), coarse_maps = coarse.maps();
    RandomStream random(6, "places");
    int compared = 0;
    for (int i = 0; i < 5000; ++i) {
        const glm::dvec2 place(random.uniform(0.0, 80.0), random.uniform(0.0, 80.0));
        const auto one = coarse_maps.surface_at({0}, place), other = fine_maps.surface_at({0}, 2.0 * place);
        REQUIRE(one.has_value() == other.has_value());
        if (!one)
            continue;
        ++compared;
        CHECK(glm::distance(one->position, other->position) < 1e-9 * fine.mesh.bounds().diagonal());
    }
    CHECK(compared > 1000);
}

TEST_CASE("a surface point has its triangle, weights, part, depth and incidence", "[unit]") {
    const CastScene bust(test::bust(), {{-20.0}});
    const CoordinateMaps maps = bust.maps();
    RandomStream random(8, "places");
    const TurntablePose pose = bust.scene.pose_at({-20.0});
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec2 place(random.uniform(0.0, 160.0), random.uniform(0.0, 160.0));
        const auto surface = maps.surface_at({0}, place);
        if (!surface)
            continue;
        const glm::uvec3 corners = bust.mesh.triangles[surface->triangle];
        const glm::dvec3 a(bust.mesh.positions[corners.x]), b(bust.mesh.positions[corners.y]),
            c(bust.mesh.positions[corners.z]);
        const glm::dvec3 weights = surface->barycentric;
        CHECK(weights.x + weights.y + weights.z == Approx(1.0).margin(1e-12));
        CHECK(glm::distance(weights.x * a + weights.y * b + weights.z * c, surface->position) < 1e-9);
        CHECK(surface->part == bust.mesh.triangle_parts[surface->triangle]);
        const glm::dvec3 in_world(pose.world_from_object() * glm::dvec4(surface->position, 1.0));
        CHECK(surface->depth == Approx(bust.scene.view.depth_of(in_world)));
        CHECK(glm::distance(bust.scene.view.project(in_world), place) < 1e-9);
        const glm::dvec3 sight = to_object(bust.scene.view.ray_through(place), pose).direction;
        const glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
        CHECK(std::cos(to_radians(surface->incidence).value) ==
              Approx(-glm::dot(normal, sight)).margin(1e-9));
    }
}

TEST_CASE("looking at many places gives what looking at each gives", "[unit]") {
    const CastScene balls(test::two_balls(), {{0.0}, {25.0}});
    const CoordinateMaps maps = balls.maps();
    RandomStream random(9, "places");
    std::vector<ImagePlace> places;
    for (int i = 0; i < 1000; ++i)
        places.push_back({{i % 2}, {random.uniform(-40.0, 200.0), random.uniform(-40.0, 200.0)}});
    std::vector<Sight> sights(places.size());
    std::vector<Sight*> into;
    for (Sight& sight : sights)
        into.push_back(&sight);
    maps.look(places, into);
    int on_object = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto surface = maps.surface_at(places[i].pose, places[i].point_px);
        REQUIRE(surface.has_value() == sights[i].surface.has_value());
        CHECK(sights[i].outline_px.has_value());
        if (!surface)
            continue;
        ++on_object;
        CHECK(surface->position == sights[i].surface->position);
        CHECK(surface->triangle == sights[i].surface->triangle);
    }
    CHECK(on_object > 100);
}

TEST_CASE("outside of the image, and at no number, there is no surface", "[unit]") {
    const CastScene bust(test::bust(), {{0.0}});
    const CoordinateMaps maps = bust.maps();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const glm::dvec2 place :
         {glm::dvec2(-0.001, 80.0), {160.0, 80.0}, {80.0, -1e300}, {80.0, 160.0}, {nan, 80.0}, {80.0, nan}}) {
        CHECK_FALSE(maps.surface_at({0}, place));
        CHECK_FALSE(maps.part_near({0}, place));
    }
    Sight sight;
    Sight* const into = &sight;
    const ImagePlace nowhere{{0}, {nan, nan}};
    maps.look({&nowhere, 1}, {&into, 1});
    CHECK_FALSE(sight.outline_px);
}
