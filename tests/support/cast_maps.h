/// Maps of figures without any OpenGL: by rays through the pixel centres.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "experiment/maps/coordinate_maps.h"
#include "experiment/scene/ray_caster.h"
#include "tests/support/figures.h"

namespace overt::test {

/// A mesh in front of its camera, with what rays say of it.
struct CastScene {
    Mesh mesh;
    SceneView scene;
    std::vector<ObjectPose> angles;
    std::unique_ptr<RayCaster> rays;

    CastScene(Mesh of, std::vector<ObjectPose> turned, glm::ivec2 image_px = {160, 160}, double margin = 0.05)
        : mesh(std::move(of)), angles(std::move(turned)) {
        scene.view.image_px = image_px;
        scene.bounds = mesh.bounds();
        scene.view.camera = fit_camera(mesh, {12.0}, image_px, {25.0}, margin);
        rays = std::make_unique<RayCaster>(mesh);
    }

    std::optional<RayHit> hit(PoseIndex pose, glm::dvec2 place) const {
        const TurntablePose turned = scene.pose_at(angles[static_cast<std::size_t>(pose.value)]);
        return rays->first_hit(to_object(scene.view.ray_through(place), turned));
    }

    TriangleMap map(PoseIndex pose) const {
        TriangleMap map{scene.view.image_px, {}};
        for (int y = 0; y < map.size_px.y; ++y) {
            for (int x = 0; x < map.size_px.x; ++x) {
                const auto met = hit(pose, {x + 0.5, y + 0.5});
                map.codes.push_back(met ? met->triangle + 1 : 0);
            }
        }
        return map;
    }

    CoordinateMaps maps() const {
        std::vector<TriangleMap> of_poses;
        for (int pose = 0; pose < static_cast<int>(angles.size()); ++pose)
            of_poses.push_back(map({pose}));
        return {mesh, scene, angles, std::move(of_poses)};
    }
};

/// Two balls that hide each other in part, far from the origin, as scans often are.
inline Mesh two_balls() {
    Mesh mesh;
    add_part(mesh, ball({1000.0, -2000.0, 500.0}, 60.0), "body");
    add_part(mesh, ball({1020.0, -2075.0, 560.0}, 25.0), "head");
    return mesh;
}

} // namespace overt::test
