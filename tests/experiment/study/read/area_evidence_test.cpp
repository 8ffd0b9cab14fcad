/// How probable places are that were measured with an error, by hand, and the shares that follow from them.
#include "experiment/study/read/area_evidence.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/maps/sight_lines.h"
#include "tests/support/cast_maps.h"

using namespace overt;

namespace {

test::CastScene turned_bust() { return {test::bust(), {{{0.0}}, {{25.0}}, {{-25.0}}}, {512, 512}, 0.06}; }

double mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values)
        sum += value;
    return sum / static_cast<double>(values.size());
}

} // namespace

TEST_CASE("shares that were planted come back through an error that trials share", "[unit]") {
    const test::CastScene bust = turned_bust();
    RandomStream random(5, "planted shares");
    const std::array<double, 2> planted{0.2, 0.6}; // of either task
    constexpr double sigma_px = 12.0;
    std::vector<MeasuredPlace> places;
    std::array<double, 2> raw{};
    for (int trial = 0; trial < 40; ++trial) {
        const glm::dvec2 off = sigma_px * glm::dvec2(random.normal(), random.normal());
        for (int i = 0; i < 25; ++i) {
            const bool is_meant = i < 25 * planted[static_cast<std::size_t>(trial % 2)];
            const PoseIndex pose{static_cast<int>(random.below(3))};
            for (;;) {
                const glm::dvec2 place(random.uniform(0.0, 512.0), random.uniform(0.0, 512.0));
                const auto met = bust.hit(pose, place);
                if (!met || (bust.mesh.triangle_parts[met->triangle] == 1) != is_meant)
                    continue;
                places.push_back({pose, place + off, glm::dvec2(sigma_px), trial});
                const auto found = bust.hit(pose, place + off);
                raw[static_cast<std::size_t>(trial % 2)] +=
                    (found && bust.mesh.triangle_parts[found->triangle] == 1) / 500.0;
                break;
            }
        }
    }
    const auto evidence =
        area_evidence(bust.mesh, Areas(bust.mesh.part_names), bust.scene, bust.angles, places);
    for (const int task : {0, 1}) {
        std::vector<std::vector<AreaEvidence>> observers(10);
        for (std::size_t i = 0; i < places.size(); ++i)
            if (places[i].trial % 2 == task && !evidence[i].empty())
                observers[static_cast<std::size_t>(places[i].trial / 4)].push_back(evidence[i].at(1));
        CAPTURE(task, raw[static_cast<std::size_t>(task)]);
        CHECK(mean_of(shares_of_observers(observers)) ==
              Approx(planted[static_cast<std::size_t>(task)]).margin(0.04));
    }
}

TEST_CASE("shares of observers have no bias where single fixations tell little", "[unit]") {
    // Fixations of which the area is four times as probable as all else, or four times less: on the area 4 of
    // 5 are of the first kind, elsewhere 1 of 5. Of ten fixations each.
    RandomStream random(3, "shares of observers", 0);
    const auto study = [&](double share) {
        std::vector<std::vector<AreaEvidence>> observers(400);
        for (std::vector<AreaEvidence>& own : observers) {
            for (int i = 0; i < 10; ++i) {
                const bool is_inside = random.uniform() < share;
                const bool looks_inside = random.uniform() < (is_inside ? 0.8 : 0.2);
                own.push_back(looks_inside ? AreaEvidence{0.8, 0.2} : AreaEvidence{0.2, 0.8});
            }
        }
        return observers;
    };
    for (const double share : {0.1, 0.5, 0.8}) {
        const auto observers = study(share);
        CHECK(mean_of(shares_of_observers(observers)) == Approx(share).margin(0.03));
        if (share == 0.1) {
            std::vector<double> apart;
            for (const std::vector<AreaEvidence>& own : observers)
                apart.push_back(*most_probable_share(own));
            CHECK(mean_of(apart) > share + 0.04); // they end at 0
        }
    }
    CHECK(shares_of_observers({}).empty());
    // Where all look on the area, or nobody does, shares are 1 and 0, and nothing beyond.
    const std::vector<AreaEvidence> inside(12, {0.9, 0.02}), outside(12, {0.01, 0.8});
    CHECK(shares_of_observers(std::vector{inside, inside}) == std::vector{1.0, 1.0});
    CHECK(shares_of_observers(std::vector{outside, outside, outside}) == std::vector{0.0, 0.0, 0.0});
    // Who has nothing that tells has no share.
    const std::vector<std::vector<AreaEvidence>> two{{{2.0, 1.0}, {1.0, 2.0}}, {{0.0, 0.0}}};
    CHECK(shares_of_observers(two).size() == 1);
    CHECK(shares_of_observers(two).front() == Approx(0.5));
}

