#include "experiment/maps/map_check.h"
#include "render/gl/headless_context.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/maps/coordinate_maps.h"
#include "experiment/scene/triangle_order.h"
#include "render/stimulus/coordinate_pass.h"
#include "tests/support/figures.h"
#include "tests/support/gl_contexts.h"

using namespace overt;

namespace {

constexpr glm::ivec2 map_px{200, 160};
const std::vector<ObjectPose> map_angles{{0.0}, {25.0}, {-17.3}};

struct MappedFigure {
    Mesh mesh;
    SceneView scene;
};

MappedFigure figure_of(Mesh mesh, glm::ivec2 size = map_px) {
    MappedFigure figure{std::move(mesh), {}};
    order_for_drawing(figure.mesh);
    figure.scene.view.image_px = size;
    figure.scene.bounds = figure.mesh.bounds();
    figure.scene.view.camera = fit_camera(figure.mesh, {12.0}, size, {25.0}, 0.05);
    return figure;
}

/// A bust in front of a ball, in pieces that hide one another.
Mesh bust_and_ball() {
    Mesh mesh = test::bust();
    test::add_part(mesh, test::ball({60.0, -90.0, 150.0}, 40.0, 60, 120), "body");
    return mesh;
}

std::vector<TriangleMap> draw_maps(const MappedFigure& figure) {
    const auto context = make_headless_context(ContextKind::osmesa);
    CoordinatePass pass(*context, figure.scene.view.image_px);
    const MeshBuffers buffers(*context, figure.mesh);
    std::vector<TriangleMap> maps;
    for (const ObjectPose& angle : map_angles)
        maps.push_back({figure.scene.view.image_px, pass.draw(buffers, figure.scene, angle)});
    return maps;
}

std::vector<CoordinateImage> images_of(const MappedFigure& figure) {
    const CoordinateMaps maps(figure.mesh, figure.scene, map_angles, draw_maps(figure));
    std::vector<CoordinateImage> images;
    for (int pose = 0; pose < static_cast<int>(map_angles.size()); ++pose)
        images.push_back(coordinate_image(maps, {pose}, figure.scene.view.image_px));
    return images;
}

} // namespace

TEST_CASE("the drawn map holds what rays in double precision meet, within the rounding of a float", "[gl]") {
    for (const Mesh& mesh : {bust_and_ball(), test::ball({1000.0, -2000.0, 500.0}, 60.0, 200, 400)}) {
        const MappedFigure figure = figure_of(mesh);
        const RayCaster rays(figure.mesh);
        const std::vector<CoordinateImage> images = images_of(figure);
        for (std::size_t pose = 0; pose < map_angles.size(); ++pose) {
            const MapCheck check = check_map(images[pose], rays, figure.scene, map_angles[pose]);
            CHECK(check.covered_px > 4000);
            CHECK(check.interior_px > check.covered_px / 2);
            CHECK(check.coverage_differs_px <= 1);
            // Coordinates up to 2060 in a box of 120 are floats of 1.2e-4: 0.07 LSB. Near the origin less.
            CHECK(check.as_float.p99_9_lsb < 0.07);
            CHECK(check.as_codes.p99_9_lsb < 0.58);
            CHECK(check.farthest_off_surface < 1e-6);
        }
    }
}

TEST_CASE("16-bit codes of a map are off by the floor of rounding and no more", "[gl]") {
    const MappedFigure figure = figure_of(test::ball({3.0, 2.0, 1.0}, 60.0, 300, 600), {512, 512});
    const MapCheck check =
        check_map(images_of(figure)[1], RayCaster(figure.mesh), figure.scene, map_angles[1]);
    // The mean of the largest of three errors that are even within half a code is 3/8.
    CHECK(check.as_codes.mean_lsb == Approx(0.375).margin(0.002));
    CHECK(check.as_codes.p99_9_lsb < 0.51);
    CHECK(check.as_float.mean_lsb < 0.007);
}

TEST_CASE("no sound map exceeds what rounding allows, whatever its mesh and size", "[gl]") {
    // A box has faces along the axes, whose pixels have one rounding error all over: no mean of 0.375.
    Mesh slanted;
    test::add_part(slanted, test::box({-31.3, -20.7, 0.1}, {40.9, 33.3, 80.6}), "body");
    for (const Mesh& mesh :
         {test::bust(), bust_and_ball(), slanted, test::ball({3.0, 2.0, 1.0}, 60.0, 90, 180),
          test::ball({0.0, 0.0, 0.0}, 0.006, 40, 80)}) {
        for (const glm::ivec2 size : {glm::ivec2(64, 64), {200, 160}, {256, 256}, {420, 300}}) {
            const MappedFigure figure = figure_of(mesh, size);
            const RayCaster rays(figure.mesh);
            const std::vector<CoordinateImage> images = images_of(figure);
            for (std::size_t pose = 0; pose < map_angles.size(); ++pose) {
                const MapCheck check = check_map(images[pose], rays, figure.scene, map_angles[pose]);
                CAPTURE(size.x, pose, check.as_codes.mean_lsb, check.rounding_mean_lsb);
                CHECK(check.excess_lsb <= 2.0 * check.as_float.mean_lsb);
                CHECK(check.excess_lsb < 0.014);
                CHECK(check.as_codes.mean_lsb < 0.5 + 2.0 * 0.007);
            }
        }
    }
}

