#include "render/gl/headless_context.h"
#include "render/stimulus/coordinate_pass.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/maps/coordinate_maps.h"
#include "experiment/scene/ray_caster.h"
#include "experiment/scene/triangle_order.h"
#include "tests/support/figures.h"
#include "tests/support/gl_contexts.h"

using namespace overt;

namespace {

constexpr glm::ivec2 image_px{160, 160};
const std::vector<ObjectPose> angles{{0.0}, {25.0}, {-13.7}};

struct Figure {
    Mesh mesh;
    SceneView scene;
};

/// Two balls that hide each other in part, one labelled as the head; far from the origin, as scans often are.
Figure two_balls() {
    Figure figure;
    test::add_part(figure.mesh, test::ball({1000.0, -2000.0, 500.0}, 60.0), "body");
    test::add_part(figure.mesh, test::ball({1020.0, -2075.0, 560.0}, 25.0), "head");
    order_for_drawing(figure.mesh);
    figure.scene.view.image_px = image_px;
    figure.scene.bounds = figure.mesh.bounds();
    figure.scene.view.camera = fit_camera(figure.mesh, {12.0}, image_px, {25.0}, 0.05);
    return figure;
}

std::vector<TriangleMap> draw_maps(const Figure& figure, ContextKind kind) {
    const auto context = make_headless_context(kind);
    CoordinatePass pass(*context, image_px);
    const MeshBuffers buffers(*context, figure.mesh);
    std::vector<TriangleMap> maps;
    for (const ObjectPose& angle : angles)
        maps.push_back({image_px, pass.draw(buffers, figure.scene, angle)});
    return maps;
}

} // namespace

TEST_CASE("the hidden map covers what rays through the pixel centres meet, and shows the same triangles",
          "[gl]") {
    const Figure figure = two_balls();
    const std::vector<TriangleMap> maps = draw_maps(figure, ContextKind::osmesa);
    const RayCaster rays(figure.mesh);
    for (std::size_t pose = 0; pose < angles.size(); ++pose) {
        int covered = 0, coverage_differs = 0, triangle_differs = 0;
        for (int y = 0; y < image_px.y; ++y) {
            for (int x = 0; x < image_px.x; ++x) {
                const Ray ray = figure.scene.view.ray_through({x + 0.5, y + 0.5});
                const auto hit = rays.first_hit(to_object(ray, figure.scene.pose_at(angles[pose])));
                const std::uint32_t code = maps[pose].code_at(x, y);
                covered += hit.has_value();
                coverage_differs += hit.has_value() != (code != 0);
                triangle_differs += hit && code != 0 && hit->triangle + 1 != code;
            }
        }
        CHECK(covered > 3000);
        // OpenGL snaps corners to 1/256 of a pixel, so a pixel whose centre lies on an edge may fall to
        // either side.
        CHECK(coverage_differs <= 2);
        CHECK(triangle_differs <= covered / 100);
    }
}

TEST_CASE("OSMesa and EGL draw the same map, bit for bit", "[gl]") {
    const Figure figure = two_balls();
    const std::vector<TriangleMap> osmesa = draw_maps(figure, ContextKind::osmesa);
    for (const ContextKind kind : test::headless_kinds) {
        const std::vector<TriangleMap> maps = draw_maps(figure, kind);
        const auto context = make_headless_context(kind);
        if (!context->description().is_software)
            continue; // a graphics processor rasterises by its own rules
        for (std::size_t pose = 0; pose < angles.size(); ++pose)
            CHECK(maps[pose].codes == osmesa[pose].codes);
    }
}

TEST_CASE("a look-up between pixel centres gives the point that a ray through the same place meets", "[gl]") {
    const Figure figure = two_balls();
    const CoordinateMaps maps(figure.mesh, figure.scene, angles, draw_maps(figure, ContextKind::osmesa));
    const RayCaster rays(figure.mesh);
    RandomStream random(7, "places in the image");
    const double diagonal = figure.mesh.bounds().diagonal();
    int both = 0, only_one = 0, far_apart = 0;
    for (int i = 0; i < 20000; ++i) {
        const PoseIndex pose{i % 3};
        const glm::dvec2 place(random.uniform(0.0, image_px.x), random.uniform(0.0, image_px.y));
        const auto hit =
            rays.first_hit(to_object(figure.scene.view.ray_through(place),
                                     figure.scene.pose_at(angles[static_cast<std::size_t>(pose.value)])));
        const auto surface = maps.surface_at(pose, place);
        only_one += hit.has_value() != surface.has_value();
        if (!hit || !surface)
            continue;
        ++both;
        const double apart = glm::distance(hit->position, surface->position);
        if (apart > 1e-9 * diagonal) {
            ++far_apart;
            continue;
        }
        CHECK(surface->part == figure.mesh.triangle_parts[hit->triangle]);
        CHECK(surface->depth ==
              Approx(figure.scene.view.depth_of(glm::dvec3(
                  figure.scene.pose_at(angles[static_cast<std::size_t>(pose.value)]).world_from_object() *
                  glm::dvec4(hit->position, 1.0)))));
    }
    CHECK(both > 4000);
    // Slivers of surface between pixel centres may be missed at the silhouettes.
    CHECK(only_one <= 20);
    CHECK(far_apart <= both / 500);
}

TEST_CASE("a surface point has the same coordinates in every pose", "[gl]") {
    const Figure figure = two_balls();
    const CoordinateMaps maps(figure.mesh, figure.scene, angles, draw_maps(figure, ContextKind::osmesa));
    int found = 0;
    for (int y = 0; y < image_px.y; y += 3) {
        for (int x = 0; x < image_px.x; x += 3) {
            const auto seen = maps.surface_at({0}, {x + 0.3, y + 0.8});
            if (!seen)
                continue;
            for (int pose = 1; pose < 3; ++pose) {
                const glm::dvec3 turned(
                    figure.scene.pose_at(angles[static_cast<std::size_t>(pose)]).world_from_object() *
                    glm::dvec4(seen->position, 1.0));
                const auto again = maps.surface_at({pose}, figure.scene.view.project(turned));
                // It may have turned away or behind the other ball.
                if (!again || again->triangle != seen->triangle)
                    continue;
                ++found;
                CHECK(glm::distance(again->position, seen->position) <
                      1e-9 * figure.mesh.bounds().diagonal());
            }
        }
    }
    CHECK(found > 500);
}

TEST_CASE("a map of another size or of another mesh is refused", "[gl]") {
    const Figure figure = two_balls();
    std::vector<TriangleMap> maps = draw_maps(figure, ContextKind::osmesa);
    SceneView other_size = figure.scene;
    other_size.view.image_px = {80, 80};
    CHECK_THROWS_AS(CoordinateMaps(figure.mesh, other_size, angles, maps), InputError);
    maps[1].codes[5] = static_cast<std::uint32_t>(figure.mesh.triangles.size()) + 1;
    CHECK_THROWS_WITH(CoordinateMaps(figure.mesh, figure.scene, angles, maps),
                      Catch::Contains("another mesh"));
}
