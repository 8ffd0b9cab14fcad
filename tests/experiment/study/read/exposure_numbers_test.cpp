/// Exposure by hand, with unequal times, parts and units, and that of a figure as it was when it was tried.
#include "experiment/study/read/exposure.h"

#include <array>

#include <catch2/catch.hpp>

#include "tests/experiment/surface/flat_and_round.h"
#include "tests/support/cast_maps.h"

using namespace overt;

TEST_CASE("areas have their sizes, times and shares of the picture in the object's own millimetres",
          "[unit]") {
    // A triangle of 6 square units of the first part, one of 2 and one of 1 of the second, one of 3 of the
    // third, which has a corner of its own.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {0, 0, 1}, {0, 2, 1}, {4, -1.5, 0}, {9, 9, 9}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {0, 2, 3}, {0, 1, 5}};
    mesh.triangle_parts = {0, 1, 1, 2};
    mesh.part_names = {"foot", "hand", "nose"};
    Exposure exposure;
    exposure.seconds_visible = {1.0f, 2.0f, 0.0f, 4.0f, 0.0f, 5.0f, 7.0f};
    exposure.part_pixel_seconds = {10.0, 30.0, 60.0};
    const std::vector<ExposureRow> rows =
        exposure_rows({exposure, mesh, 2.0, 0.5}, 3, Areas(mesh.part_names));
    const auto area_of = [&](std::size_t triangle) {
        const glm::uvec3 t = mesh.triangles[triangle];
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        return 0.5 * glm::length(glm::cross(b - a, c - a)) * 4.0;
    };
    const double sheet = area_of(1), side = area_of(2);
    CHECK(area_of(0) == Approx(24.0));
    CHECK(side == Approx(6.0));
    REQUIRE(rows.size() == 4);
    const std::array<double, 4> areas{24.0 + sheet + side + 12.0, 24.0, sheet + side, 12.0};
    // Each corner has a third of its triangle.
    const std::array<double, 4> seconds{0.0, 24.0 * (1.0 + 2.0) / 3.0,
                                        (sheet * (4.0 + 5.0) + side * (1.0 + 4.0)) / 3.0,
                                        12.0 * (1.0 + 2.0 + 5.0) / 3.0};
    const std::array<double, 4> never{0.0, 8.0, (sheet + side) / 3.0, 0.0};
    const std::array<double, 4> pixels{100.0, 10.0, 30.0, 60.0};
    for (std::size_t i = 0; i < 4; ++i) {
        CAPTURE(i);
        const double own_seconds = i == 0 ? seconds[1] + seconds[2] + seconds[3] : seconds[i];
        const double own_never = i == 0 ? never[1] + never[2] + never[3] : never[i];
        CHECK(rows[i].object == 3);
        CHECK(rows[i].area == (i == 0 ? "" : mesh.part_names[i - 1]));
        CHECK(rows[i].area_mm2 == Approx(areas[i]));
        CHECK(rows[i].share_of_area == Approx(areas[i] / areas[0]));
        CHECK(rows[i].never_visible == Approx(own_never / areas[i]).margin(1e-12));
        CHECK(rows[i].seconds_visible == Approx(own_seconds / areas[i]));
        CHECK(rows[i].share_of_exposure == Approx(pixels[i] / 100.0));
        CHECK(rows[i].foreshortening.value() == Approx(pixels[i] * 0.5 / own_seconds));
    }
    // What nobody saw has no angle at which it was seen, and nothing of it is shared.
    exposure.seconds_visible.assign(7, 0.0f);
    exposure.part_pixel_seconds.assign(3, 0.0);
    for (const ExposureRow& row : exposure_rows({exposure, mesh, 2.0, 0.5}, 3, Areas(mesh.part_names))) {
        CHECK_FALSE(row.foreshortening);
        CHECK(row.never_visible == Approx(1.0));
        CHECK(row.share_of_exposure == 0.0);
        CHECK(row.seconds_visible == 0.0);
    }
    // Areas of which the mesh has no triangle have no share.
    mesh.triangle_parts = {0, 0, 0, 0};
    const auto without = exposure_rows({exposure, mesh, 2.0, 0.5}, 3, Areas(mesh.part_names));
    CHECK(without[2].area_mm2 == 0.0);
    CHECK(without[2].never_visible == 0.0);
    CHECK(without[2].share_of_area == 0.0);
}

TEST_CASE("what of figures is visible is what it was when it was tried, pose by pose", "[unit]") {
    struct Known {
        Mesh mesh;
        double visible, pixels, first_part, second_part;
    };
    std::vector<ObjectPose> poses;
    for (int pose = 0; pose < 11; ++pose)
        poses.push_back({{-50.0 + 10.0 * pose}});
    for (const Known& known : {Known{test::bust(), 29571.875, 7797.9581351988, 1854.0, 705.875},
                               Known{test::two_balls(), 32446.0, 8745.2501864061, 2558.0, 350.75}}) {
        test::CastScene scene(known.mesh, poses, {45, 35}, 0.05);
        // A part of the figure is beside the picture.
        scene.scene.view.image_px = {12, 28};
        const CoordinateMaps maps = scene.maps();
        const Exposure all =
            exposure_of(maps, std::array{0.5, 1.0, 0.0, 2.0, 0.25, 1.0, 1.0, 0.0, 3.0, 0.125, 4.0});
        double visible = 0.0, pixels = 0.0;
        for (std::size_t v = 0; v < all.seconds_visible.size(); ++v) {
            visible += static_cast<double>(1 + v % 7) * static_cast<double>(all.seconds_visible[v]);
            pixels += static_cast<double>(1 + v % 5) * all.pixel_seconds[v];
        }
        CAPTURE(known.mesh.positions.size(), visible, pixels, all.part_pixel_seconds);
        CHECK(visible == known.visible);
        CHECK(pixels == Approx(known.pixels));
        CHECK(all.part_pixel_seconds[0] == known.first_part);
        CHECK(all.part_pixel_seconds[1] == known.second_part);
    }
}
