/// What a whole analysis says of its sessions, trials and fixations, where all of them are known.
#include "experiment/study/analyze_study.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/experiment/study/painted_study.h"

using namespace overt;
using Catch::Matchers::Contains;

namespace {

/// Each observer looks three times at the front of the ball in the first level and at its top in the second.
ReadStudy looks_up_and_front(int observers) {
    test::PaintedStudy study(
        observers, 2, 3, [](int, int level, RandomStream&) { return level == 0 ? test::front : test::top; });
    for (StudySession& session : study.results.sessions) {
        session.protocol = "A";
        session.is_complete = true;
    }
    study.surfaces[0].pixel_seconds.assign(study.surfaces[0].areas_mm2.size(), 1.0);
    return {std::move(study.results), std::move(study.surfaces), {}};
}

StudyResults analyzed(ReadStudy study, StudyOptions options = {}) {
    options.by = {"material"};
    options.resamples = options.permutations = 100;
    return analyze_study(std::move(study), options, [](std::string_view, int, int) {});
}

std::string remarks_of(const StudyResults& results) {
    std::string all;
    for (const std::string& remark : results.remarks)
        all += remark + "\n";
    return all;
}

} // namespace

TEST_CASE("an analysis counts its sessions, trials and fixations, and says what is left out", "[unit]") {
    ReadStudy study = looks_up_and_front(4);
    StudyResults& given = study.results;
    given.sessions[0].protocol = "B";
    given.sessions[1].folder = "sub-1_ses-01";
    given.sessions[1].is_complete = false;
    given.sessions[1].trials = 5;
    given.sessions[2].setup.gaze.origin = GazeOrigin::simulated;
    // The first observer's trials are excluded, one of them without any gaze.
    StudyOptions options;
    options.exclude.most_accuracy_deg = 1.0;
    given.trials[0].excluded = given.trials[1].excluded = true;
    given.trials[0].quality.accuracy_deg = 2.0;
    given.trials[1].has_gaze = false;
    for (std::size_t i = 0; i < 6; ++i)
        given.fixations[i].why = NotCounted::trial_excluded;
    given.fixations[7].why = given.fixations[8].why = NotCounted::too_short;
    given.fixations[9].why = NotCounted::not_on_surface;
    given.fixations[10].only_by_reach = true;
    ExposureRow head, all;
    head.area = "head";
    given.exposures = {all, head};

    const StudyResults results = analyzed(std::move(study), options);
    const StudyGlance& glance = results.glance;
    CHECK(glance.title == "B; A");
    CHECK(glance.sessions == 4);
    CHECK(glance.observers == 3);
    CHECK(glance.trials == 8);
    CHECK(glance.excluded_trials == 2);
    CHECK(glance.without_gaze == 1);
    CHECK(glance.excluded_by == std::vector<std::pair<ExclusionRule, int>>{{ExclusionRule::accuracy, 1}});
    CHECK(glance.fixations == 24);
    CHECK(glance.counted == 15);
    CHECK(glance.counted_s == Approx(15 * 0.25));
    CHECK(glance.only_by_reach == 1);
    CHECK(glance.any_simulated);
    CHECK(glance.not_counted == std::vector<std::pair<NotCounted, int>>{{NotCounted::too_short, 2},
                                                                        {NotCounted::not_on_surface, 1},
                                                                        {NotCounted::trial_excluded, 6}});
    CHECK(*results.exposures[0].share_of_fixations == 1.0);
    CHECK(*results.exposures[1].share_of_fixations == Approx(8.0 / 15.0));
    REQUIRE(results.maps.size() == 4);
    for (int i = 0; i < 4; ++i) {
        CHECK(results.maps[static_cast<std::size_t>(i)].group == i / 2);
        CHECK((results.maps[static_cast<std::size_t>(i)].weighting == MapWeighting::duration) ==
              (i % 2 == 0));
    }
    CHECK_THAT(remarks_of(results),
               Contains("The sessions are of 2 protocols: B; A.") &&
                   Contains("sub-1_ses-01 is not complete: 5 trials of it count.") &&
                   Contains("1 of 15 counted fixations (6.7 %)") &&
                   Contains("The gaze of some sessions is that of simulated observers.") &&
                   Contains("N is 3 of 4 observers who were given.") &&
                   Contains("of 3 observers at most, for whom no cluster can have a smaller p "
                            "than 0.25: that takes 6 observers") &&
                   !Contains("intervals over observers need three") &&
                   !Contains("presented by another program"));
}

TEST_CASE("an analysis says what few observers, other presenters and uncounted fixations leave unknown",
          "[unit]") {
    const std::string of_two = remarks_of(analyzed(looks_up_and_front(2)));
    CHECK_THAT(of_two, Contains("There are only 2 observers: intervals over observers need three.") &&
                           !Contains("protocols") && !Contains("simulated") && !Contains("is not complete") &&
                           !Contains("reach"));
    ReadStudy study = looks_up_and_front(1);
    study.results.sessions[0].setup.presenter = "";
    study.results.sessions[0].setup.gaze.origin = GazeOrigin::simulated;
    const std::string of_one = remarks_of(analyzed(std::move(study)));
    CHECK_THAT(of_one, Contains("There is only 1 observer: intervals") &&
                           Contains("All sessions were presented by another program") &&
                           Contains("is not known, nor how exactly gaze was measured") &&
                           Contains("The gaze of all sessions is that of simulated observers.") &&
                           Contains("No two observers saw one object in two levels of material"));
    study = looks_up_and_front(3);
    study.results.sessions[1].setup.presenter = "";
    study.results.trials[0].quality.accuracy_deg = 0.5;
    study.results.sessions[0].setup.gaze.rate_hz = 30.0;
    CHECK_THAT(remarks_of(analyzed(std::move(study))),
               Contains("One session was presented by another program") && !Contains("nor how exactly") &&
                   Contains("Gaze was sampled at 30 Hz"));
    study = looks_up_and_front(6);
    for (StudyFixation& fixation : study.results.fixations)
        fixation.why = NotCounted::too_short;
    const StudyResults none = analyzed(std::move(study));
    CHECK_THAT(remarks_of(none), Contains("No fixation was counted: there are no maps and no fractions.") &&
                                     !Contains("maps of differences"));
    CHECK(none.maps.at(0).absent == "no fixation was counted on this object");
}

