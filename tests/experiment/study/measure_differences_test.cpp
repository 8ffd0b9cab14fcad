/// Levels compared measure by measure, in time and by first fixations: what was planted comes back.
#include "experiment/study/measure_differences.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/study/first_fixations.h"
#include "experiment/study/time_clusters.h"
#include "tests/experiment/study/counted_trials.h"

using namespace overt;

namespace {

/// One fixation each 0.4 s, 20 of 0.25 s.
void put_in_time(StudyResults& results) {
    for (const StudyTrial& trial : results.trials) {
        for (std::size_t i = 0; i < trial.fixations; ++i)
            results.fixations[trial.first_fixation + i].onset_s = 0.4 * static_cast<double>(i) + 0.1;
    }
}

std::string material_seen(const StudyResults& results, const StudyFixation& fixation) {
    return results.trials[static_cast<std::size_t>(fixation.trial)].key("material");
}

test::CountedTrials heads_in_first_material(int observers, double share, double others,
                                            std::uint64_t seed = 1) {
    return {observers,
            [=](const test::TrialOfDesign& trial, RandomStream&) {
                return test::LooksOfTrial{trial.material == 0 ? share : others};
            },
            seed};
}

const MeasureDifferenceRow& difference_of(const std::vector<MeasureDifferenceRow>& rows,
                                          const std::string& measure, const std::string& of,
                                          const std::string& b = "material 1") {
    const auto found = std::ranges::find_if(rows, [&](const MeasureDifferenceRow& row) {
        return row.measure == measure && row.of == of && row.a == "material 0" && row.b == b;
    });
    REQUIRE(found != rows.end());
    return *found;
}

} // namespace

TEST_CASE("what levels differ in is found measure by measure, with its sign and size", "[unit]") {
    test::CountedTrials study = heads_in_first_material(10, 0.6, 0.3);
    put_in_time(study.results);
    for (StudyFixation& fixation : study.results.fixations) {
        const bool is_first = material_seen(study.results, fixation) == "material 0";
        fixation.surface_way_deg2 = 0.5;
        fixation.gaze_with_surface_deg2 = is_first ? 0.5 : 0.2;
        // Twice the error's variance leaves less of either: without any it is 0.6 - 0.25 and 0.6.
        fixation.displaced_motion = {{is_first ? 0.4 : 0.1, 0.4}};
        fixation.light = {{is_first ? 1.5 : 1.0, 0.5, 0.25}};
    }
    const auto rows = measure_differences(study.results, looking_measures(study.results), {}, study.options);
    const MeasureDifferenceRow& dwell = difference_of(rows, "dwell_s", "head");
    CHECK(dwell.observers == 10);
    CHECK(dwell.comparisons == 60); // two tasks, in which all three objects come in all materials
    CHECK(dwell.unit == "s");
    CHECK(dwell.column == "material");
    // 0.3 of the 20 fixations of 0.25 s.
    CHECK(*dwell.difference.value == Approx(1.5).margin(0.3));
    CHECK(dwell.difference.interval->low > 1.0);
    CHECK(*dwell.p == Approx(2.0 / 1024.0));
    CHECK(*dwell.p_holm >= *dwell.p);
    CHECK(*dwell.evidence.bayes_factor > 100.0);
    CHECK(*difference_of(rows, "dwell_s", "body").difference.value == Approx(-*dwell.difference.value));
    // Where gaze goes does not depend on where it is: the next is on the head as often as any.
    CHECK(*difference_of(rows, "transition", "head > head").difference.value == Approx(0.3).margin(0.05));
    CHECK(*difference_of(rows, "transition", "body > head").difference.value == Approx(0.3).margin(0.05));
    CHECK(*difference_of(rows, "first_arrival_s", "head").difference.value < -0.1);
    CHECK(*difference_of(rows, "surface_gain", "").difference.value == Approx(0.6));
    CHECK(*difference_of(rows, "corrected_gain", "").difference.value == Approx(0.6 / 0.6 - 0.3 / 0.6));
    CHECK(*difference_of(rows, "lightness", "").difference.value == Approx(0.5));
    CHECK(*difference_of(rows, "over_place", "").difference.value == Approx(0.5));
    // The other two materials are alike.
    const auto alike = std::ranges::find_if(rows, [](const MeasureDifferenceRow& row) {
        return row.measure == "dwell_s" && row.of == "head" && row.a == "material 1";
    });
    REQUIRE(alike != rows.end());
    CHECK(std::abs(*alike->difference.value) < 0.15);
    CHECK(*alike->p > 0.01);
}

TEST_CASE("measures that nobody has in two levels have no row, and excluded trials do not count", "[unit]") {
    test::CountedTrials study = heads_in_first_material(6, 0.6, 0.3);
    for (StudyTrial& trial : study.results.trials)
        trial.excluded = trial.key("material") == "material 0";
    const auto rows = measure_differences(study.results, looking_measures(study.results), {}, study.options);
    CHECK_FALSE(rows.empty());
    for (const MeasureDifferenceRow& row : rows) {
        CHECK(row.a == "material 1");
        CHECK(row.measure != "surface_gain"); // no surface moved
        CHECK(row.measure != "lightness");    // no light is known
    }
}

