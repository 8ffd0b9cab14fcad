#include "experiment/analysis/gaze_cone.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "tests/support/cast_maps.h"

using namespace overt;
using test::CastScene;

namespace {

/// The picture stands in the middle of the screen, a pixel about 0.05 degrees wide.
ScreenGeometry screen_for(glm::ivec2 image_px) {
    ScreenGeometry screen;
    screen.screen_px = {400, 300};
    screen.screen_mm = {400.0, 300.0};
    screen.viewing_distance_mm = 1150.0;
    screen.image_px = image_px;
    screen.image_origin_px = centred_origin_px(screen.screen_px, image_px);
    return screen;
}

/// Remembers where it was asked.
class Witness final : public SurfaceLookup {
  public:
    std::optional<SurfacePoint> surface_at(PoseIndex, glm::dvec2 point) const override {
        asked.push_back(point);
        return SurfacePoint{};
    }
    bool goes_on(PoseIndex, glm::ivec2, glm::ivec2) const override { return true; }
    mutable std::vector<glm::dvec2> asked;
};

struct Probabilities {
    double object = 0.0, head = 0.0;
};

/// By chance and rays: normal angles about the gaze, drawn as two components on the plane that touches there.
Probabilities by_chance(const CastScene& scene, const ScreenGeometry& screen, PoseIndex pose,
                        ScreenPoint gaze, Degrees sigma, int draws) {
    RandomStream random(11, "directions");
    const glm::dvec3 towards =
        glm::normalize(glm::dvec3(gaze.x_px - 200.0, gaze.y_px - 150.0, screen.viewing_distance_mm));
    Probabilities found;
    for (int i = 0; i < draws; ++i) {
        // Any rotation about an axis square to the gaze, by an angle of that distribution.
        const glm::dvec2 error(random.normal(), random.normal());
        const double angle_rad = to_radians(sigma).value * glm::length(error);
        const glm::dvec3 any(error.x, error.y, 0.0);
        const glm::dvec3 side = glm::normalize(any - glm::dot(any, towards) * towards);
        const glm::dvec3 sight = std::cos(angle_rad) * towards + std::sin(angle_rad) * side;
        const glm::dvec2 on_screen =
            glm::dvec2(200.0, 150.0) + glm::dvec2(sight) / sight.z * screen.viewing_distance_mm;
        const glm::dvec2 place = screen.image_from_screen({on_screen.x, on_screen.y});
        if (!screen.is_inside_image(place))
            continue;
        if (const auto hit = scene.hit(pose, place)) {
            found.object += 1.0 / draws;
            found.head += scene.mesh.triangle_parts[hit->triangle] == 1 ? 1.0 / draws : 0.0;
        }
    }
    return found;
}

} // namespace

TEST_CASE("each direction of a cone stands in the middle of its share: a single one is off by the median",
          "[unit]") {
    const ScreenGeometry screen = screen_for({400, 300});
    const ScreenPoint gaze{200.0, 150.0};
    const Witness witness;
    GazeCone(screen, {0.7}, 1).shares(witness, {0}, gaze, 1);
    REQUIRE(witness.asked.size() == 1);
    // The mean of a Rayleigh distribution is sigma times the root of pi / 2, its median sigma times that of
    // ln 4.
    CHECK(screen.angle_between(gaze, screen.screen_from_image(witness.asked[0])).value ==
          Approx(0.7 * std::sqrt(2.0 / std::numbers::pi) * std::sqrt(std::log(4.0))).epsilon(1e-9));
}

TEST_CASE("a cone's directions are off by the accuracy on average, to all sides alike", "[unit]") {
    const ScreenGeometry screen = screen_for({400, 300});
    for (const ScreenPoint gaze : {ScreenPoint{200.0, 150.0}, {390.0, 12.0}, {30.5, 222.0}}) {
        const Witness witness;
        GazeCone(screen, {0.7}).shares(witness, {0}, gaze, 1);
        double sum_deg = 0.0;
        glm::dvec2 mean(0.0);
        for (const glm::dvec2 place : witness.asked) {
            sum_deg += screen.angle_between(gaze, screen.screen_from_image(place)).value;
            mean += place / static_cast<double>(witness.asked.size());
        }
        REQUIRE(witness.asked.size() == GazeCone::usual_directions);
        CHECK(sum_deg / GazeCone::usual_directions == Approx(0.7).epsilon(0.002));
        const ScreenPoint middle = screen.screen_from_image(mean);
        CHECK(screen.angle_between(gaze, middle).value < 0.005);
    }
}