TEST_CASE("the errors that a trial may have are as wide as the tracker's, with the rest", "[unit]") {
    double sum = 0.0;
    glm::dvec2 mean_error(0.0), squares(0.0);
    for (const TrialError& error : trial_errors()) {
        sum += error.probability;
        mean_error += error.probability * error.sigmas;
        squares += error.probability * error.sigmas * error.sigmas;
    }
    CHECK(sum == Approx(1.0));
    CHECK(glm::length(mean_error) == Approx(0.0).margin(1e-12));
    for (const int axis : {0, 1})
        CHECK(squares[axis] + trial_error_rest * trial_error_rest == Approx(1.0));
}

TEST_CASE("the most probable share is that of the likelihood's peak", "[unit]") {
    CHECK_FALSE(most_probable_share({}));
    const std::vector<AreaEvidence> heads{{2.0, 0.0}, {1.0, 0.0}}, others{{0.0, 1.0}};
    CHECK(most_probable_share(heads) == 1.0);
    CHECK(most_probable_share(others) == 0.0);
    // Of counts without doubt it is their share; what says nothing of the part changes nothing.
    std::vector<AreaEvidence> mixed{{1.0, 0.0}, {3.0, 0.0}, {0.0, 5.0}, {0.0, 1.0}, {0.0, 2.0}};
    CHECK(*most_probable_share(mixed) == Approx(0.4));
    mixed.push_back({0.7, 0.7});
    CHECK(*most_probable_share(mixed) == Approx(0.4));
    // 1 / (1 + p) = 1 / (2 - p) for p in the middle; with weights 2 and 1 by hand: 2 (2 - p) = 1 + p.
    const std::vector<AreaEvidence> doubt{{2.0, 1.0}, {2.0, 1.0}, {1.0, 2.0}};
    CHECK(*most_probable_share(doubt) == Approx(1.0));
    const std::vector<AreaEvidence> even{{2.0, 1.0}, {1.0, 2.0}};
    CHECK(*most_probable_share(even) == Approx(0.5));
}

TEST_CASE("fixations far from the object, too few of them and objects of one part have no evidence",
          "[unit]") {
    const test::CastScene bust = turned_bust();
    const SightLines lines(bust.scene, bust.angles[0]);
    const glm::dvec2 head(lines.project({0.0, -62.0, 245.0})), body(lines.project({0.0, -45.0, 120.0}));
    std::vector<MeasuredPlace> places;
    for (int i = 0; i < 30; ++i)
        places.push_back({{0}, i % 3 == 0 ? head : body, {10.0, 10.0}});
    places.push_back({{0}, {5.0, 5.0}, {10.0, 10.0}});
    const Areas areas(bust.mesh.part_names);
    const auto evidence = area_evidence(bust.mesh, areas, bust.scene, bust.angles, places);
    REQUIRE(evidence.size() == 31);
    const auto of_head = [&](std::size_t i) { return evidence[i].at(1); };
    CHECK(of_head(0).inside > 1e3 * of_head(0).elsewhere);
    CHECK(of_head(1).elsewhere > 1e3 * of_head(1).inside);
    CHECK(evidence[30].empty());
    const auto few = area_evidence(bust.mesh, areas, bust.scene, bust.angles, std::span(places).first(19));
    CHECK(few.size() == 19);
    CHECK(few[0].empty());
    const std::vector<std::string> whole(3, "all of it");
    CHECK(area_evidence(bust.mesh, Areas(whole), bust.scene, bust.angles, places)[0].empty());
    CHECK(area_evidence(bust.mesh, Areas(), bust.scene, bust.angles, places)[0].empty());
}
