/// Shares of four areas, planted in simulated observers, come back as often as their intervals say.
#include <algorithm>
#include <array>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "app/power/gaze_studies.h"
#include "app/power/power_simulation.h"
#include "devices/simulated/gaze_plan.h"
#include "experiment/study/area_shares.h"
#include "experiment/study/surface_transitions.h"
#include "tests/support/figures.h"

using namespace overt;

namespace {

struct PlantedArea {
    const char* name;
    double share;
};
/// What they leave goes to the bar between them.
constexpr PlantedArea planted[]{
    {"north-west", 0.35}, {"north-east", 0.25}, {"south-west", 0.15}, {"south-east", 0.1}};

/// Four balls on a bar, in two materials.
Experiment four_balls() {
    Experiment experiment;
    Protocol& protocol = experiment.protocol;
    protocol.name = "balls";
    protocol.objects.resize(1);
    protocol.objects[0].id = "balls";
    protocol.materials.resize(2);
    protocol.materials[0].id = "smooth";
    protocol.materials[1].id = "rough";
    Task task;
    task.id = "free";
    for (const PlantedArea& area : planted)
        task.simulated_area_shares.emplace_back(area.name, area.share);
    protocol.tasks = {task};
    protocol.schedule.max_object_run = 0;
    protocol.views.front().width_px = protocol.views.front().height_px = 512;
    Object balls;
    balls.id = "balls";
    Mesh mesh;
    test::add_part(mesh, test::box({-20.0, -10.0, 0.0}, {20.0, 10.0, 300.0}), "body");
    for (std::size_t i = 0; i < std::size(planted); ++i)
        test::add_part(mesh, test::ball({i % 2 ? 80.0 : -80.0, -10.0, i < 2 ? 220.0 : 80.0}, 55.0),
                       planted[i].name);
    const View view{fit_camera(mesh, {11.9}, {512, 512}, {25.0}, 0.06), {512, 512}};
    balls.scenes = {{view, mesh.bounds()}};
    balls.mesh = std::move(mesh);
    experiment.objects.push_back(std::move(balls));
    return experiment;
}

/// A study without an error of the tracker.
StudyResults study_of(const GazeStudies& studies, std::uint64_t seed, int observers) {
    StudyResults results = studies.study(seed, observers);
    StudyOptions options;
    options.by.clear();
    name_areas(results, options);
    results.groups = make_groups(results, {}, {});
    return results;
}

} // namespace

TEST_CASE(
    "planted shares of four areas, and transitions by these shares alone, come back within their intervals",
    "[unit]") {
    const Experiment experiment = four_balls();
    GazeStudySettings settings = gaze_study_settings(experiment.protocol);
    settings.accuracy_deg = 0.0;
    const GazeStudies studies(experiment, {}, settings);
    StudyOptions options;
    options.by.clear();
    int shares = 0, transitions = 0;
    std::array<double, std::size(planted)> means{};
    constexpr int count = 40, observers = 12;
    for (int number = 0; number < count; ++number) {
        const StudyResults results = study_of(studies, static_cast<std::uint64_t>(number), observers);
        const auto rows = area_rows(results, {}, options);
        const auto moves = surface_transitions(results, {}, options);
        for (std::size_t i = 0; i < std::size(planted); ++i) {
            const auto row = std::ranges::find(rows, planted[i].name, &AreaRow::area);
            REQUIRE(row != rows.end());
            shares += row->by_count.interval->contains(planted[i].share);
            means[i] += *row->by_count.value / count;
            for (const PlantedArea& from : planted) {
                const auto move = std::ranges::find_if(moves, [&](const SurfaceTransitionRow& of) {
                    return of.from == from.name && of.to == planted[i].name;
                });
                REQUIRE(move != moves.end());
                transitions += move->probability.interval->contains(planted[i].share);
            }
        }
    }
    // Of 160 independent intervals at 95 %, 137 or fewer hold the truth once in 183,000 times: the binomial
    // distribution, by Python's math.comb. The bootstrap of twelve observers is a little short of its level.
    INFO(shares << " of 160 shares, " << transitions << " of 640 transitions");
    CHECK(shares >= 138);
    CHECK(transitions >= 560);
    for (std::size_t i = 0; i < std::size(planted); ++i)
        CHECK(means[i] == Approx(planted[i].share).margin(0.01));
}

TEST_CASE("an effect on any area is found, and one on an area that nobody has is refused by name", "[unit]") {
    const Experiment experiment = four_balls();
    const std::vector<std::string> areas = areas_of(experiment.objects);
    PowerSettings settings;
    settings.observers = {10};
    settings.studies = 60;
    settings.gaze = gaze_study_settings(experiment.protocol);
    settings.gaze.accuracy_deg = 0.0;
    const auto found = [&](const std::string& effect) {
        const PowerResults results =
            simulate_power(experiment, power_effects({effect}, experiment.protocol, areas), settings,
                           [](std::string_view, int, int) {});
        return results.curves[0].points[0].share();
    };
    CHECK(found("area=south-east:material=rough:odds=4") > 0.8);
    CHECK(found("area=north-west:material=rough:odds=1") < 0.2);
    const auto refusal = [&](const std::string& effect) {
        try {
            power_effects({effect}, experiment.protocol, areas);
        } catch (const std::exception& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK_THAT(refusal("head:material=rough:odds=2"),
               Catch::Contains("no object has an area \"head\"") && Catch::Contains("south-east"));
    CHECK_THAT(refusal("area=body:material=rough:odds=2"),
               Catch::Contains("no task says how often \"body\" is looked at"));
    const std::vector<PowerEffect> none = power_effects({"none"}, experiment.protocol, areas);
    CHECK(none.front().area == "north-west");
}

TEST_CASE("odds on one area take from all else in proportion", "[unit]") {
    ObservedScene scene;
    scene.areas = {"head", "rim", "base"};
    scene.tasks = {{"free", {0.0, 0.4, 0.2}}};
    scene.effects.resize(1);
    scene.effects[0].entries[1] = {false, true};
    scene.effects[0].area = 1;
    scene.effects[0].odds = 3.0;
    const GazePlan plain = gaze_plan(scene, 1, 0, {0, 0}), changed = gaze_plan(scene, 1, 0, {0, 1});
    CHECK(plain.shares[1] == 0.4);
    CHECK(plain.shares[2] == 0.2);
    CHECK(changed.shares[1] / (1.0 - changed.shares[1]) == Approx(3.0 * 0.4 / 0.6));
    CHECK(changed.shares[2] / (1.0 - changed.shares[1]) == Approx(0.2 / 0.6));
    CHECK(changed.shares[0] == 0.0);
}
