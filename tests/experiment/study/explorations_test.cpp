#include "experiment/study/explorations.h"

#include <catch2/catch.hpp>

using namespace overt;

namespace {

ExplorationRow show_of(const std::string& observer, const std::string& material, double path_deg,
                       double turning_s, int reversals) {
    ExplorationRow row;
    row.observer = observer;
    row.levels = {{"material", material}, {"motion", "turned"}};
    row.seconds = 4.0;
    row.turning_s = turning_s;
    row.path_deg = path_deg;
    row.net_deg = -path_deg;
    row.reversals = reversals;
    row.poses = static_cast<int>(path_deg / 5.0) + 1;
    return row;
}

const ExplorationSummaryRow& row_of(const StudyExplorations& study, const std::string& observer,
                                    const std::string& column, const std::string& level) {
    for (const ExplorationSummaryRow& row : study.summaries)
        if (row.observer == observer && row.column == column && row.level == level)
            return row;
    FAIL("no row of " << observer << " " << column << " " << level);
    return study.summaries.front();
}

} // namespace

TEST_CASE("how objects are turned is a mean over observers of their own means, by level and over all",
          "[unit]") {
    StudyExplorations study;
    // The first observer has three shows, the second one: each counts as one observer.
    study.shows = {show_of("01", "gold", 30.0, 1.0, 2), show_of("01", "clay", 90.0, 2.0, 4),
                   show_of("01", "clay", 60.0, 3.0, 0), show_of("02", "gold", 0.0, 0.0, 0)};
    reckon_explorations(study, {});
    const ExplorationSummaryRow& all = row_of(study, "", "", "");
    CHECK(all.shows == 4);
    CHECK(all.observers == 2);
    CHECK(*all.path_deg.value == Approx((60.0 + 0.0) / 2.0));
    CHECK(*all.turned_share.value == Approx((0.5 + 0.0) / 2.0));
    CHECK(*all.reversals.value == Approx((2.0 + 0.0) / 2.0));
    CHECK(*all.poses.value == Approx(((7.0 + 19.0 + 13.0) / 3.0 + 1.0) / 2.0));
    // Who never turned anything has no speed, and is not 0 in the mean.
    CHECK(*all.speed_deg_s.value == Approx(180.0 / 6.0));
    const ExplorationSummaryRow& still = row_of(study, "02", "", "");
    CHECK_FALSE(still.speed_deg_s.value);
    CHECK(still.speed_deg_s.absent == "never turned");
    CHECK(*row_of(study, "", "material", "clay").path_deg.value == Approx(75.0));
    CHECK(row_of(study, "", "material", "clay").observers == 1);
    CHECK(*row_of(study, "01", "material", "gold").path_deg.value == Approx(30.0));
    // A column with one level says nothing that all do not say.
    for (const ExplorationSummaryRow& row : study.summaries)
        CHECK(row.column != "motion");

    StudyExplorations nothing;
    reckon_explorations(nothing, {});
    CHECK(nothing.summaries.empty());
}
