#define EIGEN_MPL2_ONLY
#include "experiment/surface/sparse_factor.h"

#include <algorithm>
#include <numeric>

#include <Eigen/SparseCholesky>

#include "experiment/base/error.h"
#include "experiment/surface/sides_together.h"

namespace overt {

namespace {

/// Halves of fewer nodes are not halved again.
constexpr std::size_t least_half = 24;

class Dissection {
  public:
    Dissection(std::span<const glm::dvec3> positions, std::span<const MatrixEntry> lower)
        : positions_(positions), begin_(positions.size() + 1, 0), side_(positions.size(), 0) {
        for (const MatrixEntry& entry : lower) {
            ++begin_[entry.row + 1];
            ++begin_[entry.column + 1];
        }
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        neighbours_.resize(begin_.back());
        std::vector<std::size_t> next(begin_.begin(), begin_.end());
        for (const MatrixEntry& entry : lower) {
            neighbours_[next[entry.row]++] = entry.column;
            neighbours_[next[entry.column]++] = entry.row;
        }
    }

    /// Reorders the nodes.
    void order(std::span<std::uint32_t> nodes) {
        if (nodes.size() < 2 * least_half)
            return;
        glm::dvec3 low = positions_[nodes.front()], high = low;
        for (const std::uint32_t node : nodes) {
            low = glm::min(low, positions_[node]);
            high = glm::max(high, positions_[node]);
        }
        const glm::dvec3 extent = high - low;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
        const auto before = [&](std::uint32_t a, std::uint32_t b) {
            const double x = positions_[a][axis], y = positions_[b][axis];
            return x != y ? x < y : a < b;
        };
        const auto middle = nodes.begin() + static_cast<std::ptrdiff_t>(nodes.size() / 2);
        std::nth_element(nodes.begin(), middle, nodes.end(), before);
        const std::uint32_t right = ++sides_;
        for (auto node = middle; node != nodes.end(); ++node)
            side_[*node] = right;
        const auto touches = [&](std::uint32_t node) {
            return std::any_of(neighbours_.begin() + static_cast<std::ptrdiff_t>(begin_[node]),
                               neighbours_.begin() + static_cast<std::ptrdiff_t>(begin_[node + 1]),
                               [&](std::uint32_t other) { return side_[other] == right; });
        };
        const auto border = std::partition(nodes.begin(), middle, [&](auto node) { return !touches(node); });
        // Left, then right, then the border between them.
        const auto border_now = std::rotate(border, middle, nodes.end());
        order({nodes.begin(), border});
        order({border, border_now});
        // The border is a line, which is halved in the same way.
        order({border_now, nodes.end()});
    }

  private:
    std::span<const glm::dvec3> positions_;
    std::vector<std::size_t> begin_;
    std::vector<std::uint32_t> neighbours_;
    std::vector<std::uint32_t> side_; ///< the number of the last right half that a node was in
    std::uint32_t sides_ = 0;
};

} // namespace

std::vector<std::uint32_t> dissection_order(std::span<const glm::dvec3> positions,
                                            std::span<const MatrixEntry> lower) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    Dissection(positions, lower).order(order);
    std::vector<std::uint32_t> places(order.size());
    for (std::uint32_t place = 0; place < order.size(); ++place)
        places[order[place]] = place;
    return places;
}

SparseFactor::SparseFactor(std::vector<std::uint32_t> place_of_row, std::span<const MatrixEntry> lower)
    : place_of_row_(std::move(place_of_row)) {
    using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int32_t>;
    const auto count = static_cast<Eigen::Index>(size());
    Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::NaturalOrdering<std::int32_t>> cholesky;
    {
        std::vector<Eigen::Triplet<double>> triplets;
        triplets.reserve(lower.size());
        for (const MatrixEntry& entry : lower) {
            const auto [low, high] = std::minmax(place_of_row_[entry.row], place_of_row_[entry.column]);
            triplets.emplace_back(static_cast<int>(high), static_cast<int>(low), entry.value);
        }
        Matrix matrix(count, count);
        matrix.setFromTriplets(triplets.begin(), triplets.end());
        cholesky.compute(matrix);
    }
    if (cholesky.info() != Eigen::Success)
        throw Error("the equations of a surface cannot be solved: its mesh has triangles of sizes too "
                    "different, or numbers that are not finite");
    const Matrix factor = cholesky.matrixL();
    inverse_diagonal_.resize(size());
    columns_begin_.assign(1, 0);
    columns_begin_.reserve(size() + 1);
    rows_.reserve(static_cast<std::size_t>(factor.nonZeros()));
    values_.reserve(static_cast<std::size_t>(factor.nonZeros()));
    for (Eigen::Index column = 0; column < count; ++column) {
        for (Matrix::InnerIterator entry(factor, column); entry; ++entry) {
            if (entry.row() == column) {
                inverse_diagonal_[static_cast<std::size_t>(column)] = 1.0 / entry.value();
            } else {
                rows_.push_back(static_cast<std::uint32_t>(entry.row()));
                values_.push_back(entry.value());
            }
        }
        columns_begin_.push_back(rows_.size());
    }
}

void SparseFactor::solve(std::span<double> sides) const {
    OVERT_EXPECTS(sides.size() == together * size());
    std::vector<double> work(sides.size());
    double* const x = work.data();
    for (std::size_t row = 0; row < size(); ++row)
        sides_of(x, place_of_row_[row]) = sides_of(sides.data(), row);
    for (std::size_t column = 0; column < size(); ++column) {
        const SidesTogether known = sides_of(x, column) * inverse_diagonal_[column];
        sides_of(x, column) = known;
        for (std::size_t e = columns_begin_[column]; e < columns_begin_[column + 1]; ++e)
            sides_of(x, rows_[e]) -= values_[e] * known;
    }
    for (std::size_t column = size(); column-- > 0;) {
        SidesTogether sum = sides_of(x, column);
        for (std::size_t e = columns_begin_[column]; e < columns_begin_[column + 1]; ++e)
            sum -= values_[e] * sides_of(x, rows_[e]);
        sides_of(x, column) = sum * inverse_diagonal_[column];
    }
    for (std::size_t row = 0; row < size(); ++row)
        sides_of(sides.data(), row) = sides_of(x, place_of_row_[row]);
}

} // namespace overt
