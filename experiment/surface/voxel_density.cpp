#include "experiment/surface/voxel_density.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"

namespace overt {

VoxelDensity::VoxelDensity(const Bounds& bounds, double sigma, double cell, glm::ivec3 cells,
                           double truncation)
    : origin_(bounds.centre() - 0.5 * cell * glm::dvec3(cells - 1)), cell_(cell), sigma_(sigma),
      truncation_(truncation), cells_(cells) {
    OVERT_EXPECTS(sigma > 0.0 && cell > 0.0 && truncation > 0.0);
    values_.resize(static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y) *
                   static_cast<std::size_t>(cells_.z));
}

namespace {

glm::ivec3 cells_of_half_a_sigma(const Bounds& bounds, double sigma) {
    const glm::dvec3 cells =
        glm::ceil((bounds.extent() + 2.0 * VoxelDensity::usual_truncation * sigma) / (0.5 * sigma)) + 1.0;
    if (!(cells.x * cells.y * cells.z <= VoxelDensity::most_cells))
        throw InputError(
            fmt::format("a kernel this narrow takes a grid of {:.0f} x {:.0f} x {:.0f} voxels, "
                        "more than {:.0f} in all: give a wider --sigma, or a kernel on the surface",
                        cells.x, cells.y, cells.z, VoxelDensity::most_cells));
    return glm::ivec3(cells);
}

} // namespace

VoxelDensity::VoxelDensity(const Bounds& bounds, double sigma)
    : VoxelDensity(bounds, sigma, 0.5 * sigma, cells_of_half_a_sigma(bounds, sigma), usual_truncation) {}

VoxelDensity::VoxelDensity(const Bounds& bounds, double sigma, int cells, double truncation)
    : VoxelDensity(
          bounds, sigma,
          (std::max({bounds.extent().x, bounds.extent().y, bounds.extent().z}) + 2.0 * truncation * sigma) /
              cells,
          glm::ivec3(glm::ceil((bounds.extent() + 2.0 * truncation * sigma) * (cells - 1e-6) /
                               (std::max({bounds.extent().x, bounds.extent().y, bounds.extent().z}) +
                                2.0 * truncation * sigma))),
          truncation) {
    OVERT_EXPECTS(cells >= 8 && cells <= 1024);
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

// One row after another, from a copy with zeros at both ends.
void VoxelDensity::blur_along_x(std::span<const double> kernel, int most_threads) {
    const std::size_t reach = kernel.size() - 1, width = static_cast<std::size_t>(cells_.x);
    parallel_for(
        cells_.z,
        [&](int z) {
            std::vector<double> padded(width + 2 * reach, 0.0);
            for (int y = 0; y < cells_.y; ++y) {
                double* const row = values_.data() + index_of({0, y, z});
                if (std::all_of(row, row + width, [](double value) { return value == 0.0; }))
                    continue;
                std::copy_n(row, width, padded.begin() + static_cast<std::ptrdiff_t>(reach));
                const double* const middle = padded.data() + reach;
                for (std::size_t x = 0; x < width; ++x)
                    row[x] = kernel[0] * middle[x];
                for (std::size_t i = 1; i <= reach; ++i) {
                    const double* const before = middle - i;
                    const double* const after = middle + i;
                    for (std::size_t x = 0; x < width; ++x)
                        row[x] += kernel[i] * (before[x] + after[x]);
                }
            }
        },
        most_threads);
}

// Whole rows at a time: each row of the result is a sum of rows. A slab of the other axis fits into the
// caches.
void VoxelDensity::blur_across_rows(std::span<const double> kernel, int axis, int most_threads) {
    const int reach = static_cast<int>(kernel.size()) - 1;
    const auto width = static_cast<std::size_t>(cells_.x);
    const int slabs = axis == 1 ? cells_.z : cells_.y, rows = cells_[axis];
    parallel_for(
        slabs,
        [&](int slab) {
            const auto row_at = [&](int row) {
                return values_.data() +
                       index_of(axis == 1 ? glm::ivec3(0, row, slab) : glm::ivec3(0, slab, row));
            };
            std::vector<double> blurred(width * static_cast<std::size_t>(rows), 0.0);
            bool is_empty = true;
            for (int from = 0; from < rows; ++from) {
                const double* const source = row_at(from);
                if (std::all_of(source, source + width, [](double value) { return value == 0.0; }))
                    continue;
                is_empty = false;
                for (int to = std::max(0, from - reach); to <= std::min(rows - 1, from + reach); ++to) {
                    const double weight = kernel[static_cast<std::size_t>(std::abs(to - from))];
                    double* const target = blurred.data() + width * static_cast<std::size_t>(to);
                    for (std::size_t x = 0; x < width; ++x)
                        target[x] += weight * source[x];
                }
            }
            if (is_empty)
                return;
            for (int row = 0; row < rows; ++row)
                std::copy_n(blurred.data() + width * static_cast<std::size_t>(row), width, row_at(row));
        },
        most_threads);
}

void VoxelDensity::blur(int most_threads) {
    // Half of it: the kernel is symmetric.
    std::vector<double> kernel;
    double sum = 0.0;
    // Rounded as scipy does, so that both can be compared.
    const int reach = static_cast<int>(truncation_ * sigma_ / cell_ + 0.5);
    for (int i = 0; i <= reach; ++i) {
        const double sigmas = i * cell_ / sigma_;
        kernel.push_back(std::exp(-0.5 * sigmas * sigmas));
        sum += (i == 0 ? 1.0 : 2.0) * kernel.back();
    }
    for (double& weight : kernel)
        weight /= sum;
    blur_along_x(kernel, most_threads);
    blur_across_rows(kernel, 1, most_threads);
    blur_across_rows(kernel, 2, most_threads);
}

double VoxelDensity::at(glm::dvec3 point) const {
    const glm::dvec3 place = (point - origin_) / cell_;
    const glm::ivec3 low(glm::floor(place));
    const glm::dvec3 f = place - glm::dvec3(low);
    double value = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 offset(corner & 1, (corner >> 1) & 1, corner >> 2);
        if (glm::any(glm::lessThan(low + offset, glm::ivec3(0))) ||
            glm::any(glm::greaterThanEqual(low + offset, cells_)))
            continue;
        double weight = 1.0;
        for (int axis = 0; axis < 3; ++axis)
            weight *= offset[axis] ? f[axis] : 1.0 - f[axis];
        value += weight * values_[index_of(low + offset)];
    }
    return value;
}

} // namespace overt
