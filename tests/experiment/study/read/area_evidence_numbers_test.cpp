/// The numbers of the estimate of looked-at areas are part of the method: they do not change unnoticed.
#include "experiment/study/read/area_evidence.h"

#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/maps/sight_lines.h"
#include "tests/support/cast_maps.h"

using namespace overt;

namespace {

/// Six trials of two poses, with as many fixations as differ: about the border of the head, some a little
/// beside the object, by a tracker that is less exact upwards.
std::vector<MeasuredPlace> places_about_neck(const test::CastScene& bust, double sigma_px) {
    std::vector<MeasuredPlace> places;
    RandomStream random(9, "places about a neck");
    for (int trial = 0; trial < 6; ++trial)
        for (int i = 0; i < 3 + 2 * trial; ++i) {
            const PoseIndex pose{(trial + i) % 3 == 0 ? 2 : 0};
            const SightLines lines(bust.scene, bust.angles[static_cast<std::size_t>(pose.value)]);
            const glm::dvec2 neck(lines.project({0.0, -55.0, 190.0}));
            places.push_back({pose, neck + glm::dvec2(40.0 * random.normal(), 60.0 * random.normal()),
                              sigma_px * glm::dvec2(1.0, 1.5), 7 + trial});
        }
    return places;
}

/// Fixations, those that tell nothing, and sums of the logarithms of their evidence, each fixation in its
/// own proportion.
struct Told {
    std::size_t fixations = 0, silent = 0;
    double inside = 0.0, elsewhere = 0.0;
};

Told told_of_head(const test::CastScene& bust, std::span<const MeasuredPlace> places) {
    const auto evidence =
        area_evidence(bust.mesh, Areas(bust.mesh.part_names), bust.scene, bust.angles, places);
    Told told{.fixations = evidence.size()};
    for (std::size_t i = 0; i < evidence.size(); ++i) {
        if (evidence[i].empty()) {
            ++told.silent;
            continue;
        }
        const double part = 1.0 / (3.0 + static_cast<double>(i));
        told.inside += part * std::log(evidence[i].at(1).inside + 1e-12);
        told.elsewhere += part * std::log(evidence[i].at(1).elsewhere + 1e-12);
    }
    return told;
}

} // namespace

TEST_CASE("the evidence of places about a border is what it was when the method was tried", "[unit]") {
    // The picture ends to the right of the middle and below, so that it does not show all of the object.
    test::CastScene bust{test::bust(), {{{-20.0}}, {{0.0}}, {{35.0}}}, {512, 512}, 0.06};
    bust.scene.view.image_px = {110, 420};
    struct Known {
        double sigma_px;
        Told told;
    };
    for (const Known& known : {Known{2.5, {48, 8, -47.0177284674, -35.794381454}},
                               Known{8.0, {48, 6, -39.6488234614, -37.9586234559}},
                               Known{30.0, {48, 0, -40.5158169828, -41.4549138154}}}) {
        CAPTURE(known.sigma_px);
        const Told told = told_of_head(bust, places_about_neck(bust, known.sigma_px));
        CHECK(told.fixations == known.told.fixations);
        CHECK(told.silent == known.told.silent);
        CHECK(told.inside == Approx(known.told.inside).epsilon(1e-8));
        CHECK(told.elsewhere == Approx(known.told.elsewhere).epsilon(1e-8));
    }
}

TEST_CASE("twenty fixations that tell are enough, of which none is only far from the object", "[unit]") {
    const test::CastScene bust{test::bust(), {{{0.0}}}, {256, 256}, 0.06};
    const SightLines lines(bust.scene, bust.angles[0]);
    std::vector<MeasuredPlace> places(20, {{0}, glm::dvec2(lines.project({0.0, -62.0, 245.0})), {6.0, 6.0}});
    const Areas areas(bust.mesh.part_names);
    const auto has_evidence = [&] {
        return !area_evidence(bust.mesh, areas, bust.scene, bust.angles, places)[0].empty();
    };
    CHECK(has_evidence());
    places[11].image_px = {3.0, 3.0};
    CHECK_FALSE(has_evidence());
    places.push_back(places[0]);
    CHECK(has_evidence());
}

