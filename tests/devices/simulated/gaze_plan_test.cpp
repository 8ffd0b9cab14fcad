#include "devices/simulated/gaze_plan.h"

#include <catch2/catch.hpp>

#include "devices/simulated/eye_movements.h"

#include <array>
#include <cmath>
#include <map>

#include "tests/devices/simulated/sitting.h"

using namespace overt;
using test::SimulatedSitting;

namespace {

ObservedScene scene_with(std::vector<ObservedEffect> effects, double sd = 0.0) {
    ObservedScene scene;
    scene.tasks = {{"a", {0.4}}, {"b", {0.0}}, {"c", {1.0}}};
    scene.effects = std::move(effects);
    scene.share_sd = sd;
    return scene;
}

/// For each list, the entries of a scene of three that an effect holds in; -1: all.
std::array<std::vector<bool>, stimulus_lists.size()> entries(int object, int material) {
    std::array<std::vector<bool>, stimulus_lists.size()> chosen;
    for (const auto& [list, entry] : {std::pair{0, object}, {1, material}}) {
        if (entry >= 0) {
            chosen[static_cast<std::size_t>(list)].assign(3, false);
            chosen[static_cast<std::size_t>(list)][static_cast<std::size_t>(entry)] = true;
        }
    }
    return chosen;
}

/// The middle of a mesh by area, a plinth's counting a tenth, and the mean square distance from it.
std::pair<glm::dvec3, double> middle_and_square(const Mesh& mesh) {
    glm::dvec3 middle(0.0);
    double square = 0.0, all = 0.0;
    const auto visit = [&](const auto& take) {
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const glm::uvec3 t = mesh.triangles[i];
            const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
            const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
            take((a + b + c) / 3.0, mesh.part_names[mesh.triangle_parts[i]] == "plinth" ? 0.1 * area : area);
        }
    };
    visit([&](const glm::dvec3& centre, double weight) {
        middle += weight * centre;
        all += weight;
    });
    middle /= all;
    visit([&](const glm::dvec3& centre, double weight) {
        square += weight * glm::dot(centre - middle, centre - middle) / all;
    });
    return {middle, square};
}

double logit(double share) { return std::log(share / (1.0 - share)); }

} // namespace

TEST_CASE("effects multiply the odds of the head in their trials, and in no others", "[unit]") {
    const ObservedScene scene = scene_with(
        {{.task = 0, .entries = entries(-1, 1), .odds = 2.0}, {.entries = entries(2, -1), .odds = 3.0}});
    const auto share = [&](int task, Stimulus stimulus) {
        return gaze_plan(scene, 7, task, stimulus).shares[0];
    };
    CHECK(share(0, {0, 0}) == 0.4);
    // Odds of 0.4 are 2 / 3.
    CHECK(share(0, {0, 1}) == Approx(4.0 / 7.0));
    CHECK(share(0, {2, 0}) == Approx(2.0 / 3.0));
    CHECK(share(0, {2, 1}) == Approx(4.0 / 5.0));
    // What never happens, or always, has no odds.
    CHECK(share(1, {2, 1}) == 0.0);
    CHECK(share(2, {2, 1}) == 1.0);
}

TEST_CASE("simulated observers differ by the standard deviation that is stated, each the same in all trials",
          "[unit]") {
    const ObservedScene scene = scene_with({}, 0.6);
    double sum = 0.0, squares = 0.0;
    constexpr int observers = 4000;
    for (int seed = 0; seed < observers; ++seed) {
        const auto off = [&](Stimulus stimulus) {
            return logit(gaze_plan(scene, static_cast<std::uint64_t>(seed), 0, stimulus).shares[0]) -
                   logit(0.4);
        };
        const double inclination = off({0, 0});
        REQUIRE(off({1, 2}) == inclination);
        sum += inclination;
        squares += inclination * inclination;
    }
    // Four standard errors of a mean and of a standard deviation.
    CHECK(std::abs(sum / observers) < 4.0 * 0.6 / std::sqrt(observers));
    CHECK(std::sqrt(squares / observers) == Approx(0.6).margin(4.0 * 0.6 / std::sqrt(2.0 * observers)));
}

