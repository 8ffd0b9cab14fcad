#include "devices/simulated/gaze_script.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "tests/devices/simulated/sitting.h"

using namespace overt;

TEST_CASE("a region that is small against saccades gets the fixations that are planned for it", "[unit]") {
    const Mesh mesh = test::bust();
    const ObservedScene scene = test::scene_with(mesh);
    const GazeTargets targets(scene.objects[0], scene);
    const PursuedTurn turn(scene);
    GazePlan plan;
    plan.shares[0] = 0.6;
    plan.area_count = 1;
    // The head is 5 degrees wide: few of its places are 4 degrees from another.
    for (const double shortest_deg : {0.75, 4.0}) {
        CAPTURE(shortest_deg);
        const ObserverSettings settings{.shortest_saccade = Degrees{shortest_deg}};
        GazeScript script(scene, settings);
        int heads = 0, all = 0, near = 0;
        for (int trial = 0; trial < 100; ++trial) {
            script.compose(scene, &targets, turn, settings, 3, trial, plan);
            const auto& fixations = script.fixations();
            for (std::size_t i = 1; i < fixations.size(); ++i) {
                REQUIRE(fixations[i].target);
                heads += mesh.part_names[fixations[i].target->part] == "head";
                ++all;
                const auto place = [&](const ScriptedFixation& of) {
                    return place_of(of, fixations[i - 1].end, scene, &targets, turn);
                };
                const Degrees way = scene.screen.angle_between(place(fixations[i - 1]), place(fixations[i]));
                near += way.value < shortest_deg;
            }
        }
        // 3.29 standard errors: chance goes beyond once in a thousand.
        CHECK(std::abs(heads - 0.6 * all) < 3.29 * std::sqrt(0.6 * 0.4 * all));
        if (shortest_deg < 1.0)
            CHECK(near == 0);
        else
            CHECK(near > 0);
    }
}
