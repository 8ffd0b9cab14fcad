#include "experiment/attitude.h"

#include <catch2/catch.hpp>

using namespace overt;

TEST_CASE("an attitude and its normal are one", "[unit]") {
    for (const double slant : {0.5, 30.0, 89.0})
        for (const double tilt : {0.0, 45.0, 179.5, 270.0, 359.0}) {
            const Attitude back = attitude_of(3.0 * normal_of({{slant}, {tilt}}));
            CHECK(back.slant.value == Approx(slant));
            CHECK(back.tilt.value == Approx(tilt).margin(1e-9));
        }
    CHECK(attitude_of({0.0, 0.0, 1.0}).slant.value == 0.0);
    // To the right, upwards, to the left, downwards.
    CHECK(attitude_of({1.0, 0.0, 1.0}).tilt.value == Approx(0.0));
    CHECK(attitude_of({0.0, 1.0, 1.0}).tilt.value == Approx(90.0));
    CHECK(attitude_of({-1.0, 0.0, 1.0}).tilt.value == Approx(180.0));
    CHECK(attitude_of({0.0, -1.0, 1.0}).tilt.value == Approx(270.0));
    CHECK(attitude_of({0.0, -1.0, 1.0}).slant.value == Approx(45.0));
}

TEST_CASE("attitudes are averaged as unit normals", "[unit]") {
    const glm::dvec3 sum =
        normal_of({{10.0}, {350.0}}) + normal_of({{12.0}, {20.0}}) + normal_of({{14.0}, {5.0}});
    CHECK(attitude_of(sum).slant.value == Approx(11.758008).margin(1e-6));
    CHECK(attitude_of(sum).tilt.value == Approx(5.832240).margin(1e-6));
    CHECK(glm::length(sum) / 3.0 == Approx(0.998706).margin(1e-6));
}

TEST_CASE("the angle between attitudes goes over the top where that is shorter", "[unit]") {
    CHECK(angle_between({{20.0}, {0.0}}, {{20.0}, {180.0}}).value == Approx(40.0));
    CHECK(angle_between({{20.0}, {10.0}}, {{50.0}, {10.0}}).value == Approx(30.0));
    CHECK(angle_between({{0.0}, {10.0}}, {{0.0}, {200.0}}).value == Approx(0.0).margin(1e-9));
}

TEST_CASE("the frame of a line of sight points to the eye, and is the screen's in the middle", "[unit]") {
    const glm::dmat3 middle = frame_of_sight({0.0, 0.0, -7.0});
    CHECK(glm::distance(middle[0], glm::dvec3(1.0, 0.0, 0.0)) < 1e-12);
    CHECK(glm::distance(middle[1], glm::dvec3(0.0, 1.0, 0.0)) < 1e-12);
    const glm::dvec3 place(2.0, -1.0, -5.0);
    const glm::dmat3 aside = frame_of_sight(place);
    CHECK(glm::distance(aside[2], -glm::normalize(place)) < 1e-12);
    CHECK(glm::determinant(aside) == Approx(1.0));
    CHECK(aside[0].y == Approx(0.0).margin(1e-12)); // x stays level
}