TEST_CASE("errors of a trial lie in a hexagon of a grid, the middle one first among equals", "[unit]") {
    const std::span<const TrialError> errors = trial_errors();
    REQUIRE(errors.size() == 61);
    double farthest = 0.0, nearest = 10.0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const double away = glm::length(errors[i].sigmas);
        farthest = std::max(farthest, away);
        if (away > 0.0)
            nearest = std::min(nearest, away);
        CHECK(errors[i].probability <= errors[30].probability);
        // As normal as the middle one says, of the same width everywhere.
        CHECK(std::log(errors[30].probability / errors[i].probability) ==
              Approx(std::log(errors[30].probability / errors[29].probability) * away * away / 0.5625)
                  .margin(1e-9));
    }
    CHECK(farthest == Approx(3.0));
    CHECK(nearest == Approx(0.75));
    CHECK(glm::length(errors[30].sigmas) == 0.0);
}

TEST_CASE("shares of observers are one step of scoring by hand", "[unit]") {
    // At p = 1/2: slopes (3 - 1) / 2 = 1, (1 - 3) / 2 = -1, and of the last observer 1.2 and -1.2.
    const AreaEvidence in{3.0, 1.0}, out{1.0, 3.0}, more_in{0.8, 0.2}, more_out{0.2, 0.8}, silent{0.0, 0.0};
    const std::vector<std::vector<AreaEvidence>> observers{
        {in, in, silent, out}, {out, silent}, {more_in, more_out}, {silent}};
    const std::vector<double> shares = shares_of_observers(observers);
    REQUIRE(shares.size() == 3);
    const double mean_square = (4.0 * 1.0 + 2.0 * 1.44) / 6.0;
    CHECK(shares[0] == Approx(0.5 + 1.0 / (3.0 * (3.0 + 100.0 * mean_square) / 103.0)));
    CHECK(shares[1] == Approx(0.5 - 1.0 / ((1.0 + 100.0 * mean_square) / 101.0)));
    CHECK(shares[2] == Approx(0.5));
    // Nearer to an end than 0.02 each has its most probable share, a little farther away the step's.
    const auto of_counts = [&](int inside, int elsewhere) {
        std::vector<AreaEvidence> own(static_cast<std::size_t>(inside), AreaEvidence{1.0, 0.0});
        own.insert(own.end(), static_cast<std::size_t>(elsewhere), AreaEvidence{0.0, 1.0});
        return own;
    };
    for (const bool turned : {false, true}) {
        const auto shares_with = [&](int few) {
            return shares_of_observers(
                std::vector{turned ? of_counts(few, 1000 - few) : of_counts(1000 - few, few),
                            turned ? of_counts(0, 10) : of_counts(10, 0)});
        };
        CHECK(shares_with(15)[1] == (turned ? 0.0 : 1.0));
        CHECK(shares_with(30)[1] != (turned ? 0.0 : 1.0));
    }
}

TEST_CASE("the most probable share is found exactly, also beside either end", "[unit]") {
    for (const int inside : {1, 2, 50, 98, 99}) {
        std::vector<AreaEvidence> of(static_cast<std::size_t>(inside), AreaEvidence{0.3, 0.0});
        of.insert(of.end(), static_cast<std::size_t>(100 - inside), AreaEvidence{0.0, 7.0});
        of.push_back({0.0, 0.0});
        CHECK(*most_probable_share(of) == Approx(inside / 100.0).epsilon(1e-9));
    }
    // 2 / (1 + 2 p) = 1 / (2 - p) by hand: 4 - 2 p = 1 + 2 p.
    CHECK(*most_probable_share(std::array{AreaEvidence{3.0, 1.0}, AreaEvidence{1.0, 2.0}}) ==
          Approx(0.75).epsilon(1e-9));
}
