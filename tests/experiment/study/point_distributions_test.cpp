/// Spreads of points that are known, on an object whose unit is no millimetre.
#include "experiment/study/point_distributions.h"

#include <catch2/catch.hpp>

#include "experiment/study/level_comparisons.h"
#include "experiment/study/results/study_groups.h"
#include "experiment/study/study_maps.h"

using namespace overt;

namespace {

/// Three observers, each with a trial in either level, on one object of 2 mm a unit and 5 mm a degree.
struct ScatteredStudy {
    ScatteredStudy() {
        StudyObject& object = results.objects.emplace_back();
        object.part_names = {"body", "head"};
        object.areas = Areas(object.part_names);
        results.objects.push_back(object);
        surfaces.resize(2);
        surfaces[0].scale = ObjectScale{2.0, 1000.0, 5.0};
        for (const int observer : {0, 1, 2}) {
            results.sessions.emplace_back().observer = std::to_string(observer);
            // Along x 0, 1, 2 and along y 0, 3, 0 in the one level; along z 0 and 4 in the other.
            add(observer, "rough", {{0, 0, 0}, {1, 3, 0}, {2, 0, 0}});
            add(observer, "smooth", {{0, 0, 0}, {0, 0, 4.0 + observer}});
        }
        results.by = options.by = {"material"};
        results.groups = make_groups(results, options.by, {});
    }
    void add(int observer, const char* level, const std::vector<glm::dvec3>& points) {
        StudyTrial trial;
        trial.session = observer;
        trial.keys = {{"material", level}};
        trial.first_fixation = results.fixations.size();
        trial.fixations = points.size();
        for (const glm::dvec3& point : points) {
            StudyFixation& fixation = results.fixations.emplace_back();
            fixation.trial = static_cast<int>(results.trials.size());
            fixation.position = point;
            fixation.triangle = 0;
            fixation.part = PartIndex{point.x > 0.5 ? std::uint8_t{1} : std::uint8_t{0}};
        }
        results.trials.push_back(std::move(trial));
    }
    StudyResults results;
    std::vector<ObjectSurface> surfaces;
    StudyOptions options;
};

} // namespace

TEST_CASE("a distribution has the variance of its points along each axis, in millimetres and degrees",
          "[unit]") {
    ScatteredStudy study;
    StudyMap by_count, by_time;
    by_count.weighting = MapWeighting::count;
    by_count.peak = 7.0;
    by_time.peak = 11.0;
    by_time.mean = 13.0;
    study.results.maps = {by_count, by_time};
    const auto rows = point_distributions(study.results, study.surfaces, study.options);
    REQUIRE(rows.size() == 2);
    const DistributionRow &rough = rows[0], &smooth = rows[1];
    CHECK(rough.observers == 3);
    CHECK(rough.fixations == 9);
    CHECK(rough.group == 0);
    CHECK(smooth.group == 1);
    // 2 / 3 and 2, over all points of all observers; a unit is 2 mm, so 4 mm2; 5 mm are a degree.
    CHECK(*rough.variance_mm2[0] == Approx(4.0 * 2.0 / 3.0));
    CHECK(*rough.variance_mm2[1] == Approx(4.0 * 2.0));
    CHECK(*rough.variance_mm2[2] == Approx(0.0).margin(1e-12));
    CHECK(*rough.wss_mm2.value == Approx(4.0 * 8.0 / 3.0));
    CHECK(*rough.wss_deg2.value == Approx(4.0 * 8.0 / 3.0 / 25.0));
    CHECK(*rough.variance_deg2[1] == Approx(4.0 * 2.0 / 25.0));
    // Along z 0, 4, 0, 5, 0, 6: mean 2.5.
    CHECK(*smooth.wss_mm2.value == Approx(4.0 * (77.0 / 6.0 - 6.25)));
    REQUIRE(smooth.wss_mm2.interval);
    CHECK(smooth.wss_mm2.interval->low < *smooth.wss_mm2.value);
    CHECK(smooth.wss_mm2.interval->high > *smooth.wss_mm2.value);
    CHECK(smooth.wss_deg2.interval->low == Approx(smooth.wss_mm2.interval->low / 25.0));
    CHECK(smooth.wss_deg2.interval->high == Approx(smooth.wss_mm2.interval->high / 25.0));
    CHECK(*rough.map_peak == 11.0);
    CHECK(*rough.map_mean == 13.0);
    CHECK_FALSE(smooth.map_peak);
}

TEST_CASE("a distribution says why it has no spread", "[unit]") {
    ScatteredStudy study;
    const auto absent = [&] {
        return point_distributions(study.results, study.surfaces, study.options).at(1).wss_deg2.absent;
    };
    study.surfaces[0].scale.reset();
    CHECK(absent() == "the camera or the screen is not known");
    for (const std::size_t i : {3u, 4u, 8u, 13u, 14u}) // all but one of the second level
        study.results.fixations[i].why = NotCounted::too_short;
    CHECK(absent() == "one fixation alone has no spread");
    study.results.fixations[9].why = NotCounted::too_short;
    CHECK(absent() == "no fixation was counted");
}

TEST_CASE("an observer's levels are compared on each object with fixations in both", "[unit]") {
    ScatteredStudy study;
    const std::vector<int> all{0, 1, 2, 3};
    const auto compared =
        level_comparisons(study.results, all, study.surfaces, "material", "rough", "smooth");
    REQUIRE(compared.size() == 2);
    CHECK(compared[0].observer == 0);
    CHECK(compared[1].observer == 1);
    CHECK(compared[1].a.size() == 3);
    CHECK(compared[1].b.size() == 2);
    const ObjectScale& scale = *study.surfaces[0].scale;
    // Without bias: 1 + 3 and, along z alone, 4^2 / 2 and 5^2 / 2.
    CHECK(*wss_difference_mm2(compared[0], scale) == Approx(4.0 * (4.0 - 8.0)));
    CHECK(*wss_difference_mm2(compared[1], scale) == Approx(4.0 * (4.0 - 12.5)));
    CHECK(*wss_difference_deg2(compared[1], scale) == Approx(4.0 * (4.0 - 12.5) / 25.0));
    CHECK(*area_difference(compared[0], study.results, "head") == Approx(2.0 / 3.0));
    CHECK(*area_difference(compared[0], study.results, "body") == Approx(1.0 / 3.0 - 1.0));
    CHECK_FALSE(area_difference(compared[0], study.results, "foot"));
    CHECK(level_comparisons(study.results, {2, 3}, study.surfaces, "material", "smooth", "rough")
              .at(0)
              .observer == 1);
    CHECK(level_comparisons(study.results, {0, 3}, study.surfaces, "material", "rough", "smooth").empty());
    study.results.fixations[4].why = NotCounted::too_short;
    const auto fewer = level_comparisons(study.results, all, study.surfaces, "material", "rough", "smooth");
    CHECK_FALSE(wss_difference_mm2(fewer[0], scale)); // one point has no variance
    study.surfaces[0].scale.reset();
    CHECK(level_comparisons(study.results, all, study.surfaces, "material", "rough", "smooth").empty());
}
