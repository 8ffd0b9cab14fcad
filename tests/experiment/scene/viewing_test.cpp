#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiment/base/error.h"
#include "experiment/base/random.h"
#include "experiment/scene/viewing.h"
#include "tests/support/figures.h"

using namespace overt;

namespace {

Camera random_camera(RandomStream& random) {
    return {{random.uniform(-500.0, 500.0), random.uniform(-2500.0, -1500.0), random.uniform(-200.0, 600.0)},
            {random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0), random.uniform(100.0, 200.0)},
            {random.uniform(5.0, 60.0)}};
}

/// Of every third the camera of one of two eyes.
Camera random_eye(RandomStream& random, int i) {
    Camera camera = random_camera(random);
    camera.aside = i % 3 == 0 ? random.uniform(-60.0, 60.0) : 0.0;
    return camera;
}

glm::dvec3 random_point(RandomStream& random, double reach) {
    return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
}

/// The largest share of the half image that any point of the mesh takes at any angle up to the amplitude.
glm::dvec2 largest_extent(const Mesh& mesh, const View& view, Degrees amplitude) {
    glm::dvec2 largest(0.0);
    for (int step = -200; step <= 200; ++step) {
        const glm::dmat4 turn =
            TurntablePose{mesh.bounds().centre(), {amplitude.value * step / 200.0}}.world_from_object();
        for (const glm::vec3& position : mesh.positions) {
            const glm::dvec2 image = view.project(glm::dvec3(turn * glm::dvec4(position, 1.0)));
            largest = glm::max(largest, glm::abs(image / (0.5 * glm::dvec2(view.image_px)) - 1.0));
        }
    }
    return largest;
}

} // namespace

TEST_CASE("two eyes' cameras have their target in the middle, and what is beyond it farther apart",
          "[unit]") {
    RandomStream random(14, "viewing");
    for (int i = 0; i < 1000; ++i) {
        const View middle{random_camera(random), {1024, 600 + i}};
        View left = middle, right = middle;
        left.camera.aside = -random.uniform(5.0, 60.0);
        right.camera.aside = -left.camera.aside;
        const glm::dvec2 centre = 0.5 * glm::dvec2(middle.image_px);
        CHECK(glm::length(left.project(left.camera.target) - centre) < 1e-8);
        CHECK(glm::length(right.project(right.camera.target) - centre) < 1e-8);
        // The eyes stand level beside the middle, as far apart as is said, the right one to the right.
        const glm::dvec3 between = right.camera.eye() - left.camera.eye();
        CHECK(glm::length(between) == Approx(2.0 * right.camera.aside).epsilon(1e-12));
        CHECK(std::abs(between.z) < 1e-9);
        CHECK(glm::length(0.5 * (right.camera.eye() + left.camera.eye()) - middle.camera.position) < 1e-9);
        CHECK(middle.project(middle.camera.target + between).x > centre.x);
        const glm::dvec3 point = random_point(random, 150.0);
        const glm::dvec2 of_left = left.project(point), of_right = right.project(point);
        CHECK(of_left.y == Approx(of_right.y).margin(1e-8));
        CHECK(left.other_eye_right_px(point) == Approx(of_right.x - of_left.x).margin(1e-8));
        CHECK(right.other_eye_right_px(point) == Approx(of_left.x - of_right.x).margin(1e-8));
        CHECK(middle.other_eye_right_px(point) == 0.0);
        const double target_depth = middle.depth_of(middle.camera.target);
        CHECK((left.other_eye_right_px(point) > 0.0) == (left.depth_of(point) > target_depth));
        // By triangles: the eye's distance times what is missing of the depth.
        const double by_hand = 2.0 * right.camera.aside * middle.px_at_unit_depth() *
                               (1.0 / target_depth - 1.0 / middle.depth_of(point));
        CHECK(left.other_eye_right_px(point) == Approx(by_hand).margin(1e-8));
    }
}

TEST_CASE("a place of the image is where its own ray is seen", "[unit]") {
    RandomStream random(11, "viewing");
    for (int i = 0; i < 1000; ++i) {
        const View view{random_eye(random, i), {1024 + i, 768}};
        const glm::dvec2 place(random.uniform(-100.0, 1200.0), random.uniform(-100.0, 900.0));
        const Ray ray = view.ray_through(place);
        CHECK(glm::length(ray.direction) == Approx(1.0).epsilon(1e-14));
        const glm::dvec3 point = ray.origin + random.uniform(1.0, 5000.0) * ray.direction;
        CHECK(glm::length(view.project(point) - place) < 1e-8);
    }
}

TEST_CASE("the matrices for the graphics card put points where the projection does", "[unit]") {
    RandomStream random(12, "viewing");
    for (int i = 0; i < 1000; ++i) {
        const View view{random_eye(random, i), {1024, 600 + i}};
        const glm::dvec3 point = random_point(random, 150.0);
        const glm::dvec4 clip =
            view.clip_from_view(10.0, 10000.0) * view.view_from_world() * glm::dvec4(point, 1.0);
        const glm::dvec2 image(0.5 * (clip.x / clip.w + 1.0) * view.image_px.x,
                               0.5 * (1.0 - clip.y / clip.w) * view.image_px.y);
        CHECK(glm::length(view.project(point) - image) < 1e-7);
        CHECK(clip.w == Approx(view.depth_of(point)).epsilon(1e-12));
    }
}