TEST_CASE("without a difference few measures have a small p", "[unit]") {
    int small = 0;
    constexpr int studies = 60;
    for (int i = 0; i < studies; ++i) {
        test::CountedTrials study = heads_in_first_material(7, 0.4, 0.4, static_cast<std::uint64_t>(i));
        put_in_time(study.results);
        study.options.resamples = 100;
        std::vector<MeasureOfTrials> measures = looking_measures(study.results);
        std::erase_if(measures,
                      [](const MeasureOfTrials& one) { return one.name != "visits" || one.of != "head"; });
        const auto rows = measure_differences(study.results, measures, {}, study.options);
        small += *difference_of(rows, "visits", "head").p <= 0.05;
    }
    CHECK(small <= 9); // of 60 at 5 %: more once in 1,000 (binomial distribution)
}

TEST_CASE("when levels differ in time is found where it was planted", "[unit]") {
    test::CountedTrials study = heads_in_first_material(10, 0.3, 0.3);
    put_in_time(study.results);
    for (StudyFixation& fixation : study.results.fixations) {
        if (material_seen(study.results, fixation) == "material 0" && fixation.onset_s > 2.0 &&
            fixation.onset_s < 4.0)
            fixation.part = PartIndex{1};
    }
    const auto rows = time_clusters(study.results, {}, study.options);
    const auto found = std::ranges::find_if(rows, [](const TimeClusterRow& row) {
        return row.area == "head" && row.a == "material 0" && row.b == "material 1" && row.number == 1;
    });
    REQUIRE(found != rows.end());
    CHECK(found->from_s == 2.0);
    CHECK(found->to_s == 4.0);
    CHECK(found->difference == Approx(0.7).margin(0.1));
    CHECK(found->mass > 0.0);
    CHECK(found->p == Approx(2.0 / 1024.0));
    CHECK(found->p_of_all >= found->p);
    CHECK(found->p_of_all < 0.05);
    CHECK(found->least_p == Approx(2.0 / 1024.0));
    CHECK(found->observers == 10);
    for (const TimeClusterRow& row : rows) {
        if (row.a == "material 1") // against material 2, which it is like
            CHECK((row.number == 0 || row.p > 0.01));
    }
    // The other way round for what is not the head.
    const auto body = std::ranges::find_if(rows, [](const TimeClusterRow& row) {
        return row.area == "body" && row.a == "material 0" && row.number == 1;
    });
    REQUIRE(body != rows.end());
    CHECK(body->difference < 0.0);
    CHECK(body->mass < 0.0);
}

TEST_CASE("first fixations are told by their number", "[unit]") {
    test::CountedTrials study = heads_in_first_material(4, 0.0, 0.0);
    for (const StudyTrial& trial : study.results.trials) {
        const bool is_first = trial.key("material") == "material 0";
        study.results.fixations[trial.first_fixation + (is_first ? 0 : 2)].part = PartIndex{1};
        study.results.fixations[trial.first_fixation + 1].why = NotCounted::too_short;
    }
    const auto rows = first_fixations(study.results, {}, study.options);
    const auto row = [&](const std::string& material, int number) {
        const auto found = std::ranges::find_if(rows, [&](const FirstFixationsRow& one) {
            return one.area == "head" && one.number == number && one.keys.size() == 1 &&
                   one.keys[0].value == material;
        });
        REQUIRE(found != rows.end());
        return *found;
    };
    CHECK(*row("material 0", 1).at.value == 1.0);
    CHECK(*row("material 0", 2).at.value == 0.0);
    CHECK(*row("material 0", 2).up_to.value == 0.5);
    CHECK(*row("material 1", 1).at.value == 0.0);
    CHECK(*row("material 1", 2).at.value == 1.0); // the one that is too short is not counted
    CHECK(*row("material 1", 10).up_to.value == Approx(0.1));
    CHECK(row("material 1", 1).observers == 4);
    CHECK(std::ranges::none_of(rows, [](const auto& one) { return one.number > most_first_fixations; }));
}

TEST_CASE("the course of time has as many stretches as the longest trial that counts, and no more than 120",
          "[unit]") {
    StudyResults results;
    results.trials.resize(3);
    CHECK(longest_presentation_s(results) == 0.0);
    CHECK(stretches_of_time(results, 1.0) == 0);
    results.trials[0].presentation_s = 0.4;
    results.trials[1].presentation_s = 0.7;
    results.trials[2].presentation_s = 9.0;
    results.trials[2].excluded = true;
    CHECK(longest_presentation_s(results) == 0.7);
    CHECK(stretches_of_time(results, 1.0) == 1);
    CHECK(stretches_of_time(results, 0.35) == 2);
    CHECK(stretches_of_time(results, 0.34) == 3);
    // A thousandth of a stretch is none.
    CHECK(stretches_of_time(results, 0.6995) == 1);
    CHECK(stretches_of_time(results, 0.001) == 120);
}