TEST_CASE("a map that is off by a quarter of a code exceeds what rounding allows", "[gl]") {
    const MappedFigure figure = figure_of(test::ball({3.0, 2.0, 1.0}, 60.0, 150, 300), {256, 256});
    const RayCaster rays(figure.mesh);
    const CoordinateImage sound = images_of(figure)[0];
    const glm::dvec3 code = (figure.scene.bounds.max - figure.scene.bounds.min) / 65536.0;
    const auto excess_of = [&](glm::vec3 codes_off) {
        CoordinateImage off = sound;
        for (glm::vec4& pixel : off.pixels)
            if (pixel.w != 0.0f)
                pixel += glm::vec4(codes_off * glm::vec3(code), 0.0f);
        return check_map(off, rays, figure.scene, map_angles[0]).excess_lsb;
    };
    CHECK(std::abs(excess_of({0.0f, 0.0f, 0.0f})) < 0.001);
    // By integrating 1 - F^3 with F(e) = min(2 e, e + 1/4), the distribution of |U(-1/2, 1/2) + 1/4|: the
    // mean of the largest of three is 0.5078; of one such and two that are centred 0.4219 - each less 3/8.
    CHECK(excess_of({0.25f, 0.25f, 0.25f}) == Approx(0.5078 - 0.375).margin(0.01));
    CHECK(excess_of({0.25f, 0.0f, 0.0f}) > 0.03);
    CHECK(excess_of({0.0f, 0.0f, -0.25f}) > 0.03);
}

TEST_CASE("the check finds a map that is shifted, turned, thinned or off the surface", "[gl]") {
    const MappedFigure figure = figure_of(bust_and_ball());
    const RayCaster rays(figure.mesh);
    const std::vector<CoordinateImage> images = images_of(figure);

    CoordinateImage shifted(map_px);
    for (int y = 0; y < map_px.y; ++y) {
        for (int x = 1; x < map_px.x; ++x)
            shifted.at(x, y) = images[0].at(x - 1, y);
    }
    const MapCheck shift = check_map(shifted, rays, figure.scene, map_angles[0]);
    CHECK(shift.as_float.mean_lsb > 100.0); // a pixel of 200 is some 400 LSB
    CHECK(shift.coverage_differs_px > 100);

    CHECK(check_map(images[0], rays, figure.scene, {0.1}).as_float.mean_lsb > 10.0);

    CoordinateImage thinned = images[0];
    int removed = 0;
    for (std::size_t i = 0; i < thinned.pixels.size() && removed < 7; ++i) {
        if (thinned.pixels[i].w != 0.0f) {
            thinned.pixels[i] = glm::vec4(0.0f);
            ++removed;
        }
    }
    const int before = check_map(images[0], rays, figure.scene, map_angles[0]).coverage_differs_px;
    CHECK(check_map(thinned, rays, figure.scene, map_angles[0]).coverage_differs_px >= before + 6);

    CoordinateImage lifted = images[0];
    const double lift = 1e-4 * figure.scene.bounds.diagonal();
    for (glm::vec4& pixel : lifted.pixels)
        pixel.y -= pixel.w * static_cast<float>(lift);
    CHECK(check_map(lifted, rays, figure.scene, map_angles[0]).farthest_off_surface ==
          Approx(1e-4).epsilon(0.05));
}

TEST_CASE("a map of half the size holds places of the same surface", "[gl]") {
    const MappedFigure whole = figure_of(bust_and_ball(), {400, 320});
    MappedFigure half = whole;
    half.scene.view.image_px = {200, 160};
    const std::vector<CoordinateImage> large = images_of(whole), small = images_of(half);
    const RayCaster rays(whole.mesh);
    CHECK(check_map(small[1], rays, half.scene, map_angles[1]).farthest_off_surface < 1e-6);
    int compared = 0;
    for (int y = 0; y < 160; ++y) {
        for (int x = 0; x < 200; ++x) {
            // A pixel of the small map is four of the large one; where all show one plane its place is their
            // mean, to within the perspective.
            if (!small[1].covers(x, y))
                continue;
            glm::vec4 sum(0.0f);
            for (const glm::ivec2 part : {glm::ivec2(0, 0), {1, 0}, {0, 1}, {1, 1}})
                sum += large[1].at(2 * x + part.x, 2 * y + part.y);
            const glm::dvec3 mean(sum / 4.0f), place(small[1].at(x, y));
            if (sum.w < 4.0f || glm::distance(mean, place) > 1e-3 * whole.scene.bounds.diagonal())
                continue;
            ++compared;
        }
    }
    CHECK(compared > 0.9 * static_cast<double>(small[1].covered_pixels()));
}

