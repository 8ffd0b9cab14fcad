#include "experiment/scene/sculptures/stretched_grid.h"

#include <cmath>

#include "experiment/base/parallel.h"

namespace overt {

namespace {

/// Blocks of so many nodes a side are shared out to the threads and halved down to 2 near the surface.
constexpr int block_width = 16;

/// Embossed folds and loosely approximated ellipsoids make the distance steeper than 1, but not beyond this.
constexpr double steepest_slope = 1.3;

} // namespace

Stretching::Stretching(const Fovea& fovea)
    : centre_(fovea.ball.centre), share_(fovea.cell_share), inner_(fovea.ball.radius / fovea.cell_share),
      outer_(2.0 * inner_) {}

glm::dvec3 Stretching::to_solid(const glm::dvec3& grid_point) const {
    const glm::dvec3 offset = grid_point - centre_;
    const double s = glm::length(offset);
    if (share_ >= 1.0 || s <= inner_)
        return centre_ + offset * share_;
    // Integral of a slope that rises from share_ to 1 as 3t^2 - 2t^3.
    const double t = std::min(1.0, (s - inner_) / (outer_ - inner_));
    const double rise = (1.0 - share_) * (outer_ - inner_) * (t * t * t - 0.5 * t * t * t * t);
    const double radius = share_ * s + rise + std::max(0.0, s - outer_) * (1.0 - share_);
    return centre_ + offset * (radius / s);
}

Bounds Stretching::to_grid(const Bounds& box_mm) const {
    const double widening = (1.0 - share_) * 0.5 * (inner_ + outer_);
    return {box_mm.min - widening, box_mm.max + widening};
}

StretchedGrid::StretchedGrid(const ContourRequest& request)
    : stretching_(request.fovea), cell_(request.cell_mm) {
    const Bounds box = stretching_.to_grid(request.box_mm);
    // A rounded number of blocks, centred on the box.
    const glm::ivec3 blocks = glm::ivec3(glm::ceil((box.extent() / cell_ + 1.0) / double(block_width)));
    size_ = blocks * block_width;
    origin_ = box.centre() - 0.5 * cell_ * glm::dvec3(size_ - 1);
    distances_.resize(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                      static_cast<std::size_t>(size_.z));
    const auto sample_block = [&](int i) {
        const glm::ivec3 block(i % blocks.x, i / blocks.x % blocks.y, i / (blocks.x * blocks.y));
        sample(request, block * block_width, block_width);
    };
    parallel_for(blocks.x * blocks.y * blocks.z, sample_block, request.threads);
}

void StretchedGrid::sample(const ContourRequest& request, const glm::ivec3& first, int width) {
    if (width == 1) {
        distances_[index(first)] = static_cast<float>(request.distance(place(first)));
        return;
    }
    const double half_diagonal = 0.5 * std::sqrt(3.0) * (width - 1);
    const double at_centre = request.distance(place(glm::dvec3(first) + 0.5 * (width - 1)));
    if (std::abs(at_centre) > steepest_slope * half_diagonal * cell_) {
        for (int z = 0; z < width; ++z)
            for (int y = 0; y < width; ++y)
                for (int x = 0; x < width; ++x)
                    distances_[index(first + glm::ivec3(x, y, z))] = static_cast<float>(at_centre);
        return;
    }
    const int half = width / 2;
    for (int octant = 0; octant < 8; ++octant)
        sample(request, first + half * glm::ivec3(octant & 1, octant >> 1 & 1, octant >> 2), half);
}

glm::dvec3 StretchedGrid::place(const glm::dvec3& node) const {
    return stretching_.to_solid(origin_ + node * cell_);
}

} // namespace overt
