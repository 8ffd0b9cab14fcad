#include "experiment/maps/reconstruction.h"

#include <algorithm>
#include <tuple>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/maps/reconstruction_file.h"
#include "experiment/scene/files/mesh_reader.h"
#include "tests/support/cast_maps.h"
#include "tests/support/temporary_folder.h"

using namespace overt;
using test::CastScene;

namespace {

const std::vector<ObjectPose> three_angles{{0.0}, {25.0}, {-25.0}};

double area_of(const Reconstruction& made) {
    double area = 0.0;
    for (const glm::uvec3& t : made.triangles) {
        const glm::dvec3 a(made.positions[t.x]), b(made.positions[t.y]), c(made.positions[t.z]);
        area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return area;
}

} // namespace

TEST_CASE("a surface is never spanned from one part to another that it hides", "[unit]") {
    const CastScene balls(test::two_balls(), three_angles);
    const CoordinateMaps maps = balls.maps();
    for (int pose = 0; pose < 3; ++pose) {
        const Reconstruction made = reconstruct_surface(maps, {pose}, {160, 160});
        CHECK(made.triangles.size() > 5000);
        int across = 0;
        for (const glm::uvec3& t : made.triangles)
            across += made.parts[t.x] != made.parts[t.y] || made.parts[t.y] != made.parts[t.z];
        CHECK(across == 0);
    }
}

TEST_CASE("a reconstructed surface lies on the object, faces outwards, and has its area", "[unit]") {
    const double radius = 50.0;
    const CastScene ball(test::ball({3.0, 4.0, 5.0}, radius, 96, 192), {{0.0}}, {256, 256});
    const CoordinateMaps maps = ball.maps();
    const Reconstruction made = reconstruct_surface(maps, {0}, {256, 256});
    for (std::size_t i = 0; i < made.positions.size(); ++i) {
        const glm::dvec3 outwards = (glm::dvec3(made.positions[i]) - glm::dvec3(3.0, 4.0, 5.0)) / radius;
        REQUIRE(glm::length(outwards) == Approx(1.0).margin(2e-3));
        REQUIRE(glm::length(made.normals[i]) == Approx(1.0f).margin(1e-4));
        REQUIRE(glm::dot(glm::dvec3(made.normals[i]), outwards) > 0.5);
    }
    for (const glm::uvec3& t : made.triangles) {
        const glm::dvec3 a(made.positions[t.x]), b(made.positions[t.y]), c(made.positions[t.z]);
        REQUIRE(glm::dot(glm::cross(b - a, c - a), a - glm::dvec3(3.0, 4.0, 5.0)) > 0.0);
    }
    // What is seen of a ball is a cap; the last pixels at its rim are so steep that they hold some per cent.
    const double distance = glm::distance(ball.scene.view.camera.position, glm::dvec3(3.0, 4.0, 5.0));
    const double cap = 2.0 * 3.14159265358979 * radius * radius * (1.0 - radius / distance);
    CHECK(area_of(made) < cap);
    CHECK(area_of(made) > 0.9 * cap);
}

TEST_CASE("a cloud of several poses shows more than one, and each place once", "[unit]") {
    const CastScene balls(test::two_balls(), three_angles);
    const CoordinateMaps maps = balls.maps();
    const std::vector<PoseIndex> all{{0}, {1}, {2}};
    const double spacing = 2.0;
    const Reconstruction one = reconstruct_cloud(maps, std::span(all).first(1), {160, 160}, spacing);
    const Reconstruction cloud = reconstruct_cloud(maps, all, {160, 160}, spacing);
    CHECK(cloud.triangles.empty());
    CHECK(10 * cloud.positions.size() > 12 * one.positions.size());
    int seen_by_all = 0;
    for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
        REQUIRE(cloud.views[i] >= 1);
        REQUIRE(cloud.views[i] <= 3);
        seen_by_all += cloud.views[i] == 3;
    }
    CHECK(seen_by_all > 500);
    std::vector<glm::ivec3> cubes;
    for (const glm::vec3& position : cloud.positions)
        cubes.emplace_back(glm::floor(glm::dvec3(position) / spacing));
    std::sort(cubes.begin(), cubes.end(),
              [](glm::ivec3 a, glm::ivec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
    // Rounding to float moves a point across a cube's border now and then.
    const auto twice = cubes.end() - std::unique(cubes.begin(), cubes.end());
    CHECK(twice < 5);
}

TEST_CASE("the area never seen is that of the triangles that face away from all poses", "[unit]") {
    const CastScene ball(test::ball({0.0, 0.0, 0.0}, 50.0, 48, 96), three_angles);
    double away = 0.0, all = 0.0;
    for (const glm::uvec3& t : ball.mesh.triangles) {
        const glm::dvec3 a(ball.mesh.positions[t.x]), b(ball.mesh.positions[t.y]),
            c(ball.mesh.positions[t.z]);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        bool faces = false;
        for (const ObjectPose& angle : three_angles) {
            const glm::dvec3 eye =
                to_object({ball.scene.view.camera.position, {0.0, 1.0, 0.0}}, ball.scene.pose_at(angle))
                    .origin;
            faces = faces || glm::dot(normal, eye - a) > 0.0;
        }
        all += 0.5 * glm::length(normal);
        away += faces ? 0.0 : 0.5 * glm::length(normal);
    }
    // At a low resolution as well as at a high one: triangles that no pixel centre shows are asked one by
    // one.
    for (const int pixels : {40, 200}) {
        const CastScene at(test::ball({0.0, 0.0, 0.0}, 50.0, 48, 96), three_angles, {pixels, pixels});
        const SeenArea seen = seen_area(at.maps());
        CHECK(seen.area == Approx(all));
        CHECK(seen.never_seen == Approx(away).epsilon(0.01));
    }
}

TEST_CASE("PLY and OBJ files of a reconstruction read back as the same surface", "[unit]") {
    const test::TemporaryFolder folder;
    const CastScene balls(test::two_balls(), {{0.0}});
    const Reconstruction made = reconstruct_surface(balls.maps(), {0}, {160, 160});
    for (const char* name : {"surface.ply", "surface.obj"}) {
        const auto file = folder.path() / name;
        write_reconstruction(file, made, balls.mesh.part_names);
        MeshCleaningReport report;
        const Mesh mesh = import_mesh(file, {}, report);
        REQUIRE(mesh.triangles.size() == made.triangles.size());
        CHECK(mesh.area() == Approx(area_of(made)));
        const Bounds bounds = mesh.bounds();
        for (const glm::vec3& position : made.positions) {
            REQUIRE(glm::all(glm::greaterThanEqual(glm::dvec3(position), bounds.min)));
            REQUIRE(glm::all(glm::lessThanEqual(glm::dvec3(position), bounds.max)));
        }
    }
    CHECK_THROWS_AS(write_reconstruction(folder.path() / "surface.stl", made, balls.mesh.part_names),
                    InputError);
    CHECK_THROWS_AS(write_reconstruction(folder.path() / "none" / "a.ply", made, balls.mesh.part_names),
                    RecordError);
}