TEST_CASE("turned by nothing, the map's coordinates project to their own pixels", "[gl]") {
    const MappedFigure figure = figure_of(bust_and_ball());
    const CoordinateImage image = images_of(figure)[0];
    for (int y = 0; y < map_px.y; ++y) {
        for (int x = 0; x < map_px.x; ++x) {
            if (!image.covers(x, y))
                continue;
            const glm::dvec2 pixel = figure.scene.view.project(glm::dvec3(image.at(x, y)));
            REQUIRE(glm::distance(pixel, glm::dvec2(x + 0.5, y + 0.5)) < 1e-3);
        }
    }
}

TEST_CASE("the same place of the surface has the same code in every frame", "[gl]") {
    const MappedFigure figure = figure_of(bust_and_ball(), {600, 480});
    const std::vector<CoordinateImage> images = images_of(figure);
    const CoordinateCodec codec(figure.scene.bounds);
    const std::vector<TriangleMap> maps = draw_maps(figure);
    const CoordinateMaps lookup(figure.mesh, figure.scene, map_angles, maps);
    int compared = 0;
    for (int y = 0; y < 480; y += 5) {
        for (int x = 0; x < 600; x += 5) {
            if (!images[0].covers(x, y))
                continue;
            const auto here = lookup.surface_at({0}, {x + 0.5, y + 0.5});
            REQUIRE(here);
            const glm::dvec3 turned(figure.scene.pose_at(map_angles[1]).world_from_object() *
                                    glm::dvec4(here->position, 1.0));
            const auto there = lookup.surface_at({1}, figure.scene.view.project(turned));
            if (!there || there->triangle != here->triangle)
                continue; // it has turned away, or behind something
            ++compared;
            const glm::ivec3 one(codec.encode(here->position)), other(codec.encode(there->position));
            CHECK(glm::all(glm::lessThanEqual(glm::abs(one - other), glm::ivec3(1)))); // 1 on a tie
            CHECK(glm::distance(here->position, there->position) < 1e-9 * figure.scene.bounds.diagonal());
        }
    }
    CHECK(compared > 500);
}

TEST_CASE("meshes with degenerate and inverted faces are mapped like rays see them", "[gl]") {
    Mesh mesh = bust_and_ball();
    RandomStream random(3, "faces");
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (random.uniform(0, 1) < 0.3)
            std::swap(mesh.triangles[i].y, mesh.triangles[i].z);
        if (i % 50 == 0) { // a face without area beside the sound ones
            mesh.triangles.emplace_back(mesh.triangles[i].x, mesh.triangles[i].x, mesh.triangles[i].y);
            mesh.triangle_parts.push_back(0);
        }
    }
    const MappedFigure figure = figure_of(mesh);
    const RayCaster rays(figure.mesh);
    const std::vector<CoordinateImage> images = images_of(figure);
    for (std::size_t pose = 0; pose < map_angles.size(); ++pose) {
        const MapCheck check = check_map(images[pose], rays, figure.scene, map_angles[pose]);
        CHECK(check.coverage_differs_px <= 1);
        CHECK(check.as_float.p99_9_lsb < 0.04);
        CHECK(check.farthest_off_surface < 1e-6);
    }
}

TEST_CASE("a map of another size than the picture cannot be checked", "[unit]") {
    const MappedFigure figure = figure_of(test::bust());
    CHECK_THROWS_AS(check_map(CoordinateImage({10, 10}), RayCaster(figure.mesh), figure.scene, {0.0}),
                    InputError);
}

TEST_CASE("a camera inside the object, or with the object behind it, is an error and no empty map", "[gl]") {
    MappedFigure figure = figure_of(test::bust());
    figure.scene.view.camera.position = figure.scene.bounds.centre() + glm::dvec3(1.0, 0.0, 0.0);
    CHECK_THROWS_WITH(draw_maps(figure), Catch::Contains("stands inside"));
    figure.scene.view.camera.position = {0.0, -5000.0, 0.0};
    figure.scene.view.camera.target = {0.0, -6000.0, 0.0};
    CHECK_THROWS_WITH(draw_maps(figure), Catch::Contains("behind the camera"));
}
