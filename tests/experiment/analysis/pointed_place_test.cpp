/// Pointing carried onto the surface, against rays.
#include "experiment/analysis/pointed_place.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "tests/support/cast_maps.h"

using namespace overt;
using test::CastScene;

namespace {

/// A wall that is turned so far away from the camera, about the vertical and then tipped.
Mesh turned_wall(double turned_deg, double tipped_deg) {
    const double turn = turned_deg * std::numbers::pi / 180.0, tip = tipped_deg * std::numbers::pi / 180.0;
    const glm::dvec3 along(std::cos(turn), std::sin(turn), 0.0),
        up(-std::sin(tip) * std::sin(turn), std::sin(tip) * std::cos(turn), std::cos(tip));
    Mesh mesh;
    for (const glm::dvec2 corner :
         {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)})
        mesh.positions.emplace_back(100.0 * (corner.x * along + corner.y * up));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.triangle_parts = {0, 0};
    mesh.part_names = {"body"};
    return mesh;
}

/// Of where rays meet the mesh that go through places normally distributed about one.
glm::dmat3 covariance_by_rays(const CastScene& scene, PoseIndex pose, glm::dvec2 place,
                              const glm::dmat2& covariance) {
    RandomStream random(5, "places about one");
    // The lower triangular root of a covariance.
    const double a = std::sqrt(covariance[0][0]), b = covariance[0][1] / a,
                 c = std::sqrt(covariance[1][1] - b * b);
    glm::dvec3 sum(0.0);
    glm::dmat3 squares(0.0);
    constexpr int draws = 40000;
    const glm::dvec3 about = scene.hit(pose, place).value().position;
    for (int i = 0; i < draws; ++i) {
        const double first = random.normal(), second = random.normal();
        const auto hit = scene.hit(pose, place + glm::dvec2(a * first, b * first + c * second));
        if (!hit)
            return glm::dmat3(0.0); // which no footprint is
        const glm::dvec3 off = hit->position - about;
        sum += off;
        squares += glm::outerProduct(off, off);
    }
    const glm::dvec3 mean = sum / static_cast<double>(draws);
    return squares / static_cast<double>(draws) - glm::outerProduct(mean, mean);
}

double share_that_differs(const glm::dmat3& a, const glm::dmat3& b) {
    double most = 0.0, largest = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            most = std::max(most, std::abs(a[i][j] - b[i][j]));
            largest = std::max(largest, std::abs(a[i][j]));
        }
    return most / largest;
}

} // namespace

TEST_CASE("the footprint of an error on the surface is what rays through the picture's places have",
          "[unit]") {
    // An error that is longer in one direction of the picture, which is neither of its axes.
    const glm::dmat2 covariance(0.30, 0.12, 0.12, 0.10);
    for (const glm::dvec2 turned : {glm::dvec2(0.0, 0.0), glm::dvec2(50.0, 0.0), glm::dvec2(-30.0, 40.0)}) {
        CAPTURE(turned.x, turned.y);
        const CastScene scene(turned_wall(turned.x, turned.y), {{0.0}, {20.0}});
        for (const PoseIndex pose : {PoseIndex{0}, PoseIndex{1}}) {
            const SightLines lines(scene.scene, scene.angles[static_cast<std::size_t>(pose.value)]);
            const glm::dvec2 place(83.3, 71.9);
            const auto hit = scene.hit(pose, place);
            REQUIRE(hit);
            const auto footprint =
                footprint_of(lines, place, corners_of(scene.mesh, hit->triangle), covariance);
            REQUIRE(footprint);
            // 40,000 draws give a variance to within 0.7 % (sqrt(2 / n)); four times that, and what the
            // perspective within the footprint adds.
            CHECK(share_that_differs(footprint->covariance,
                                     covariance_by_rays(scene, pose, place, covariance)) < 0.035);
            // The axes are those of the covariance: their squares add up to its trace, and there is nothing
            // along the normal.
            const glm::dmat3& c = footprint->covariance;
            CHECK(std::pow(footprint->largest_sd, 2) + std::pow(footprint->smallest_sd, 2) ==
                  Approx(c[0][0] + c[1][1] + c[2][2]));
            const auto corners = corners_of(scene.mesh, hit->triangle);
            const glm::dvec3 normal =
                glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
            CHECK(std::abs(glm::dot(normal, c * normal)) < 1e-9 * footprint->largest_sd);
        }
    }
}

TEST_CASE("a wall that is seen obliquely has a footprint as much longer as it is oblique", "[unit]") {
    const CastScene scene(turned_wall(60.0, 0.0), {{0.0}});
    const SightLines lines(scene.scene, {0.0});
    const glm::dvec2 middle = 0.5 * glm::dvec2(scene.scene.view.image_px);
    const auto hit = scene.hit({0}, middle);
    REQUIRE(hit);
    const auto footprint =
        footprint_of(lines, middle, corners_of(scene.mesh, hit->triangle), covariance_of_pixel());
    REQUIRE(footprint);
    const double pixel = lines.pixel_width_at(lines.project(hit->position).z);
    CHECK(footprint->smallest_sd == Approx(pixel / std::sqrt(12.0)).epsilon(1e-6));      // corners are floats
    CHECK(footprint->largest_sd == Approx(2.0 * pixel / std::sqrt(12.0)).epsilon(1e-6)); // 1 / cos(60°)
    // Edge on, and without an area, there is none.
    CHECK_FALSE(footprint_of(lines, middle, {glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)},
                             covariance_of_pixel()));
}

TEST_CASE("an error of gaze covers the screen as its visual angle does", "[unit]") {
    ScreenGeometry screen;
    screen.screen_px = {1600, 1200};
    screen.screen_mm = {400.0, 360.0}; // pixels that are not square
    screen.viewing_distance_mm = 500.0;
    const Degrees sigma{0.02};
    for (const ScreenPoint gaze :
         {ScreenPoint{800.0, 600.0}, ScreenPoint{1500.0, 600.0}, ScreenPoint{1400.0, 100.0}}) {
        CAPTURE(gaze.x_px, gaze.y_px);
        const glm::dmat2 covariance = covariance_of_gaze(screen, gaze, sigma);
        // Every place on the ellipse is one sigma away.
        const double a = std::sqrt(covariance[0][0]), b = covariance[0][1] / a,
                     c = std::sqrt(covariance[1][1] - b * b);
        for (double turn = 0.0; turn < 6.2; turn += 0.7)
            CHECK(screen
                      .angle_between(gaze, {gaze.x_px + a * std::cos(turn),
                                            gaze.y_px + b * std::cos(turn) + c * std::sin(turn)})
                      .value == Approx(sigma.value).epsilon(2e-3));
    }
}
