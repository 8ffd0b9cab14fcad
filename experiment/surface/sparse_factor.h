/// A symmetric positive definite sparse matrix, factorised once to solve many equations.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace overt {

/// An entry of a matrix. Entries at the same place add up.
struct MatrixEntry {
    std::uint32_t row, column;
    double value;
};

/// An order in which the matrix of a mesh keeps most of its zeros when it is factorised: nested dissection.
/// The nodes are halved at the median of their longest extent, again and again; those of one half with a
/// neighbour in the other come last. Gives the place of each node.
std::vector<std::uint32_t> dissection_order(std::span<const glm::dvec3> positions,
                                            std::span<const MatrixEntry> lower);

/// Cholesky's factor. May be used from any thread once it is made.
class SparseFactor {
  public:
    /// Right-hand sides that are solved at once: the factor is larger than the processor's caches, and so
    /// comes from memory once for all of them.
    static constexpr std::size_t together = 8;

    /// `lower`: entries with row >= column. `place_of_row`: where each row comes in the factor. Throws Error
    /// if the matrix is not positive definite.
    SparseFactor(std::vector<std::uint32_t> place_of_row, std::span<const MatrixEntry> lower);

    /// Replaces `together` right-hand sides by their solutions. `sides` holds those of the first row, then
    /// those of the second, and so on. Each is reckoned as if it were alone.
    void solve(std::span<double> sides) const;

    std::size_t size() const { return place_of_row_.size(); }
    /// Numbers other than 0 below the diagonal.
    std::size_t entries() const { return values_.size(); }

  private:
    std::vector<std::uint32_t> place_of_row_;
    std::vector<double> inverse_diagonal_;   ///< by column of the factor
    std::vector<std::size_t> columns_begin_; ///< one more at the end
    std::vector<std::uint32_t> rows_;
    std::vector<double> values_;
};

} // namespace overt
