/// Studies simulated at gaze level: they find what is planted as often as statistics say, and nothing else.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "app/power/planted_spread.h"
#include "app/power/power_simulation.h"
#include "app/power/power_tests.h"
#include "experiment/base/error.h"
#include "experiment/statistics/point_spread.h"
#include "experiment/study/factor_effects.h"
#include "experiment/study/study_maps.h"
#include "tests/support/figures.h"

using namespace overt;

namespace {

/// One bust in two materials under so many tasks, each of them for every stimulus.
Experiment busts(int tasks) {
    Experiment experiment;
    Protocol& protocol = experiment.protocol;
    protocol.name = "busts";
    protocol.objects.resize(1);
    protocol.objects[0].id = "bust";
    protocol.materials.resize(2);
    protocol.materials[0].id = "smooth";
    protocol.materials[1].id = "rough";
    for (int i = 0; i < tasks; ++i) {
        Task task;
        task.id = i == 0 ? "free" : "clothes";
        task.simulated_head_share = i == 0 ? 0.4 : 0.2;
        protocol.tasks.push_back(task);
    }
    protocol.schedule.max_object_run = 0;
    protocol.views.front().width_px = protocol.views.front().height_px = 512;
    Object bust;
    bust.id = "bust";
    bust.mesh = test::bust();
    const View view{fit_camera(bust.mesh, {11.9}, {512, 512}, {25.0}, 0.06), {512, 512}};
    bust.scenes = {{view, bust.mesh->bounds()}};
    experiment.objects.push_back(std::move(bust));
    return experiment;
}

/// Fixations of a trial of busts() that are counted, and what scipy makes of them for shares of 0.4 and, with
/// 1.8 times the odds, 0.545455: with sd = sqrt((0.24 + 0.247934) / fixations) and nc = 0.145455 sqrt(n) /
/// sd, power is 1 - nct.cdf(c, n - 1, nc) + nct.cdf(-c, n - 1, nc), c = t.ppf(0.975, n - 1).
constexpr double fixations_of_a_trial = 26.1, power_of_8 = 0.733, power_of_14 = 0.957;

PowerResults power_of(const Experiment& experiment, const std::vector<std::string>& effects,
                      std::vector<int> observers, int studies, int jobs = 0) {
    PowerSettings settings;
    settings.observers = std::move(observers);
    settings.studies = studies;
    settings.jobs = jobs;
    settings.gaze = gaze_study_settings(experiment.protocol);
    return simulate_power(experiment,
                          power_effects(effects, experiment.protocol, areas_of(experiment.objects)), settings,
                          [](std::string_view, int, int) {});
}

} // namespace

TEST_CASE("the power to find a share of fixations is that of a paired t test of binomial shares", "[unit]") {
    const Experiment experiment = busts(1);
    const std::string effect = "head:material=rough:odds=1.8";
    PowerSettings settings;
    settings.gaze.accuracy_deg = 0.0;
    const GazeStudies studies(experiment,
                              power_effects({effect}, experiment.protocol, areas_of(experiment.objects)),
                              settings.gaze);
    const StudyResults study = studies.study(5, 60);
    const double fixations = static_cast<double>(study.fixations.size()) / 120.0;
    // The number that the power below was reckoned with.
    CHECK(fixations == Approx(fixations_of_a_trial).epsilon(0.03));

    settings.observers = {8, 14};
    settings.studies = 400;
    const PowerResults results =
        simulate_power(experiment, studies.effects(), settings, [](std::string_view, int, int) {});
    // See fixations_of_a_trial; four standard errors of a share of 400, and what the tests differ by.
    CHECK(results.curves[0].points[0].share() == Approx(power_of_8).margin(0.12));
    CHECK(results.curves[0].points[1].share() == Approx(power_of_14).margin(0.12));
    CHECK(results.curves[0].points[1].median_estimate == Approx(0.545455 - 0.4).margin(0.01));
}

TEST_CASE("studies without an effect find one in 5 % of cases, whatever is tested", "[unit]") {
    const PowerResults results = power_of(busts(2), {"none"}, {8}, 200);
    REQUIRE(results.curves.size() == 4);
    for (const PowerCurve& curve : results.curves) {
        CAPTURE(curve.effect.text());
        // scipy.stats.binom.ppf(0.9995, 200, 0.05)
        CHECK(curve.points[0].found <= 21);
        CHECK(curve.points[0].without_test == 0);
    }
}

