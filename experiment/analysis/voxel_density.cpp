#include "experiment/analysis/voxel_density.h"

#include <cmath>

#include "experiment/base/error.h"

namespace overt {

VoxelDensity::VoxelDensity(const Bounds& bounds, double sigma)
    : origin_(bounds.min - 3.0 * sigma), cell_(0.5 * sigma), sigma_(sigma),
      cells_(glm::ivec3(glm::ceil((bounds.extent() + 6.0 * sigma) / cell_)) + 1) {
    OVERT_EXPECTS(sigma > 0.0);
    values_.resize(static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y) *
                   static_cast<std::size_t>(cells_.z));
}

std::size_t VoxelDensity::index_of(glm::ivec3 cell) const {
    return (static_cast<std::size_t>(cell.z) * static_cast<std::size_t>(cells_.y) +
            static_cast<std::size_t>(cell.y)) *
               static_cast<std::size_t>(cells_.x) +
           static_cast<std::size_t>(cell.x);
}

void VoxelDensity::add(glm::dvec3 point, double weight) {
    const glm::ivec3 cell(glm::round((point - origin_) / cell_));
    for (int axis = 0; axis < 3; ++axis) {
        if (cell[axis] < 0 || cell[axis] >= cells_[axis])
            return;
    }
    values_[index_of(cell)] += weight / (cell_ * cell_ * cell_);
}

void VoxelDensity::blur() {
    const int reach = static_cast<int>(std::ceil(3.0 * sigma_ / cell_));
    std::vector<double> kernel;
    double sum = 0.0;
    for (int i = -reach; i <= reach; ++i) {
        kernel.push_back(std::exp(-0.5 * (i * cell_ / sigma_) * (i * cell_ / sigma_)));
        sum += kernel.back();
    }
    for (double& weight : kernel)
        weight /= sum;
    // A Gaussian is the product of three along the axes.
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> blurred(values_.size());
        glm::ivec3 cell;
        for (cell.z = 0; cell.z < cells_.z; ++cell.z) {
            for (cell.y = 0; cell.y < cells_.y; ++cell.y) {
                for (cell.x = 0; cell.x < cells_.x; ++cell.x) {
                    const double value = values_[index_of(cell)];
                    if (value == 0.0)
                        continue;
                    glm::ivec3 to = cell;
                    for (int i = -reach; i <= reach; ++i) {
                        to[axis] = cell[axis] + i;
                        if (to[axis] >= 0 && to[axis] < cells_[axis])
                            blurred[index_of(to)] += kernel[static_cast<std::size_t>(i + reach)] * value;
                    }
                }
            }
        }
        values_ = std::move(blurred);
    }
}

double VoxelDensity::at(glm::dvec3 point) const {
    const glm::dvec3 place = (point - origin_) / cell_;
    const glm::ivec3 low(glm::floor(place));
    for (int axis = 0; axis < 3; ++axis) {
        if (low[axis] < 0 || low[axis] + 1 >= cells_[axis])
            return 0.0;
    }
    const glm::dvec3 f = place - glm::dvec3(low);
    double value = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 offset(corner & 1, (corner >> 1) & 1, corner >> 2);
        double weight = 1.0;
        for (int axis = 0; axis < 3; ++axis)
            weight *= offset[axis] ? f[axis] : 1.0 - f[axis];
        value += weight * values_[index_of(low + offset)];
    }
    return value;
}

} // namespace overt