TEST_CASE("an effect's spot gets its share of the fixations, the same spot of every observer", "[unit]") {
    std::map<std::uint64_t, glm::dvec3> middles;
    for (const std::uint64_t seed : {1u, 2u}) {
        const SimulatedSitting plain(seed);
        ObservedScene scene = plain.observer.scene();
        scene.effects = {{.entries = entries(-1, 0), .spot_share = 0.3}};
        const double radius = GazeTargets::spot_radius * plain.mesh.bounds().extent().z;
        SimulatedObserver observer(scene, seed);
        // Where fixations of a plan that goes nowhere else lie.
        ObservedScene only = scene;
        only.effects[0].spot_share = 1.0;
        const GazeTargets targets(only.objects[0], only);
        RandomStream random(seed, "spot");
        glm::dvec3 middle(0.0);
        for (int i = 0; i < 2000; ++i)
            middle += targets.draw_from_spot(random, 0).position / 2000.0;
        middles[seed] = middle;
        int in_spot = 0, of_another_material = 0, all = 0, of_the_others = 0;
        for (int trial = 0; trial < 300; ++trial) {
            const int material = trial % 2;
            GazeScript script(scene, {});
            const PursuedTurn turn(scene);
            script.compose(scene, &targets, turn, {}, seed, trial, gaze_plan(scene, seed, 0, {0, material}));
            for (const ScriptedFixation& fixation : script.fixations()) {
                if (!fixation.target)
                    continue;
                const bool is_near = glm::distance(fixation.target->position, middle) < 2.0 * radius;
                (material == 0 ? all : of_the_others) += 1;
                (material == 0 ? in_spot : of_another_material) += is_near;
            }
        }
        REQUIRE(all > 2000);
        const double by_chance = static_cast<double>(of_another_material) / of_the_others;
        CHECK(by_chance < 0.1);
        const double expected = 0.3 + 0.7 * by_chance;
        CHECK(static_cast<double>(in_spot) / all ==
              Approx(expected).margin(4.0 * std::sqrt(0.25 / all) + 0.01));
    }
    CHECK(glm::distance(middles[1], middles[2]) < 1e-2 * glm::length(middles[1]) + 1e-6);
}

TEST_CASE("a spread of gaze prefers places far from the middle or near it, in head and body alike",
          "[unit]") {
    const SimulatedSitting sitting(1);
    const ObservedScene scene = sitting.observer.scene();
    const GazeTargets targets(scene.objects[0], scene);
    const std::vector<std::string>& parts = sitting.mesh.part_names;
    for (const std::size_t region : {std::size_t{0}, targets.elsewhere()}) {
        constexpr int draws = 20000;
        RandomStream random(3, "by area");
        std::vector<SurfacePoint> everywhere;
        for (int i = 0; i < draws; ++i) {
            everywhere.push_back(targets.draw(random, region));
            CHECK((parts[everywhere.back().part] == "head") == (region == 0));
        }
        const auto [centre, square] = middle_and_square(sitting.mesh);
        for (const double spread : {-1.0, 0.5}) {
            // Draws by area alone, weighed as the plan says.
            double expected = 0.0, weights = 0.0, found = 0.0;
            for (const SurfacePoint& point : everywhere) {
                const glm::dvec3 off = point.position - centre;
                const double r2 = glm::dot(off, off) / square, weight = std::exp(spread * r2);
                expected += weight * r2;
                weights += weight;
            }
            for (int i = 0; i < draws; ++i) {
                const SurfacePoint point = targets.draw(random, region, spread);
                CHECK((parts[point.part] == "head") == (region == 0));
                const glm::dvec3 off = point.position - centre;
                found += glm::dot(off, off) / square / draws;
            }
            CHECK(found == Approx(expected / weights).epsilon(0.02));
        }
    }
}

TEST_CASE("spreads and spots of the effects that hold in a trial add up", "[unit]") {
    const ObservedScene scene = scene_with({{.task = 0, .entries = entries(-1, 1), .spread = 0.4},
                                            {.entries = entries(2, -1), .spot_share = 0.2, .spread = -0.1},
                                            {.entries = entries(-1, -1), .spot_share = 0.1}});
    const auto plan = [&](int task, Stimulus stimulus) { return gaze_plan(scene, 7, task, stimulus); };
    CHECK(plan(0, {0, 0}).spread == 0.0);
    CHECK(plan(0, {0, 1}).spread == 0.4);
    CHECK(plan(0, {2, 0}).spread == -0.1);
    CHECK(plan(0, {2, 1}).spread == Approx(0.3));
    CHECK(plan(1, {0, 1}).spread == 0.0);
    CHECK(plan(0, {0, 0}).spot_count == 1);
    const GazePlan both = plan(0, {2, 1});
    REQUIRE(both.spot_count == 2);
    CHECK(both.spots[0].effect == 1);
    CHECK(both.spots[0].share == 0.2);
    CHECK(both.spots[1].effect == 2);
    CHECK(both.spots[1].share == 0.1);
}