TEST_CASE("a cone is as wide in degrees where pixels are wider than high", "[unit]") {
    ScreenGeometry screen = screen_for({400, 300});
    screen.screen_mm = {400.0, 150.0}; // pixels of 1 x 0.5 mm
    for (const ScreenPoint gaze : {ScreenPoint{200.0, 150.0}, {310.0, 260.0}}) {
        const Witness witness;
        GazeCone(screen, {0.7}).shares(witness, {0}, gaze, 1);
        double sum_deg = 0.0;
        glm::dvec2 mean(0.0), squares(0.0);
        for (const glm::dvec2 place : witness.asked) {
            sum_deg += screen.angle_between(gaze, screen.screen_from_image(place)).value;
            mean += place / static_cast<double>(witness.asked.size());
        }
        for (const glm::dvec2 place : witness.asked)
            squares += (place - mean) * (place - mean) / static_cast<double>(witness.asked.size());
        CHECK(sum_deg / GazeCone::usual_directions == Approx(0.7).epsilon(0.002));
        CHECK(screen.angle_between(gaze, screen.screen_from_image(mean)).value < 0.005);
        // As wide as high in millimetres, hence half as many pixels across.
        if (gaze.x_px == 200.0)
            CHECK(std::sqrt(squares.y / squares.x) == Approx(2.0).epsilon(0.02));
    }
}

TEST_CASE("a cone's probabilities are what drawing directions by chance and casting rays gives", "[unit]") {
    const CastScene balls(test::two_balls(), {{0.0}, {20.0}});
    const CoordinateMaps maps = balls.maps();
    const ScreenGeometry screen = screen_for({160, 160});
    const GazeCone cone(screen);
    RandomStream random(4, "gaze");
    double worst = 0.0, square_sum = 0.0;
    constexpr int gazes = 40, draws = 40000; // of 0.0025 standard deviation at most
    for (int i = 0; i < gazes; ++i) {
        const PoseIndex pose{i % 2};
        const ScreenPoint gaze =
            screen.screen_from_image({random.uniform(0.0, 160.0), random.uniform(0.0, 160.0)});
        const GazeCone::Shares shares = cone.shares(maps, pose, gaze, 2);
        CHECK(shares.of_part[0] + shares.of_part[1] == Approx(shares.of_object).margin(1e-12));
        const Probabilities expected = by_chance(balls, screen, pose, gaze, cone.sigma(), draws);
        for (const double off : {shares.of_object - expected.object, shares.of_part[1] - expected.head}) {
            worst = std::max(worst, std::abs(off));
            square_sum += off * off;
        }
    }
    CHECK(worst < 0.015);
    CHECK(std::sqrt(square_sum / (2 * gazes)) < 0.005);
}

TEST_CASE("a shrinking cone comes down to the look-up of the gaze itself", "[unit]") {
    const CastScene balls(test::two_balls(), {{0.0}});
    const CoordinateMaps maps = balls.maps();
    const ScreenGeometry screen = screen_for({160, 160});
    RandomStream random(5, "gaze");
    for (int i = 0; i < 300; ++i) {
        const glm::dvec2 place(random.uniform(0.0, 160.0), random.uniform(0.0, 160.0));
        const ScreenPoint gaze = screen.screen_from_image(place);
        const auto surface = maps.surface_at({0}, place);
        const auto points = GazeCone(screen, {1e-9}, 64).on_surface(maps, {0}, gaze);
        const GazeCone::Shares shares = GazeCone(screen, {0.0}, 64).shares(maps, {0}, gaze, 2);
        REQUIRE(points.size() == (surface ? 64u : 0u));
        REQUIRE(shares.of_object == (surface ? 1.0 : 0.0));
        if (!surface)
            continue;
        CHECK(shares.of_part[surface->part] == 1.0);
        for (const WeightedSurfacePoint& point : points)
            CHECK(glm::distance(point.point.position, surface->position) < 1e-5);
    }
}

TEST_CASE("the weights of a cone's surface points add up to the probability of the object", "[unit]") {
    const CastScene balls(test::two_balls(), {{0.0}});
    const CoordinateMaps maps = balls.maps();
    const ScreenGeometry screen = screen_for({160, 160});
    const GazeCone cone(screen, {1.0}, 500);
    RandomStream random(6, "gaze");
    for (int i = 0; i < 50; ++i) {
        const ScreenPoint gaze =
            screen.screen_from_image({random.uniform(0.0, 160.0), random.uniform(0.0, 160.0)});
        double sum = 0.0;
        for (const WeightedSurfacePoint& point : cone.on_surface(maps, {0}, gaze))
            sum += point.weight;
        CHECK(sum <= 1.0 + 1e-9);
        // Pixels and sub-pixel places differ along the outline only.
        CHECK(sum == Approx(cone.shares(maps, {0}, gaze, 2).of_object).margin(0.02));
    }
}
