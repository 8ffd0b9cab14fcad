/// Ways of gaze over a ball, where all of them are known.
#include "experiment/study/scanpaths.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "experiment/study/scanpath_likeness.h"
#include "tests/experiment/study/painted_study.h"

using namespace overt;

namespace {

constexpr double quarter_mm = 50.0 * std::numbers::pi; ///< of the way round the ball

/// The directions one after the other, the same in each trial of a level.
class OrderedLooks {
  public:
    OrderedLooks(int observers, std::vector<glm::dvec3> smooth, std::vector<glm::dvec3> rough)
        : looks_{std::move(smooth), std::move(rough)},
          study(observers, 2, static_cast<int>(looks_[0].size()),
                [this](int, int level, RandomStream&) {
                    const auto& own = looks_[static_cast<std::size_t>(level)];
                    return own[next_++ % own.size()];
                }),
          maps(fixation_maps(study.results, study.surfaces)),
          distances(surface_distances(study.results, study.surfaces)),
          scanpaths(trial_scanpaths(study.results, distances, maps)) {}

  private:
    std::array<std::vector<glm::dvec3>, 2> looks_;
    std::size_t next_ = 0;

  public:
    test::PaintedStudy study;
    ObjectFixationMaps maps;
    ObjectDistances distances;
    std::vector<TrialScanpath> scanpaths;
};

} // namespace

TEST_CASE("steps are ways along the surface, and not through the object", "[unit]") {
    // Front, top, back: two quarters. On the other level to and fro between the poles of the axis.
    const OrderedLooks looks(2, {test::front, test::top, test::back}, {test::front, test::back, test::front});
    const TrialScanpath& first = looks.scanpaths[0];
    CHECK(first.fixations == 3);
    CHECK(*first.way_mm == Approx(2.0 * quarter_mm).epsilon(0.02));
    CHECK(*first.step_mm == Approx(quarter_mm).epsilon(0.02));
    CHECK(*first.fixation_s == Approx(0.25));
    CHECK(*first.recurrence == 0.0);
    CHECK_FALSE(first.determinism);
    const TrialScanpath& second = looks.scanpaths[1];
    CHECK(*second.step_mm == Approx(2.0 * quarter_mm).epsilon(0.02));
    CHECK(*second.recurrence == Approx(1.0 / 3.0));
    CHECK(*second.return_distance == 1.0);
    CHECK(looks.distances[0]->extent_mm() == Approx(2.0 * quarter_mm).epsilon(0.02));
}

TEST_CASE("coverage is the share of the surface near fixations, and an even map has all of it", "[unit]") {
    const OrderedLooks looks(1, {test::front, test::top, test::back},
                             {test::front, test::front, test::front});
    // Caps with a radius of 30 mm along the surface: (1 - cos 0.3) / 2 of the ball each.
    const double cap = 0.5 * (1.0 - std::cos(0.3));
    CHECK(*looks.scanpaths[0].coverage == Approx(3.0 * cap).epsilon(0.35)); // 642 vertices on the ball
    CHECK(*looks.scanpaths[1].coverage == Approx(cap).epsilon(0.5));
    // A Gaussian on a plane has the entropy ln(2 pi e sigma^2); three of them apart three times the share.
    const double share = 2.0 * std::numbers::pi * std::numbers::e * 900.0 / (40000.0 * std::numbers::pi);
    CHECK(*looks.scanpaths[1].entropy == Approx(share).epsilon(0.1));
    CHECK(*looks.scanpaths[0].entropy == Approx(3.0 * share).epsilon(0.1));
}

TEST_CASE("rows and differences of ways are means over observers of their trials", "[unit]") {
    OrderedLooks looks(6, {test::front, test::top, test::back}, {test::front, test::back, test::front});
    const auto rows = scanpath_rows(looks.study.results, looks.scanpaths, {}, looks.study.options);
    REQUIRE(rows.size() == 3); // all, and two levels
    CHECK(rows[0].trials == 12);
    CHECK(rows[0].observers == 6);
    CHECK(*rows[0].step_mm.value == Approx(1.5 * quarter_mm).epsilon(0.02));
    CHECK(*rows[0].fixations.value == 3.0);
    looks.study.options.compare = "material";
    const auto differences =
        measure_differences(looks.study.results, scanpath_measures(looks.scanpaths), {}, looks.study.options);
    const auto step = std::ranges::find(differences, "step_mm", &MeasureDifferenceRow::measure);
    REQUIRE(step != differences.end());
    const double sign = step->a == "smooth" ? -1.0 : 1.0;
    CHECK(*step->difference.value == Approx(sign * quarter_mm).epsilon(0.04));
    CHECK(step->unit == "mm");
    CHECK(*step->p == Approx(2.0 / 64.0));
}

