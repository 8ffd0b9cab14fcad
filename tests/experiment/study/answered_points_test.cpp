/// Places that were pointed at on a ball whose answers are placed by hand.
#include "experiment/study/answered_points.h"

#include <algorithm>

#include <catch2/catch.hpp>
#include <glm/glm.hpp>

#include "tests/experiment/study/painted_study.h"

using namespace overt;

namespace {

test::PaintedStudy ball_alone() {
    return test::PaintedStudy(1, 1, 0, [](int, int, RandomStream&) { return test::front; });
}

void point_at(StudyResults& results, const std::string& observer, int trial, const std::string& answer,
              std::optional<glm::dvec3> place) {
    AnsweredPointRow& row = results.points.given.emplace_back();
    row.of = {observer, "grasp", answer, 0};
    row.session = observer == "b" ? 1 : 0;
    row.trial = trial;
    row.place = place;
    if (place)
        row.part = place->z > 70.0 ? 1 : 0;
    row.part_name = !place ? "" : place->z > 70.0 ? "head" : "body";
}

/// On the ball of radius 100, evenly.
glm::dvec3 anywhere(RandomStream& random) {
    const glm::dvec3 towards(random.normal(), random.normal(), random.normal());
    return 100.0 * glm::normalize(towards);
}

const PointSpreadRow& spread_of(const StudyResults& results, const std::string& observer,
                                const std::string& answer = "clicked") {
    const auto row = std::ranges::find_if(results.points.spreads, [&](const PointSpreadRow& one) {
        return one.of.observer == observer && one.of.answer == answer;
    });
    REQUIRE(row != results.points.spreads.end());
    return *row;
}

} // namespace

TEST_CASE("places that are drawn evenly are as far apart as chance has it, and all in one place are not",
          "[unit]") {
    test::PaintedStudy study = ball_alone();
    RandomStream random(3, "points");
    for (int observer = 0; observer < 40; ++observer) {
        for (int trial = 1; trial <= 5; ++trial)
            point_at(study.results, fmt::format("{:02}", observer), trial, "clicked", anywhere(random));
        point_at(study.results, fmt::format("{:02}", observer), 1, "same", 100.0 * test::front);
    }
    reckon_points(study.results, study.options);
    // Two places drawn evenly from a sphere of radius r are 4 r / 3 apart in the mean.
    const PointSpreadRow& evenly = spread_of(study.results, "");
    CHECK(evenly.observers == 40);
    CHECK(evenly.answers == 200);
    CHECK(evenly.on_surface == 200);
    CHECK(evenly.chance_mm.value() == Approx(400.0 / 3.0).epsilon(0.02));
    CHECK(evenly.between_mm.value.value() == Approx(400.0 / 3.0).epsilon(0.03));
    CHECK(evenly.within_mm.value.value() == Approx(400.0 / 3.0).epsilon(0.06));
    CHECK(evenly.of_chance.value.value() == Approx(1.0).epsilon(0.03));
    CHECK(evenly.of_chance.interval.value().contains(1.0));
    // The mean of the squared distances from a place of the sphere is 2 r^2; from the middle one of 200 it is
    // some percent less.
    CHECK(evenly.spread_mm.value() == Approx(100.0 * std::sqrt(2.0)).epsilon(0.1));
    const PointSpreadRow& same = spread_of(study.results, "", "same");
    CHECK(same.between_mm.value.value() == 0.0);
    CHECK(same.of_chance.value.value() == 0.0);
    CHECK(same.spread_mm.value() == 0.0);
    CHECK(same.middle.value() == 100.0 * test::front);
    CHECK(same.middle_part == "body");
    CHECK_FALSE(same.within_mm.value); // each answered once
    // Of one observer there is nobody else.
    CHECK_FALSE(spread_of(study.results, "07").between_mm.value);
    CHECK(spread_of(study.results, "07").within_mm.value);
}