TEST_CASE("maps hold each trial's fixations, by time and by number", "[unit]") {
    ReadStudy study = looks_up_and_front(6);
    for (std::size_t i = 0; i < study.results.fixations.size(); ++i) {
        study.results.fixations[i].sigma_mm = i == 0 ? 25.0 : i == 1 ? 35.0 : 30.0;
        study.results.fixations[i].duration_s = i < 3 ? 0.5 : 0.25;
    }
    const StudyResults results = analyzed(std::move(study));
    const StudyMap &by_time = results.maps.at(2), &by_number = results.maps.at(3); // of the second: "smooth"
    REQUIRE(results.groups[1].keys[0].value == "smooth");
    CHECK(by_time.trials == 6);
    CHECK(by_time.observers == 6);
    CHECK(by_time.fixations == 18);
    CHECK(by_time.total == Approx((1500.0 + 5 * 750.0) / 6.0).epsilon(1e-3));
    CHECK(by_number.total == Approx(3.0).epsilon(1e-3));
    CHECK(by_time.area_mm2 == Approx(4.0 * 3.14159265 * 10'000.0).epsilon(0.02));
    CHECK(by_time.mean == Approx(by_time.total / by_time.area_mm2));
    CHECK(by_time.peak == Approx(*std::ranges::max_element(by_time.density)));
    CHECK(by_time.least_sigma_mm == 25.0);
    CHECK(by_time.most_sigma_mm == 35.0);
    CHECK(results.maps.at(0).least_sigma_mm == 30.0);
    CHECK_FALSE(results.parameters.empty());
    CHECK(results.by == std::vector<std::string>{"material"});
    CHECK(results.confidence == 0.95);
    CHECK(results.area == "head");
    const auto sizes = {results.area_rows.size(),
                        results.surface_transitions.size(),
                        results.distributions.size(),
                        results.time_course.size(),
                        results.time_clusters.size(),
                        results.first_fixations.size(),
                        results.pairs.size(),
                        results.area_pairs.size(),
                        results.scanpaths.size(),
                        results.scanpath_likeness.size(),
                        results.measure_differences.size(),
                        results.differences.size(),
                        results.predictions.size(),
                        results.reliabilities.size(),
                        results.motions.size(),
                        results.effects.size(),
                        results.reporting.size(),
                        results.methods.size()};
    CHECK(std::ranges::find(sizes, 0u) == sizes.end());
    StudyOptions asked;
    asked.is_by_asked = true;
    ReadStudy of_one_level = looks_up_and_front(1);
    of_one_level.levels = {{"material", {"smooth"}}};
    CHECK_THROWS_WITH(analyzed(std::move(of_one_level), asked), Contains("this factor has one level"));
    // Whatever kernel blurs them.
    for (const MapKernel kernel : {MapKernel::euclidean, MapKernel::voxel}) {
        StudyOptions options;
        options.kernel = kernel;
        const StudyResults other = analyzed(looks_up_and_front(3), options);
        CHECK(other.maps.at(2).total == Approx(750.0).epsilon(1e-3));
        CHECK(other.maps.at(3).total == Approx(3.0).epsilon(1e-3));
        const auto peak = std::ranges::max_element(other.maps[3].density) - other.maps[3].density.begin();
        CHECK(other.objects[0].mesh->positions[static_cast<std::size_t>(peak)].y < -90.0f);
    }
    // All gaze is on one place, which a Gaussian of 30 mm surrounds.
    CHECK(by_number.peak == Approx(3.0 / (2.0 * 3.14159265 * 900.0)).epsilon(0.15));
}

TEST_CASE("an analysis tells what it is at, from the first object to the last", "[unit]") {
    std::vector<std::string> told;
    StudyOptions options;
    options.by = {"material"};
    options.resamples = options.permutations = 20;
    analyze_study(looks_up_and_front(2), options, [&](std::string_view what, int done, int all) {
        told.push_back(fmt::format("{} {}/{}", what, done, all));
    });
    CHECK(told == std::vector<std::string>{"maps 0/1", "maps 1/1", "comparisons 0/1", "comparisons 1/1",
                                           "differences 0/1", "differences 1/1", "metrics 0/1",
                                           "metrics 1/1"});
}

TEST_CASE(
    "maps of differences are said to be of too few where no cluster can be significant, not where one can",
    "[unit]") {
    const auto says_too_few = [](int observers, double confidence) {
        StudyOptions options;
        options.confidence = confidence;
        return remarks_of(analyzed(looks_up_and_front(observers), options))
                   .find("no cluster can have a smaller p") != std::string::npos;
    };
    // Six observers can give 1/32.
    CHECK_FALSE(says_too_few(6, 1.0 - 1.0 / 32.0));
    CHECK(says_too_few(6, 0.97));
    CHECK_FALSE(says_too_few(6, 0.95));
}
