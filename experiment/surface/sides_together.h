/// Right-hand sides that are solved at once, as one number each of the processor's wide registers.
#pragma once

#include <cstddef>

#include "experiment/surface/sparse_factor.h"

namespace overt {

/// A number of each of SparseFactor::together right-hand sides. Each is reckoned as if it were alone: with
/// the same operations in the same order, and so to the same bits. Written out, since compilers do not find
/// them in loops over so few.
typedef double SidesTogether // NOLINT(modernize-use-using): an alias cannot have these attributes in GCC
    __attribute__((vector_size(SparseFactor::together * sizeof(double)), aligned(alignof(double)),
                   may_alias));

/// The numbers of a row, in the order of SparseFactor::solve.
inline SidesTogether& sides_of(double* sides, std::size_t row) {
    return *reinterpret_cast<SidesTogether*>(sides + SparseFactor::together * row);
}
inline const SidesTogether& sides_of(const double* sides, std::size_t row) {
    return *reinterpret_cast<const SidesTogether*>(sides + SparseFactor::together * row);
}

} // namespace overt