TEST_CASE("answers beside the object are counted and have no place, and the middle is nearest to all",
          "[unit]") {
    test::PaintedStudy study = ball_alone();
    const glm::dvec3 right{100.0, 0.0, 0.0}, left{-100.0, 0.0, 0.0}, front = 100.0 * test::front;
    point_at(study.results, "a", 1, "clicked", right);
    point_at(study.results, "a", 2, "clicked", std::nullopt);
    point_at(study.results, "b", 1, "clicked", front);
    point_at(study.results, "c", 1, "clicked", left);
    reckon_points(study.results, study.options);
    const PointSpreadRow& all = spread_of(study.results, "");
    CHECK(all.answers == 4);
    CHECK(all.on_surface == 3);
    CHECK(all.observers == 3);
    CHECK(all.middle.value() == front);
    // From the front: 0, sqrt 2 r, sqrt 2 r.
    CHECK(all.spread_mm.value() == Approx(100.0 * std::sqrt(4.0 / 3.0)));
    CHECK(all.between_mm.value.value() == Approx((200.0 + 2.0 * 100.0 * std::sqrt(2.0)) / 3.0));
    CHECK(spread_of(study.results, "a").answers == 2);
    CHECK(spread_of(study.results, "a").on_surface == 1);
    study.results.objects[0].mm_per_unit = 0.5;
    reckon_points(study.results, study.options);
    CHECK(spread_of(study.results, "").between_mm.value.value() ==
          Approx((100.0 + 100.0 * std::sqrt(2.0)) / 3.0));
}

TEST_CASE("shares of places on an area are means over observers, beside the area's exposure", "[unit]") {
    test::PaintedStudy study = ball_alone();
    ExposureRow& exposure = study.results.exposures.emplace_back();
    exposure.area = "head";
    exposure.share_of_exposure = 0.15;
    const glm::dvec3 top = 100.0 * test::top, front = 100.0 * test::front;
    // One of four, all of two, none of one: 5 / 12 over observers, 3 / 7 over answers.
    for (int trial = 1; trial <= 4; ++trial)
        point_at(study.results, "a", trial, "clicked", trial == 1 ? top : front);
    for (int trial = 1; trial <= 2; ++trial)
        point_at(study.results, "b", trial, "clicked", top);
    point_at(study.results, "c", 1, "clicked", front);
    point_at(study.results, "c", 2, "clicked", std::nullopt);
    reckon_points(study.results, study.options);
    const auto& areas = study.results.points.areas;
    const auto head = std::ranges::find_if(
        areas, [](const PointAreaRow& row) { return row.of.observer.empty() && row.area == "head"; });
    REQUIRE(head != areas.end());
    CHECK(head->share.value.value() == Approx(5.0 / 12.0));
    CHECK(head->share.interval.value().low >= 0.0);
    CHECK(head->share.interval.value().high <= 1.0);
    CHECK(head->answers == 7);
    CHECK(head->on_area == 3);
    CHECK(head->observers == 3);
    CHECK(head->by_chance == 0.15);
    const auto of_one = std::ranges::find_if(
        areas, [](const PointAreaRow& row) { return row.of.observer == "a" && row.area == "head"; });
    REQUIRE(of_one != areas.end());
    CHECK(of_one->share.value.value() == 0.25);
    CHECK_FALSE(of_one->share.interval);
}

TEST_CASE("two answers of a trial have a distance, and those of different trials have none", "[unit]") {
    test::PaintedStudy study = ball_alone();
    const glm::dvec3 top = 100.0 * test::top, front = 100.0 * test::front, back = 100.0 * test::back;
    point_at(study.results, "a", 1, "clicked", front);
    point_at(study.results, "a", 1, "looked", top);
    point_at(study.results, "a", 2, "clicked", front);
    point_at(study.results, "a", 2, "looked", back);
    point_at(study.results, "b", 1, "clicked", front);
    point_at(study.results, "b", 2, "looked", back); // another trial
    reckon_points(study.results, study.options);
    const auto& pairs = study.results.points.pairs;
    REQUIRE(pairs.size() == 2); // all, and a
    CHECK(pairs[0].observer.empty());
    CHECK(pairs[0].first == "clicked");
    CHECK(pairs[0].second == "looked");
    CHECK(pairs[0].trials == 2);
    CHECK(pairs[0].observers == 1);
    CHECK(pairs[0].distance_mm.value.value() == Approx(0.5 * (100.0 * std::sqrt(2.0) + 200.0)));
    CHECK(pairs[1].observer == "a");
}