TEST_CASE("an area that is favoured gains by its odds what all others lose in proportion", "[unit]") {
    GazePlan plan;
    plan.area_count = 2;
    plan.shares = {0.2, 0.4};
    GazePlan favoured = plan;
    favour_area(favoured, {.area = 1, .odds = 3.0});
    // Odds of 0.4 are 2 / 3, three times that is 2.
    CHECK(favoured.shares[1] == Approx(2.0 / 3.0));
    CHECK(favoured.shares[0] == Approx(0.2 / 0.6 * (1.0 / 3.0)));
    for (const int area : {-1, 2}) {
        favoured = plan;
        favour_area(favoured, {.area = area, .odds = 3.0});
        CHECK(favoured.shares == plan.shares);
    }
    favoured = plan;
    favour_area(favoured, {.area = 0, .odds = 1.0});
    CHECK(favoured.shares[0] == Approx(0.2));
}

TEST_CASE("the eye closes once in each stretch of a minute over the rate, for 0.1 to 0.2 s", "[unit]") {
    for (const double rate : {15.0, 40.0, 400.0}) {
        CAPTURE(rate);
        const BlinkTrain blinks(5, rate);
        const double stretch_s = 60.0 / rate;
        constexpr double step_s = 0.001;
        double shortest_s = 1.0, longest_s = 0.0, earliest = 1.0, latest = 0.0;
        for (int stretch = 0; stretch < 200; ++stretch) {
            int begins = 0;
            double closed_s = 0.0;
            bool was_closed = false;
            for (double at = 0.5 * step_s; at < stretch_s; at += step_s) {
                const bool is_closed =
                    blinks.eye_closed_at(SessionTime() + from_seconds(stretch * stretch_s + at));
                if (is_closed && !was_closed) {
                    ++begins;
                    earliest = std::min(earliest, at / stretch_s);
                    latest = std::max(latest, at / stretch_s);
                }
                closed_s += is_closed ? step_s : 0.0;
                was_closed = is_closed;
            }
            CHECK(begins == 1);
            shortest_s = std::min(shortest_s, closed_s);
            longest_s = std::max(longest_s, closed_s);
        }
        CHECK(shortest_s >= 0.1 - step_s);
        CHECK(longest_s <= std::min(0.2, stretch_s) + step_s);
        CHECK(shortest_s < 0.11);
        CHECK(longest_s > (rate < 400.0 ? 0.19 : 0.14));
        if (rate == 15.0) {
            CHECK(earliest < 0.05); // anywhere in it
            CHECK(latest > 0.9);
        }
    }
    CHECK_FALSE(BlinkTrain(5, 0.0).eye_closed_at(SessionTime() + from_seconds(1.0)));
    int different = 0;
    for (int i = 0; i < 4000; ++i) {
        const SessionTime at = SessionTime() + from_seconds(0.05 * i);
        different += BlinkTrain(5, 15.0).eye_closed_at(at) != BlinkTrain(6, 15.0).eye_closed_at(at);
    }
    CHECK(different > 50);
}

