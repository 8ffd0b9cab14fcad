#include "experiment/study/exposure.h"

#include <algorithm>

#include "experiment/base/parallel.h"

namespace overt {

namespace {

/// By vertex: pixels of one pose's picture whose triangle has it, a third each.
std::vector<float> pixels_of_pose(const CoordinateMaps& maps, PoseIndex pose) {
    const Mesh& mesh = maps.mesh();
    std::vector<float> pixels(mesh.positions.size(), 0.0f);
    const PoseCells& cells = maps.cells(pose);
    const glm::ivec2 size = maps.image_px();
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const PixelCell cell = cells.cell({x, y});
            if (!cell.is_covered())
                continue;
            const glm::uvec3& corners = mesh.triangles[cell.triangle()];
            for (int corner = 0; corner < 3; ++corner)
                pixels[corners[corner]] += 1.0f / 3.0f;
        }
    }
    return pixels;
}

} // namespace

Exposure exposure_of(const CoordinateMaps& maps, const Animation& animation, const PoseTable& poses) {
    const std::size_t vertices = maps.mesh().positions.size();
    Exposure exposure{std::vector<float>(vertices, 0.0f), std::vector<double>(vertices, 0.0)};
    std::vector<double> seconds(poses.angles.size(), 0.0);
    for (int step = 0; step < animation.shown_frame_count(); ++step)
        seconds[static_cast<std::size_t>(poses.pose_of(animation.frame_at_step(step)).value)] +=
            1.0 / animation.frame_rate_hz;
    // A few poses at a time: what each gives is added in their order.
    constexpr std::size_t at_a_time = 8;
    for (std::size_t begin = 0; begin < seconds.size(); begin += at_a_time) {
        std::vector<std::vector<float>> found(std::min(at_a_time, seconds.size() - begin));
        parallel_for(static_cast<int>(found.size()), [&](int i) {
            const std::size_t pose = begin + static_cast<std::size_t>(i);
            if (seconds[pose] > 0.0)
                found[static_cast<std::size_t>(i)] = pixels_of_pose(maps, PoseIndex{static_cast<int>(pose)});
        });
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double lit = seconds[begin + i];
            for (std::size_t v = 0; v < found[i].size(); ++v) {
                exposure.seconds_visible[v] += found[i][v] > 0.0f ? static_cast<float>(lit) : 0.0f;
                exposure.pixel_seconds[v] += lit * static_cast<double>(found[i][v]);
            }
        }
    }
    return exposure;
}

} // namespace overt
