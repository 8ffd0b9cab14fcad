#define EIGEN_MPL2_ONLY
#include "experiment/surface/sparse_factor.h"

#include <Eigen/SparseCholesky>

#include "experiment/base/error.h"

namespace overt {

SparseFactor::SparseFactor(std::size_t size, std::span<const MatrixEntry> lower) {
    using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int32_t>;
    const auto count = static_cast<Eigen::Index>(size);
    Eigen::SimplicialLLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<std::int32_t>> cholesky;
    {
        std::vector<Eigen::Triplet<double>> triplets;
        triplets.reserve(lower.size());
        for (const MatrixEntry& entry : lower)
            triplets.emplace_back(static_cast<int>(entry.row), static_cast<int>(entry.column), entry.value);
        Matrix matrix(count, count);
        matrix.setFromTriplets(triplets.begin(), triplets.end());
        cholesky.compute(matrix);
    }
    if (cholesky.info() != Eigen::Success)
        throw Error("the equations of a surface cannot be solved: its mesh has triangles of sizes too "
                    "different, or numbers that are not finite");
    // permutationP() takes rows to their places in the factor.
    const auto& places = cholesky.permutationP().indices();
    place_of_row_.resize(size);
    for (std::size_t row = 0; row < size; ++row)
        place_of_row_[row] = static_cast<std::uint32_t>(places(static_cast<Eigen::Index>(row)));
    const Matrix factor = cholesky.matrixL();
    inverse_diagonal_.resize(size);
    columns_begin_.assign(1, 0);
    columns_begin_.reserve(size + 1);
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
    for (std::size_t row = 0; row < size(); ++row) {
        for (std::size_t i = 0; i < together; ++i)
            work[together * place_of_row_[row] + i] = sides[together * row + i];
    }
    for (std::size_t column = 0; column < size(); ++column) {
        double* const x = work.data() + together * column;
        double known[together];
        for (std::size_t i = 0; i < together; ++i)
            known[i] = x[i] *= inverse_diagonal_[column];
        for (std::size_t e = columns_begin_[column]; e < columns_begin_[column + 1]; ++e) {
            double* const y = work.data() + together * rows_[e];
            const double value = values_[e];
            for (std::size_t i = 0; i < together; ++i)
                y[i] -= value * known[i];
        }
    }
    for (std::size_t column = size(); column-- > 0;) {
        double* const x = work.data() + together * column;
        double sum[together];
        for (std::size_t i = 0; i < together; ++i)
            sum[i] = x[i];
        for (std::size_t e = columns_begin_[column]; e < columns_begin_[column + 1]; ++e) {
            const double* const y = work.data() + together * rows_[e];
            const double value = values_[e];
            for (std::size_t i = 0; i < together; ++i)
                sum[i] -= value * y[i];
        }
        for (std::size_t i = 0; i < together; ++i)
            x[i] = sum[i] * inverse_diagonal_[column];
    }
    for (std::size_t row = 0; row < size(); ++row) {
        for (std::size_t i = 0; i < together; ++i)
            sides[together * row + i] = work[together * place_of_row_[row] + i];
    }
}

} // namespace overt
