#include "experiment/scene/making/vertex_welder.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/scene/making/raw_mesh.h"

namespace overt {
namespace {

constexpr std::uint32_t nobody = 0xffffffff;

std::uint64_t mixed(std::uint64_t hash, double coordinate) {
    // Adding 0 makes -0 into +0, which compares equal and so must have the same bits.
    hash ^= std::bit_cast<std::uint64_t>(coordinate + 0.0);
    // The finalising steps of SplitMix64 (Steele, Lea and Flood 2014) spread every bit over all others.
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9ull;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebull;
    return hash ^ (hash >> 31);
}

} // namespace

VertexWelder::VertexWelder(double tolerance, std::size_t expected) : tolerance_(tolerance) {
    if (!(tolerance >= 0.0) || !std::isfinite(tolerance)) {
        throw InputError(
            fmt::format("the weld tolerance is {}; it must be 0 or a positive length.", tolerance));
    }
    positions_.reserve(expected);
    next_.reserve(expected);
    resize_table(std::bit_ceil(std::max<std::size_t>(expected, 64)));
}

// Cells are twice the tolerance wide, so that all that is near a position lies in its own cell and the
// neighbours on the sides to which it is closer.
glm::dvec3 VertexWelder::cell_of(const glm::dvec3& position) const {
    return tolerance_ > 0.0 ? glm::floor(position / (2.0 * tolerance_)) : position;
}

std::size_t VertexWelder::bucket_of(const glm::dvec3& cell) const {
    return mixed(mixed(mixed(0, cell.x), cell.y), cell.z) & (heads_.size() - 1);
}

void VertexWelder::look_in(const glm::dvec3& cell, const glm::dvec3& position, Nearest& nearest) const {
    for (std::uint32_t i = heads_[bucket_of(cell)]; i != nobody; i = next_[i]) {
        const glm::dvec3 apart = positions_[i] - position;
        const double distance_squared = glm::dot(apart, apart);
        if (distance_squared > tolerance_ * tolerance_)
            continue;
        if (distance_squared < nearest.distance_squared ||
            (distance_squared == nearest.distance_squared && i < nearest.index)) {
            nearest = {i, distance_squared};
        }
    }
}

VertexWelder::Nearest VertexWelder::nearest_to(const glm::dvec3& position) const {
    Nearest nearest{nobody, HUGE_VAL};
    const glm::dvec3 cell = cell_of(position);
    if (tolerance_ == 0.0) {
        look_in(cell, position, nearest);
        return nearest;
    }
    const glm::dvec3 in_cell = position / (2.0 * tolerance_) - cell;
    const glm::dvec3 side =
        glm::mix(glm::dvec3(-1.0), glm::dvec3(1.0), glm::greaterThanEqual(in_cell, glm::dvec3(0.5)));
    for (int neighbour = 0; neighbour < 8; ++neighbour) {
        const glm::dvec3 step(neighbour & 1, (neighbour >> 1) & 1, (neighbour >> 2) & 1);
        look_in(cell + step * side, position, nearest);
    }
    return nearest;
}

std::uint32_t VertexWelder::index_of(const glm::dvec3& position) {
    if (const Nearest found = nearest_to(position); found.index != nobody)
        return found.index;
    if (positions_.size() == max_mesh_vertices)
        throw InputError("this mesh has too many vertices.");
    const auto index = static_cast<std::uint32_t>(positions_.size());
    positions_.push_back(position);
    next_.push_back(nobody);
    if (positions_.size() > heads_.size()) {
        resize_table(heads_.size() * 2);
    } else {
        insert(index);
    }
    return index;
}

void VertexWelder::insert(std::uint32_t index) {
    std::uint32_t& head = heads_[bucket_of(cell_of(positions_[index]))];
    next_[index] = head;
    head = index;
}

void VertexWelder::resize_table(std::size_t buckets) {
    heads_.assign(buckets, nobody);
    for (std::uint32_t i = 0; i < positions_.size(); ++i)
        insert(i);
}

} // namespace overt
