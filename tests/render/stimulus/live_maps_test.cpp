#include "render/gl/headless_context.h"
#include "render/stimulus/live_maps.h"

#include <catch2/catch.hpp>

#include "tests/support/figures.h"
#include "tests/support/gl_contexts.h"

using namespace overt;

namespace {

constexpr glm::ivec2 small_px{96, 96};

std::vector<Object> one_bust() {
    Object bust;
    bust.id = "bust";
    bust.mesh = test::bust();
    bust.scenes = {{{fit_camera(bust.mesh, {12.0}, small_px, {25.0}, 0.05), small_px}, bust.mesh->bounds()}};
    std::vector<Object> objects;
    objects.push_back(std::move(bust));
    return objects;
}

/// As a session would: a presentation of all frames, twice over.
void present(LiveMaps& live, const Animation& animation, const PoseTable& poses) {
    live.presentation_begins({0, 0, {0, 0}}, 0);
    for (int step = 0; step < 2 * animation.steps_per_period(); ++step) {
        const AnimationFrameIndex frame = animation.frame_at_step(step);
        FlipRecord flip;
        flip.shown = frame;
        flip.pose = poses.pose_of(0, frame);
        live.flipped(flip);
    }
    live.screen_shown({}, {});
}

} // namespace

TEST_CASE("maps drawn while frames are shown are those drawn before, each pose once", "[gl]") {
    const std::vector<Object> objects = one_bust();
    const Animation animation;
    const PoseTable poses = distinct_poses(animation);
    const Protocol protocol;
    for (const ContextKind kind : test::headless_kinds) {
        const auto context = make_headless_context(kind);
        LiveMaps live(*context, protocol, objects, poses);
        present(live, animation, poses);
        const std::vector<LiveMap> maps = live.take_finished();
        REQUIRE(maps.size() == poses.angles.size());
        CoordinatePass pass(*context, small_px);
        const MeshBuffers buffers(*context, objects[0].mesh);
        for (std::size_t i = 0; i < maps.size(); ++i) {
            CHECK(maps[i].pose.value == static_cast<int>(i));
            CHECK(maps[i].map.codes == pass.draw(buffers, objects[0].scene(), poses.angles[i]));
        }
        present(live, animation, poses);
        CHECK(live.take_finished().empty());
    }
}
