/// Looking at an object that is turned by hand.
#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/scene/orbit.h"

using namespace overt;

namespace {

SceneView a_scene() {
    SceneView scene;
    scene.bounds = {{-0.4, -0.3, 0.0}, {0.5, 0.3, 2.0}};
    scene.view.camera = {{0.05, -9.0, 1.0}, scene.bounds.centre(), {14.0}};
    scene.view.image_px = {200, 200};
    return scene;
}

} // namespace

TEST_CASE("without a drag an object is seen as its protocol shows it", "[unit]") {
    const SceneView scene = a_scene(), seen = seen_from(scene, {});
    CHECK(glm::length(seen.view.camera.position - scene.view.camera.position) < 1e-12);
    CHECK(seen.view.camera.target == scene.view.camera.target);
}

TEST_CASE("tilting leads the camera over a sphere about its target, and the wheel nearer by tenths",
          "[unit]") {
    const SceneView scene = a_scene();
    const auto distance = [](const SceneView& seen) {
        return glm::length(seen.view.camera.position - seen.view.camera.target);
    };
    Orbit orbit;
    orbit.drag({0.0, 60.0});
    CHECK(orbit.elevation_deg == Approx(30.0));
    const SceneView tilted = seen_from(scene, orbit);
    CHECK(distance(tilted) == Approx(distance(scene)));
    CHECK(tilted.view.camera.position.z - scene.view.camera.target.z == Approx(0.5 * distance(scene)));
    orbit.zoom(2.0);
    CHECK(distance(seen_from(scene, orbit)) == Approx(0.81 * distance(scene)));
    orbit.zoom(-2.0);
    CHECK(distance(seen_from(scene, orbit)) == Approx(distance(scene)));
}

TEST_CASE("no drag and no wheel brings the camera into the space that the object sweeps", "[unit]") {
    RandomStream random(3, "orbits");
    for (int i = 0; i < 500; ++i) {
        Orbit orbit;
        for (int step = 0; step < 20; ++step) {
            orbit.drag({random.uniform(-400.0, 400.0), random.uniform(-400.0, 400.0)});
            orbit.zoom(random.uniform(-3.0, 6.0));
        }
        const SceneView seen = seen_from(a_scene(), orbit);
        CHECK_NOTHROW(depth_range(seen.bounds, seen.view));
    }
}