TEST_CASE("a fixating eye wanders with the standard deviations that are asked for, slowly and fast",
          "[unit]") {
    for (const auto& [drift_deg, tremor_deg] : {std::pair{0.1, 0.0}, {0.0, 0.02}, {0.1, 0.04}}) {
        const FixationalMotion motion(9, Degrees{drift_deg}, Degrees{tremor_deg});
        constexpr int count = 400'000;
        constexpr double step_s = 0.0013;
        glm::dvec2 sum(0.0), squares(0.0);
        int turns = 0;
        double before = 0.0, slope = 0.0;
        for (int i = 0; i < count; ++i) {
            const glm::dvec2 at = motion.displacement_deg(SessionTime() + from_seconds(step_s * i));
            sum += at;
            squares += at * at;
            turns += i > 1 && (at.x - before) * slope < 0.0;
            slope = at.x - before;
            before = at.x;
        }
        for (int axis = 0; axis < 2; ++axis) {
            CHECK(std::abs(sum[axis] / count) < 0.01 * (drift_deg + tremor_deg));
            CHECK(std::sqrt(squares[axis] / count) ==
                  Approx(std::hypot(drift_deg, tremor_deg)).epsilon(0.03));
        }
        const double turns_per_s = turns / (count * step_s);
        if (tremor_deg == 0.0)
            CHECK(turns_per_s < 6.0); // below 3 Hz
        else if (drift_deg == 0.0)
            CHECK(turns_per_s == Approx(2.0 * 85.0).margin(2.0 * 20.0));
    }
    RandomStream random(4, "log-normal");
    std::vector<double> drawn;
    for (int i = 0; i < 20'000; ++i)
        drawn.push_back(log_normal_within(random, 0.25, 0.4, 0.1, 0.6));
    std::ranges::sort(drawn);
    CHECK(drawn.front() >= 0.1);
    CHECK(drawn.back() <= 0.6);
    CHECK(drawn[10'000] == Approx(0.25).epsilon(0.02));
    // Of the logarithms between the quartiles a normal number has 1.349 standard deviations.
    CHECK(std::log(drawn[15'000] / drawn[5'000]) == Approx(1.349 * 0.4).epsilon(0.06));
    CHECK(log_normal_within(random, 0.25, 0.4, 5.0, 6.0) == 5.0);
}

TEST_CASE("a favour of an area that a plan has not changes nothing", "[unit]") {
    GazePlan plan;
    plan.area_count = 2;
    plan.shares = {0.2, 0.4};
    for (const int area : {-1, 2, 3}) {
        GazePlan favoured = plan;
        favour_area(favoured, {-1, 0.0, area, 5.0});
        CHECK(favoured.shares == plan.shares);
    }
    favour_area(plan, {-1, 0.0, 1, 5.0});
    CHECK(plan.shares[1] == Approx(2.0 / 2.6));
}

TEST_CASE("odds below one take from an area, spots have a share, and no more are kept than there is room for",
          "[unit]") {
    ObservedScene scene = scene_with({{.entries = entries(-1, -1), .odds = 0.25}});
    // Odds of 0.4 are 2 / 3, a quarter of that 1 / 6.
    CHECK(gaze_plan(scene, 7, 0, {0, 0}).shares[0] == Approx(1.0 / 7.0));
    CHECK(gaze_plan(scene, 7, 0, {0, 0}).spot_count == 0);
    scene.effects.assign(most_simulated_spots + 2, {.entries = entries(-1, -1), .spot_share = 0.05});
    scene.effects[1].spot_share = 0.0;
    const GazePlan plan = gaze_plan(scene, 7, 0, {0, 0});
    REQUIRE(plan.spot_count == most_simulated_spots);
    for (int i = 0; i < plan.spot_count; ++i)
        CHECK(plan.spots[static_cast<std::size_t>(i)].effect == (i == 0 ? 0 : i + 1));
    CHECK(plan.shares[0] == 0.4);
}

TEST_CASE("what is drawn again and again stays within its bounds, and ends after a thousand times",
          "[unit]") {
    for (const auto& [median, low, high, known] :
         {std::tuple(1.0, 10.0, 11.0, 10.0), {20.0, 10.0, 11.0, 11.0}}) {
        RandomStream random(4, "bounds"), counted(4, "bounds");
        CHECK(log_normal_within(random, median, 0.01, low, high) == known);
        for (int i = 0; i < 1000; ++i)
            counted.normal();
        CHECK(random.uniform() == counted.uniform());
    }
    CHECK_FALSE(BlinkTrain(3, 0.0).eye_closed_at(SessionTime(std::chrono::seconds(5))));
    // A blink in two minutes is one all the same.
    const BlinkTrain seldom(3, 0.5);
    int closed = 0;
    for (int i = 0; i < 12'000; ++i)
        closed += seldom.eye_closed_at(SessionTime(i * std::chrono::milliseconds(10)));
    CHECK(closed >= 9);
    CHECK(closed <= 21);
}

TEST_CASE(
    "areas that have all fixations among them share them by their odds, and none of no odds is a number",
    "[unit]") {
    ObservedScene scene;
    scene.areas = {"head", "rim"};
    scene.tasks = {{"both", {0.5, 0.5}}, {"one", {1.0, 0.0}}};
    ObservedEffect effect;
    effect.area = 0;
    effect.odds = 3.0;
    scene.effects = {effect};
    CHECK(gaze_plan(scene, 1, 0, {}).shares[0] == Approx(0.75));
    CHECK(gaze_plan(scene, 1, 0, {}).shares[1] == Approx(0.25));
    CHECK(gaze_plan(scene, 1, 1, {}).shares[0] == 1.0);
    scene.effects[0].odds = 0.0;
    CHECK(gaze_plan(scene, 1, 0, {}).shares[0] == 0.0);
    CHECK(gaze_plan(scene, 1, 0, {}).shares[1] == Approx(1.0));
    CHECK(gaze_plan(scene, 1, 1, {}).shares[0] == 1.0); // nothing is left that could be looked at instead
}

TEST_CASE("where no draw lies between the bounds, the median does, or the bound that is next to it",
          "[unit]") {
    RandomStream random(1, "bounds");
    CHECK(log_normal_within(random, 1.0, 1e-9, 2.0, 3.0) == 2.0);
    CHECK(log_normal_within(random, 5.0, 1e-9, 2.0, 3.0) == 3.0);
    CHECK(log_normal_within(random, 2.5, 1e-9, 2.0, 3.0) == Approx(2.5));
    CHECK(log_normal_within(random, 2.5, 0.0, 2.5, 2.5) == 2.5);
}
