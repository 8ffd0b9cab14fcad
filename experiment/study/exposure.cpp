#include "experiment/study/exposure.h"

#include <algorithm>

#include "experiment/base/parallel.h"

namespace overt {

namespace {

/// Every second pixel of every second row: the neighbours show nearly the same.
constexpr int pixel_step = 2;

struct PoseExposure {
    std::vector<bool> visible;
    std::vector<std::pair<std::uint32_t, float>> vertices; ///< with weights, in the order of pixels
    std::vector<float> depths;                             ///< of these
};

PoseExposure exposure_of_pose(const CoordinateMaps& maps, PoseIndex pose) {
    PoseExposure found;
    const Mesh& mesh = maps.mesh();
    found.visible.resize(mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        found.visible[v] = maps.is_visible(pose, glm::dvec3(mesh.positions[v]));
    const glm::ivec2 size = maps.image_px();
    for (int y = 0; y < size.y; y += pixel_step) {
        for (int x = 0; x < size.x; x += pixel_step) {
            const std::optional<SurfacePoint> point =
                maps.surface_at(pose, glm::dvec2(x, y) + 0.5 * pixel_step);
            if (!point)
                continue;
            for (int corner = 0; corner < 3; ++corner) {
                found.vertices.emplace_back(mesh.triangles[point->triangle][corner],
                                            static_cast<float>(point->barycentric[corner]));
                found.depths.push_back(static_cast<float>(point->depth));
            }
        }
    }
    return found;
}

} // namespace

Exposure exposure_of(const CoordinateMaps& maps, const Animation& animation, const PoseTable& poses) {
    const std::size_t vertices = maps.mesh().positions.size();
    Exposure exposure{std::vector<float>(vertices, 0.0f), std::vector<double>(vertices, 0.0),
                      std::vector<double>(vertices, 0.0)};
    std::vector<double> seconds(poses.angles.size(), 0.0);
    for (int step = 0; step < animation.shown_frame_count(); ++step)
        seconds[static_cast<std::size_t>(poses.pose_of(animation.frame_at_step(step)).value)] +=
            1.0 / animation.frame_rate_hz;
    // A few poses at a time: what each gives is added in their order.
    constexpr std::size_t at_a_time = 4;
    for (std::size_t begin = 0; begin < seconds.size(); begin += at_a_time) {
        std::vector<PoseExposure> found(std::min(at_a_time, seconds.size() - begin));
        parallel_for(static_cast<int>(found.size()), [&](int i) {
            const std::size_t pose = begin + static_cast<std::size_t>(i);
            if (seconds[pose] > 0.0)
                found[static_cast<std::size_t>(i)] =
                    exposure_of_pose(maps, PoseIndex{static_cast<int>(pose)});
        });
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double lit = seconds[begin + i];
            for (std::size_t v = 0; v < found[i].visible.size(); ++v)
                exposure.seconds_visible[v] += found[i].visible[v] ? static_cast<float>(lit) : 0.0f;
            for (std::size_t k = 0; k < found[i].vertices.size(); ++k) {
                const auto [vertex, share] = found[i].vertices[k];
                const double weight = lit * pixel_step * pixel_step * static_cast<double>(share);
                exposure.pixel_seconds[vertex] += weight;
                exposure.depth[vertex] += weight * static_cast<double>(found[i].depths[k]);
            }
        }
    }
    for (std::size_t v = 0; v < vertices; ++v)
        exposure.depth[v] =
            exposure.pixel_seconds[v] > 0.0 ? exposure.depth[v] / exposure.pixel_seconds[v] : 0.0;
    return exposure;
}

} // namespace overt