TEST_CASE("more observers find more", "[unit]") {
    const PowerResults results = power_of(
        busts(2),
        {"head:material=rough:odds=1.6", "wss:material=rough:ratio=0.85", "cc:material=rough:share=0.2"},
        {4, 7, 14}, 40);
    for (const PowerCurve& curve : results.curves) {
        CAPTURE(curve.effect.text());
        // Fewer than six cannot find anything.
        CHECK(curve.points[0].found == 0);
        CHECK(curve.points[1].found > 0);
        CHECK(curve.points[2].found >= curve.points[1].found);
        CHECK(curve.points[2].share() > 0.5);
    }
}

TEST_CASE("studies are the same on any number of threads, and with observers to follow", "[unit]") {
    const Experiment experiment = busts(2);
    const auto same = [](const PowerPoint& a, const PowerPoint& b) {
        return std::ranges::equal(a.studies, b.studies,
                                  [](const StudyOutcome& one, const StudyOutcome& other) {
                                      return one.p == other.p && one.estimate == other.estimate;
                                  });
    };
    const std::vector<std::string> effects{"head:material=rough:odds=1.6:sd=0.3", "cc:task=free:share=0.2"};
    const PowerResults one = power_of(experiment, effects, {6, 8}, 4, 1),
                       two = power_of(experiment, effects, {6, 8}, 4, 2),
                       six = power_of(experiment, effects, {6}, 4, 2);
    for (std::size_t curve = 0; curve < effects.size(); ++curve) {
        const PowerCurve &a = one.curves[curve], &b = two.curves[curve];
        CHECK(a.points[0].studies.size() == 4);
        CHECK(a.planted == b.planted);
        CHECK(same(a.points[0], b.points[0]));
        CHECK(same(a.points[1], b.points[1]));
        CHECK(same(a.points[0], six.curves[curve].points[0]));
        CHECK_FALSE(same(a.points[0], a.points[1]));
    }
}

TEST_CASE("a planted ratio of WSS is found in the trials of its level alone", "[unit]") {
    const Experiment experiment = busts(1);
    for (const double ratio : {0.8, 1.15}) {
        const std::vector<PowerEffect> effects =
            power_effects({fmt::format("wss:material=rough:ratio={}", ratio)}, experiment.protocol,
                          areas_of(experiment.objects));
        GazeStudies studies(experiment, effects, gaze_study_settings(experiment.protocol));
        const std::string said = plant_spread(studies, 0, 1, 0);
        if (ratio < 1.0) {
            GazeStudies alone(experiment, effects, gaze_study_settings(experiment.protocol));
            CHECK(plant_spread(alone, 0, 1, 1) == said);
        }
        const StudyResults study = studies.study(77, 300);
        double a = 0.0, b = 0.0;
        for (const auto& cell : compared_cells(studies, study, effects[0])) {
            for (const LevelComparison& one : cell) {
                const auto wss = [](const auto& fixations) {
                    std::vector<glm::dvec3> points;
                    for (const StudyFixation* fixation : fixations)
                        points.push_back(fixation->position);
                    return point_spread(points)->wss();
                };
                a += wss(one.a);
                b += wss(one.b);
            }
        }
        CHECK(a / b == Approx(ratio).margin(0.05));
    }
}

TEST_CASE("effects of factors and interactions have the p of their row in the analysis", "[unit]") {
    const Experiment experiment = busts(2);
    StudyOptions options;
    options.by = {"task", "material"};
    options.permutations = 1000;
    options.seed = 3;
    for (const std::string measure :
         {"head:material=rough:task=free:odds=3", "wss:material=rough:task=free:ratio=1"})
        for (const std::string test : {"factor", "interaction"}) {
            CAPTURE(measure, test);
            const std::vector<PowerEffect> effects =
                power_effects({measure + ":test=" + test}, experiment.protocol, areas_of(experiment.objects));
            const GazeStudies studies(experiment, effects, gaze_study_settings(experiment.protocol));
            StudyResults results = studies.study(7, 9);
            const std::vector<int> observers{7, 9};
            const std::vector<StudyOutcome> outcomes =
                tested(studies, results, effects[0], observers, {}, {5000, 100000, 3});
            REQUIRE(outcomes.size() == 2);
            CHECK(outcomes[0].p != outcomes[1].p);
            // With fewer observers it is that of the study of the first of them alone.
            const StudyResults of_seven = studies.study(7, 7);
            CHECK(tested(studies, of_seven, effects[0], std::vector<int>{7}, {}, {5000, 100000, 3}).at(0).p ==
                  outcomes[0].p);
            results.by = options.by;
            results.areas = results.compared_areas = {"head"};
            const std::string row = test == "factor" ? "material" : "task:material";
            int rows = 0;
            for (const FactorEffectRow& of : factor_effects(results, studies.levels(), options)) {
                if (of.effect != row ||
                    (of.measure == "log WSS") != (effects[0].measure == PowerMeasure::wss))
                    continue;
                ++rows;
                REQUIRE(of.p);
                CHECK(*outcomes[1].p == *of.p);
                CHECK(*outcomes[1].estimate == *of.statistic);
            }
            CHECK(rows == 1);
        }
}