TEST_CASE("places by chance are as probable as the surface is large, however finely it is divided",
          "[unit]") {
    test::PaintedStudy study = ball_alone();
    // A square of 100 mm in two triangles, and far from it one of 10 mm in two hundred.
    auto mesh = std::make_shared<Mesh>();
    const auto add_square = [&](glm::vec3 corner, float side, std::uint32_t parts) {
        const auto begin = static_cast<std::uint32_t>(mesh->positions.size());
        for (std::uint32_t row = 0; row <= parts; ++row)
            for (std::uint32_t column = 0; column <= parts; ++column)
                mesh->positions.push_back(corner +
                                          side / static_cast<float>(parts) * glm::vec3(column, 0.0f, row));
        for (std::uint32_t row = 0; row < parts; ++row)
            for (std::uint32_t column = 0; column < parts; ++column) {
                const std::uint32_t at = begin + row * (parts + 1) + column;
                mesh->triangles.push_back({at, at + 1, at + parts + 2});
                mesh->triangles.push_back({at, at + parts + 2, at + parts + 1});
            }
    };
    add_square({0.0f, 0.0f, 0.0f}, 100.0f, 1);
    add_square({1000.0f, 0.0f, 0.0f}, 10.0f, 10);
    StudyObject& object = study.results.objects[0];
    object.exposure_density.assign(mesh->positions.size(), 1.0f);
    object.mesh = mesh;
    point_at(study.results, "a", 1, "clicked", glm::dvec3(0.0));
    point_at(study.results, "b", 1, "clicked", glm::dvec3(100.0, 0.0, 0.0));
    reckon_points(study.results, study.options);
    // Corners of the large square count 2, 1, 2, 1 of 6: 83.7 mm between two of them, of 98 % of the pairs; 2
    // % lie about 950 mm apart.
    CHECK(spread_of(study.results, "").chance_mm.value() ==
          Approx(0.98 * 83.7 + 0.0196 * 955.0).epsilon(0.05));
}

TEST_CASE("of two places the first is the middle, and an observer's distances are as they are", "[unit]") {
    test::PaintedStudy study = ball_alone();
    const glm::dvec3 right{100.0, 0.0, 0.0}, front = 100.0 * test::front, top = 100.0 * test::top;
    for (const auto& [trial, place] : {std::pair(1, right), std::pair(2, top)})
        point_at(study.results, "a", trial, "clicked", place);
    for (const auto& [trial, place] : {std::pair(1, front), std::pair(2, front), std::pair(3, -front)})
        point_at(study.results, "b", trial, "clicked", place);
    ExposureRow head, of_other, body;
    head.area = of_other.area = "head";
    body.area = "body";
    head.share_of_exposure = 0.25;
    of_other.object = 1;
    of_other.share_of_exposure = 0.75;
    body.share_of_exposure = 0.5;
    study.results.exposures = {head, of_other, body};
    reckon_points(study.results, study.options);
    const PointSpreadRow &a = spread_of(study.results, "a"), &b = spread_of(study.results, "b");
    CHECK(*a.middle == right);
    CHECK(*a.spread_mm == Approx(100.0)); // 0 and root 2 times the radius
    CHECK(*a.within_mm.value == Approx(100.0 * std::sqrt(2.0)));
    CHECK(*b.within_mm.value == Approx(400.0 / 3.0));
    CHECK(*b.middle == front);
    CHECK(*spread_of(study.results, "").within_mm.value ==
          Approx((100.0 * std::sqrt(2.0) + 400.0 / 3.0) / 2.0));
    for (const PointAreaRow& row : study.results.points.areas)
        CHECK(*row.by_chance == (row.area == "head" ? 0.25 : 0.5));
}