TEST_CASE("ways of two observers are more alike where they saw the same, and by their order", "[unit]") {
    OrderedLooks looks(6, {test::front, test::top, test::back}, {test::back, test::top, test::front});
    looks.study.options.compare = "material";
    const auto rows = scanpath_likeness(looks.study.results, looks.distances, {}, looks.study.options);
    REQUIRE(rows.size() == 6);
    for (const ScanpathLikenessRow& row : rows) {
        CAPTURE(row.measure);
        CHECK(row.observers == 6);
        CHECK(*row.same_level.value == Approx(1.0));
        CHECK(*row.level_effect.value ==
              Approx(*row.same_level.value - *row.other_level.value).margin(1e-12));
    }
    // The other way round one of three places can be aligned.
    CHECK(*rows[0].other_level.value == Approx(1.0 / 3.0).margin(0.05));
    CHECK(*rows[0].shuffled.value < 0.95);
    const auto direction = std::ranges::find(rows, "multimatch_direction", &ScanpathLikenessRow::measure);
    CHECK(*direction->other_level.value < 0.9);
    const auto duration = std::ranges::find(rows, "multimatch_duration", &ScanpathLikenessRow::measure);
    CHECK(*duration->level_effect.value == Approx(0.0).margin(1e-12));
}

TEST_CASE("each number of ways is a mean of trials that have it, then of observers", "[unit]") {
    test::PaintedStudy study(
        2, 1, 1, [](int, int, RandomStream&) { return test::front; }, 1, "rough", 2);
    StudyResults& results = study.results;
    REQUIRE(results.trials.size() == 4);
    // Trial i has i + 1 fixations; its n-th number is (n + 1) / 10, (n + 1) / 20, none, (n + 1) / 40.
    const std::array members{
        &TrialScanpath::fixation_s, &TrialScanpath::step_mm,     &TrialScanpath::step_deg,
        &TrialScanpath::way_mm,     &TrialScanpath::coverage,    &TrialScanpath::entropy,
        &TrialScanpath::recurrence, &TrialScanpath::determinism, &TrialScanpath::return_distance};
    const std::array of_row{
        &ScanpathRow::fixation_s, &ScanpathRow::step_mm,     &ScanpathRow::step_deg,
        &ScanpathRow::way_mm,     &ScanpathRow::coverage,    &ScanpathRow::entropy,
        &ScanpathRow::recurrence, &ScanpathRow::determinism, &ScanpathRow::return_distance};
    const std::array names{"fixation_s",      "step_mm",    "step_deg",    "way_mm",         "coverage",
                           "effective_share", "recurrence", "determinism", "return_distance"};
    const std::array units{"s", "mm", "deg", "mm", "", "", "", "", ""};
    std::vector<TrialScanpath> scanpaths(4);
    const std::array divisors{10.0, 20.0, 0.0, 40.0};
    for (std::size_t trial = 0; trial < 4; ++trial) {
        scanpaths[trial].fixations = static_cast<int>(trial) + (trial == 0 ? 0 : 1);
        for (std::size_t n = 0; n < members.size(); ++n)
            if (trial != 2)
                scanpaths[trial].*members[n] = (static_cast<double>(n) + 1.0) / divisors[trial];
    }
    const auto rows = scanpath_rows(results, scanpaths, {}, study.options);
    CHECK(rows[0].trials == 3); // with any fixation
    CHECK(rows[0].observers == 2);
    CHECK(*rows[0].fixations.value == Approx((1.0 + 3.5) / 2.0));
    const auto measures = scanpath_measures(scanpaths);
    REQUIRE(measures.size() == 10);
    CHECK(measures[0].name == "fixations");
    CHECK(measures[0].sums(3).sum == 4.0);
    CHECK(measures[0].sums(3).weight == 1.0);
    for (std::size_t n = 0; n < members.size(); ++n) {
        CAPTURE(n);
        CHECK(*(rows[0].*of_row[n]).value == Approx((static_cast<double>(n) + 1.0) * (0.075 + 0.025) / 2.0));
        CHECK(measures[n + 1].name == names[n]);
        CHECK(measures[n + 1].unit == units[n]);
        CHECK(measures[n + 1].sums(1).sum == Approx((static_cast<double>(n) + 1.0) / 20.0));
        CHECK(measures[n + 1].sums(1).weight == 1.0);
        CHECK(measures[n + 1].sums(2).weight == 0.0);
    }
}
