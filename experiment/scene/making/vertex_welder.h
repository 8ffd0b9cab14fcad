/// Finds out which positions are the same place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

namespace overt {

/// Takes positions one by one and gives each the index of the place it stands for. A position becomes a place
/// of its own if none of the places so far is within the tolerance; otherwise it stands for the nearest of
/// them (the earliest, when several are equally near). So places keep the order in which they were first
/// seen, and never move. Takes 8 to 12 bytes for each place besides the place itself.
class VertexWelder {
  public:
    /// Tolerance in the unit of the positions; 0: only equal coordinates are the same (-0 equals +0).
    /// `expected` places are provided for at the start. Throws InputError if the tolerance is negative or not
    /// finite.
    explicit VertexWelder(double tolerance = 0.0, std::size_t expected = 0);

    /// Index of the place that this finite position stands for. Throws InputError beyond max_mesh_vertices
    /// places.
    std::uint32_t index_of(const glm::dvec3& position);

    /// All places so far, by index.
    const std::vector<glm::dvec3>& positions() const& { return positions_; }
    std::vector<glm::dvec3> positions() && { return std::move(positions_); }

  private:
    struct Nearest {
        std::uint32_t index;
        double distance_squared;
    };

    glm::dvec3 cell_of(const glm::dvec3& position) const;
    std::size_t bucket_of(const glm::dvec3& cell) const;
    void look_in(const glm::dvec3& cell, const glm::dvec3& position, Nearest& nearest) const;
    Nearest nearest_to(const glm::dvec3& position) const;
    void insert(std::uint32_t index);
    void resize_table(std::size_t buckets);

    double tolerance_;
    std::vector<glm::dvec3> positions_;
    std::vector<std::uint32_t> heads_; ///< for each bucket the place added last; a power of two of them
    std::vector<std::uint32_t> next_;  ///< for each place the one before it in its bucket
};

} // namespace overt
