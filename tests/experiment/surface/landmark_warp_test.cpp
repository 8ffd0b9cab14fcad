#include "experiment/surface/landmark_warp.h"

#include <array>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"

using namespace overt;

namespace {

using Places = std::vector<glm::dvec3>;

const Places cornered{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {0, 0, 2}, {4, 3, 2}, {1, 2, 1}};
const Places bent{{1, 0, 0}, {5, 1, 0}, {1, 4, 0}, {0, 0, 3}, {6, 4, 3}, {2, 2, 2}};

double off(const glm::dvec3& found, const glm::dvec3& wanted) { return glm::distance(found, wanted); }

Places moved(const Places& places, const glm::dmat3& by, const glm::dvec3& shift) {
    Places found;
    for (const glm::dvec3& place : places)
        found.push_back(by * place + shift);
    return found;
}

/// What is said of landmarks that make no warp; empty if they do.
std::string refused(const Places& from, const Places& to) {
    try {
        const LandmarkWarp warp(from, to);
        return {};
    } catch (const InputError& error) {
        return error.what();
    }
}

} // namespace

TEST_CASE("a thin plate in space has the values that SciPy finds", "[unit]") {
    const LandmarkWarp warp(cornered, bent);
    CHECK(warp.kind() == LandmarkWarp::Kind::thin_plate);
    for (std::size_t i = 0; i < cornered.size(); ++i)
        CHECK(off(warp(cornered[i]), bent[i]) < 1e-12);
    // RBFInterpolator(from, to, kernel="linear", degree=1) of SciPy 1.10; scale and what is left out from the
    // same equations solved by NumPy.
    CHECK(off(warp({1, 1, 1}), {1.817771609159936, 1.066627384611384, 1.7683651081064864}) < 1e-12);
    CHECK(off(warp({-2, 5, 0.5}), {-0.868816290617126, 5.964683258164123, 0.7585436653583302}) < 1e-12);
    CHECK(off(warp({10, -3, 7}), {10.411629738404429, -3.003237368179103, 10.535566874232668}) < 1e-11);
    CHECK(warp.scale() == Approx(1.2850455540120744).epsilon(1e-12));
    CHECK(warp.left_out().value() == Approx(1.6791849006715107).epsilon(1e-10));
}

TEST_CASE("what is stretched alike everywhere is stretched so everywhere, and each landmark tells the others",
          "[unit]") {
    const glm::dmat3 stretched(glm::dvec3(2.0, 0.1, 0.0), glm::dvec3(0.0, 3.0, 0.2),
                               glm::dvec3(0.3, 0.0, 0.5));
    const glm::dvec3 shift(100.0, -20.0, 7.0);
    const LandmarkWarp warp(cornered, moved(cornered, stretched, shift));
    for (const glm::dvec3& place : {glm::dvec3(-40.0, 3.0, 9.0), glm::dvec3(0.3, 0.4, 0.5)})
        CHECK(off(warp(place), stretched * place + shift) < 1e-10);
    CHECK(warp.scale() == Approx(std::cbrt(glm::determinant(stretched))).epsilon(1e-12));
    CHECK(warp.left_out().value() < 1e-10);
    // Lengths of another unit change nothing.
    const Places in_um = moved(cornered, glm::dmat3(1000.0), {});
    CHECK(off(LandmarkWarp(in_um, bent)({1000, 1000, 1000}), LandmarkWarp(cornered, bent)({1, 1, 1})) < 1e-9);
}

TEST_CASE("three landmarks turn, scale and shift, and so do many in a plane", "[unit]") {
    // A quarter turn about z, twice as large.
    const glm::dmat3 turned(glm::dvec3(0.0, 2.0, 0.0), glm::dvec3(-2.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, 2.0));
    const Places three{{0, 0, 0}, {5, 0, 0}, {0, 3, 0}};
    const Places five{{0, 0, 1}, {5, 0, 1}, {0, 3, 1}, {5, 3, 1}, {2, 2, 1}};
    for (const Places& places : {three, five}) {
        const LandmarkWarp warp(places, moved(places, turned, {1, 1, 1}));
        CHECK(warp.kind() == LandmarkWarp::Kind::similarity);
        CHECK(off(warp({1, 2, 3}), {-3, 3, 7}) < 1e-12);
        CHECK(warp.scale() == Approx(2.0).epsilon(1e-12));
        CHECK(warp.left_out().has_value() == (places.size() > 3));
    }
    // Four landmarks make a plate, of which none can be left out.
    const Places four{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {0, 0, 2}};
    CHECK(LandmarkWarp(four, four).kind() == LandmarkWarp::Kind::thin_plate);
    CHECK_FALSE(LandmarkWarp(four, four).left_out());
    // Of landmarks that cannot all be reached the squares are least: by hand, half of the distance each.
    const Places line{{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    Places longer = line;
    longer[0].x = -2.0;
    longer[1].x = 2.0;
    CHECK(LandmarkWarp(line, longer).scale() == Approx(1.5).epsilon(1e-12));
    CHECK(off(LandmarkWarp(line, longer)({1, 0, 0}), {1.5, 0, 0}) < 1e-12);
}

TEST_CASE("landmarks that make no warp are refused with the reason", "[unit]") {
    CHECK(
        refused({{0, 0, 0}}, {{0, 0, 0}}) ==
        "1 of them corresponds: it takes three at least, and four that do not lie in a plane for a warp that "
        "bends");
    CHECK(refused({}, {}).starts_with("0 of them correspond:"));
    CHECK(refused({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}},
                  {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) == "they lie on a line: add some beside it");
    CHECK(refused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 0}, {1, 0, 0}, {2, 0.001, 0}}) ==
          "they lie on a line: add some beside it");
    CHECK(refused({{3, 0, 0}, {1, 0, 0}, {0, 1, 0}, {3, 0, 0}},
                  cornered.empty() ? Places() : Places(bent.begin(), bent.begin() + 4)) ==
          "landmarks 1 and 4 lie at one place of the object");
    CHECK(refused(Places(bent.begin(), bent.begin() + 3), {{3, 0, 0}, {1, 0, 0}, {1, 0, 0}}) ==
          "landmarks 2 and 3 lie at one place of the template");
    // Left and right exchanged.
    Places mirrored = cornered;
    for (glm::dvec3& place : mirrored)
        place.x = -place.x;
    CHECK(
        refused(cornered, mirrored) ==
        "they turn the object inside out: left and right, or front and back, were exchanged on one of both");
}
