#include "render/stimulus/given_maps.h"

#include <fstream>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/scene/ray_caster.h"
#include "tests/support/figures.h"
#include "tests/support/temporary_folder.h"

using namespace overt;

namespace {

/// A bust as another program maps it: by rays, with 16-bit codes, a file for each of five frames.
struct GivenBust {
    GivenBust() {
        protocol.views.front().width_px = 60;
        protocol.views.front().height_px = 80;
        protocol.motions.front().frame_count = 5;
        ObjectSettings object;
        object.id = "bust";
        object.lut = (folder.path() / "map_##.png").string();
        object.areas = {{"head", {{0.0, -10.0, 245.0, 55.0}}, {}, {}, {}}};
        protocol.objects.push_back(object);
        scene.view.image_px = {60, 80};
        scene.bounds = mesh.bounds();
        scene.view.camera = fit_camera(mesh, {12.0}, scene.view.image_px, {25.0}, 0.05);
        const RayCaster rays(mesh);
        for (int frame = 0; frame < 5; ++frame) {
            const ObjectPose angle = protocol.motions.front().object_in({frame});
            CoordinateImage image(scene.view.image_px);
            for (int y = 0; y < 80; ++y) {
                for (int x = 0; x < 60; ++x) {
                    const Ray ray =
                        to_object(scene.view.ray_through({x + 0.5, y + 0.5}), scene.pose_at(angle));
                    if (const auto hit = rays.first_hit(ray))
                        image.at(x, y) = glm::vec4(hit->position, 1.0f);
                }
            }
            MapDescription description;
            description.bounds = scene.bounds;
            description.scale = 65535;
            description.camera = scene.view.camera;
            description.angle = angle.angle;
            write_coordinate_png(lut_file(protocol.objects[0], {frame}), image, description);
        }
    }
    ObjectSettings& settings() { return protocol.objects[0]; }
    std::filesystem::path file(int frame) const { return lut_file(protocol.objects[0], {frame}); }

    test::TemporaryFolder folder;
    Mesh mesh = test::bust();
    SceneView scene;
    Protocol protocol;
};

} // namespace

TEST_CASE("ready-made maps are read with what stands beside them, and the head is told by its place",
          "[unit]") {
    GivenBust given;
    const CoordinateImageFile map = read_given_map(given.protocol, 0, {1});
    CHECK(map.description.object == "bust");
    CHECK(map.description.frame == 1);
    CHECK(map.description.angle->value == Approx(25.0));
    CHECK(map.description.camera->position == given.scene.view.camera.position);
    int head = 0, body = 0;
    for (std::size_t i = 0; i < map.image.pixels.size(); ++i) {
        if (map.image.pixels[i].w == 0.0f)
            continue;
        (map.image.parts[i] == 1 ? head : body) += 1;
        CHECK((map.image.parts[i] == 1) == (map.image.pixels[i].z > 190.1f)); // the ball floats above the box
    }
    CHECK(head > 100);
    CHECK(body > 300);
    CHECK(check_given_maps(given.protocol, 0).empty());
}

TEST_CASE("the protocol can say what a map means, and then nothing need stand beside it", "[unit]") {
    GivenBust given;
    for (int frame = 0; frame < 5; ++frame)
        std::filesystem::remove(sidecar_of(given.file(frame)));
    CHECK_THROWS_WITH(read_given_map(given.protocol, 0, {0}), Catch::Contains("lut_scale"));
    given.settings().lut_scale = 65535;
    given.settings().lut_min = given.scene.bounds.min;
    given.settings().lut_max = given.scene.bounds.max;
    CHECK(read_given_map(given.protocol, 0, {0}).description.bounds->max == given.scene.bounds.max);
    const std::vector<std::string> remarks = check_given_maps(given.protocol, 0);
    REQUIRE(remarks.size() == 1);
    CHECK_THAT(remarks[0], Catch::Contains("depth and incidence will be missing"));
    given.protocol.views.front().camera_position = given.scene.view.camera.position;
    given.protocol.views.front().vertical_fov_deg = 12.0;
    CHECK(check_given_maps(given.protocol, 0).empty());
}

TEST_CASE("a map of another size, of another angle or of another place than its head is refused", "[unit]") {
    GivenBust given;
    given.protocol.views.front().width_px = 64;
    CHECK_THROWS_WITH(read_given_map(given.protocol, 0, {0}), Catch::Contains("map_00.png") &&
                                                                  Catch::Contains("60 x 80") &&
                                                                  Catch::Contains("64 x 80"));
    given.protocol.views.front().width_px = 60;
    given.protocol.motions.front().amplitude = {20.0};
    CHECK_NOTHROW(read_given_map(given.protocol, 0, {0})); // straight ahead in either
    CHECK_THROWS_WITH(read_given_map(given.protocol, 0, {1}),
                      Catch::Contains("25 degrees") && Catch::Contains("20"));
    given.protocol.motions.front().amplitude = {25.0};
    given.settings().areas[0].spheres = {{0.0, 0.0, 2450.0, 55.0}};
    CHECK_THROWS_WITH(check_given_maps(given.protocol, 0), Catch::Contains("no pixel"));
    std::filesystem::remove(given.file(1));
    CHECK_THROWS_WITH(check_given_maps(given.protocol, 0), Catch::Contains("map_01.png"));
}

TEST_CASE("the hash of a ready-made map follows all that it is made from", "[unit]") {
    GivenBust given;
    std::vector<ContentHash> hashes{hash_of_given_map(given.protocol, 0, {0})};
    CHECK(hash_of_given_map(given.protocol, 0, {0}) == hashes[0]);
    const auto note = [&] {
        const ContentHash hash = hash_of_given_map(given.protocol, 0, {0});
        CHECK(std::find(hashes.begin(), hashes.end(), hash) == hashes.end());
        hashes.push_back(hash);
    };
    given.settings().areas[0].spheres[0][3] = 50.0;
    note();
    given.settings().lut_min = glm::dvec3(0.0);
    note();
    std::ofstream(sidecar_of(given.file(0)), std::ios::app) << " ";
    note();
    std::filesystem::copy_file(given.file(1), given.file(0),
                               std::filesystem::copy_options::overwrite_existing);
    note();
}