TEST_CASE("effects of factors, interactions and clusters are found where they are planted, and nowhere else",
          "[unit]") {
    const Experiment experiment = busts(2);
    constexpr int observers = 10, studies = 40;
    // scipy.stats.binom.ppf(0.9995, 40, 0.05)
    constexpr int most_by_chance = 8;
    const auto found = [&](const std::string& effect) {
        return power_of(experiment, {effect}, {observers}, studies).curves[0].points[0].found;
    };
    // With two levels the effect of the factor has about the power that their difference has.
    const int of_pair = found("head:material=rough:odds=1.6"),
              of_factor = found("head:material=rough:odds=1.6:test=factor");
    CHECK(std::abs(of_pair - of_factor) <= 6);
    CHECK(of_factor > studies / 2);
    CHECK(found("head:material=rough:task=free:odds=3:test=interaction") > studies / 2);
    CHECK(found("head:material=rough:task=free:odds=1:test=interaction") <= most_by_chance);
    // Tasks differ by what is planted alone.
    CHECK(found("head:task=clothes:odds=1:test=factor") <= most_by_chance);
    CHECK(found("head:task=clothes:odds=1.6:test=factor") > studies / 2);
    CHECK(found("cc:material=rough:share=0.3:test=cluster") > studies / 2);
    CHECK(found("cc:material=rough:share=0:test=cluster") <= most_by_chance);
}

TEST_CASE("studies with looks find as often and end earlier", "[unit]") {
    PowerSettings settings;
    settings.observers = {8, 12, 16};
    settings.studies = 60;
    settings.sequential = AlphaSpending::pocock;
    const Experiment experiment = busts(1);
    settings.gaze = gaze_study_settings(experiment.protocol);
    const auto results_of = [&](const std::string& effect) {
        return simulate_power(experiment,
                              power_effects({effect}, experiment.protocol, areas_of(experiment.objects)),
                              settings, [](std::string_view, int, int) {});
    };
    const PowerResults strong = results_of("head:material=rough:odds=2.2");
    REQUIRE(strong.curves[0].sequential);
    CHECK(strong.curves[0].sequential->found.back() > 54);
    CHECK(strong.curves[0].sequential->mean_observers < 13.0);
    CHECK_THAT(answer_of(strong.curves[0], strong), Catch::Contains("observers on average"));
    const PowerResults nothing = results_of("head:material=rough:odds=1");
    CHECK(nothing.curves[0].sequential->found.back() <= 10);
    CHECK(nothing.curves[0].sequential->mean_observers > 15.0);
    settings.equivalence = 0.5;
    CHECK_THROWS_WITH(results_of("head:material=rough:odds=1"), Catch::Contains("--sequential"));
    settings.sequential.reset();
    CHECK_THROWS_WITH(results_of("head:material=rough:odds=1:test=factor"), Catch::Contains(":test="));
}

TEST_CASE("plans that cannot be are refused with what can", "[unit]") {
    using Catch::Contains;
    Experiment experiment = busts(1);
    CHECK_THROWS_WITH(power_of(experiment, {"wss:material=rough:ratio=9"}, {8}, 10),
                      Contains("WSS can be made") && Contains("at most"));
    CHECK_THROWS_AS(power_of(experiment, {"wss:material=rough:ratio=0.05"}, {8}, 10), InputError);
    experiment.protocol.groups.resize(1);
    experiment.protocol.groups[0].cap = 4;
    CHECK_THROWS_WITH(power_of(experiment, {"none"}, {8}, 10), Contains("groups take 4 observers"));
    Experiment without_mesh = busts(1);
    without_mesh.objects[0].mesh = {};
    CHECK_THROWS_WITH(power_of(without_mesh, {"none"}, {8}, 10), Contains("has no mesh"));
    Experiment once = busts(1);
    once.protocol.tasks[0].stimuli = TaskCoverage::once_per_object;
    const PowerResults nothing = power_of(once, {"head:material=rough:odds=2"}, {8}, 10);
    CHECK(nothing.curves[0].points[0].without_test == 10);
    CHECK(nothing.curves[0].points[0].found == 0);
    CHECK_THAT(nothing.remarks.at(0), Contains("nothing to test"));
}