TEST_CASE("an object that is not turned stays as it is", "[unit]") {
    CHECK(TurntablePose{{0.0, 0.0, 0.0}, {0.0}}.world_from_object() == glm::dmat4(1.0));
    const TurntablePose pose{{7.0, -3.0, 20.0}, {0.0}};
    RandomStream random(13, "viewing");
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 point = random_point(random, 100.0);
        CHECK(glm::length(glm::dvec3(pose.world_from_object() * glm::dvec4(point, 1.0)) - point) < 1e-12);
    }
}

TEST_CASE("an object turns counter-clockwise seen from above, about its own vertical", "[unit]") {
    const glm::dvec3 axis(5.0, -4.0, 9.0);
    const glm::dmat4 quarter = TurntablePose{axis, {90.0}}.world_from_object();
    const auto turned = [&](glm::dvec3 from_axis) {
        return glm::dvec3(quarter * glm::dvec4(axis + from_axis, 1.0)) - axis;
    };
    CHECK(glm::length(turned({1.0, 0.0, 0.0}) - glm::dvec3(0.0, 1.0, 0.0)) < 1e-14);
    CHECK(glm::length(turned({0.0, 1.0, 0.0}) - glm::dvec3(-1.0, 0.0, 0.0)) < 1e-14);
    CHECK(glm::length(turned({0.0, 0.0, 2.0}) - glm::dvec3(0.0, 0.0, 2.0)) < 1e-14);
}

TEST_CASE("a ray brought to the object and back is the same ray", "[unit]") {
    RandomStream random(14, "viewing");
    for (int i = 0; i < 1000; ++i) {
        const TurntablePose pose{random_point(random, 100.0), {random.uniform(-180.0, 180.0)}};
        const Ray ray{random_point(random, 2000.0), glm::normalize(random_point(random, 1.0))};
        const Ray in_object = to_object(ray, pose);
        const glm::dmat4 world_from_object = pose.world_from_object();
        const glm::dvec3 origin(world_from_object * glm::dvec4(in_object.origin, 1.0));
        const glm::dvec3 direction(world_from_object * glm::dvec4(in_object.direction, 0.0));
        CHECK(glm::length(origin - ray.origin) < 1e-9);
        CHECK(glm::length(direction - ray.direction) < 1e-14);
    }
}

TEST_CASE("a fitted camera keeps the turning object in the image and lets it touch the margin", "[unit]") {
    Mesh tall = test::bust();
    Mesh wide = tall;
    for (glm::vec3& position : wide.positions)
        position = position * glm::vec3(3.0f, 1.0f, 0.5f) + glm::vec3(900.0f, -400.0f, 70.0f);
    // Leaning to one side, so that turns to the left and to the right need different distances.
    Mesh left = tall, right = tall;
    for (glm::vec3& position : left.positions)
        position.y += 0.9f * position.x;
    for (glm::vec3& position : right.positions)
        position.y -= 0.9f * position.x;
    for (const Mesh& mesh : {tall, wide, left, right}) {
        for (const double amplitude : {0.0, 25.0, 60.0, 180.0}) {
            for (const glm::ivec2 image_px : {glm::ivec2(1024, 1024), glm::ivec2(640, 1080)}) {
                const double margin = 0.06;
                const View view{fit_camera(mesh, {12.0}, image_px, {amplitude}, margin), image_px};
                const glm::dvec2 extent = largest_extent(mesh, view, {amplitude});
                const double farthest = std::max(extent.x, extent.y);
                CHECK(farthest <= 1.0 - 2.0 * margin + 1e-9);
                // The sampled angles miss the extreme by up to a 400th of the turn.
                CHECK(farthest > 1.0 - 2.0 * margin - 1e-3);
            }
        }
    }
}

TEST_CASE("the depth range holds every point of the object at every turn", "[unit]") {
    const Mesh mesh = test::bust();
    for (const double height : {0.0, 800.0}) {
        View view{fit_camera(mesh, {12.0}, {1024, 1024}, {25.0}, 0.06), {1024, 1024}};
        view.camera.position.z += height;
        const DepthRange range = depth_range(mesh.bounds(), view);
        double nearest = range.far, farthest = range.near;
        for (int angle = -180; angle <= 180; ++angle) {
            const glm::dmat4 turn =
                TurntablePose{mesh.bounds().centre(), {double(angle)}}.world_from_object();
            for (const glm::vec3& position : mesh.positions) {
                const double depth = view.depth_of(glm::dvec3(turn * glm::dvec4(position, 1.0)));
                nearest = std::min(nearest, depth);
                farthest = std::max(farthest, depth);
            }
        }
        CHECK(range.near > 0.0);
        CHECK(nearest >= range.near);
        CHECK(farthest <= range.far);
    }
}

TEST_CASE("a camera inside the turning object or looking away from it is refused", "[unit]") {
    const Mesh mesh = test::bust();
    const Bounds bounds = mesh.bounds();
    const View inside{{bounds.centre() + glm::dvec3(0.0, -20.0, 0.0), bounds.centre(), {12.0}}, {64, 64}};
    CHECK_THROWS_AS(depth_range(bounds, inside), InputError);
    const glm::dvec3 far_away = bounds.centre() - glm::dvec3(0.0, 2000.0, 0.0);
    const View away{{far_away, far_away - glm::dvec3(0.0, 1.0, 0.0), {12.0}}, {64, 64}};
    CHECK_THROWS_AS(depth_range(bounds, away), InputError);
}
