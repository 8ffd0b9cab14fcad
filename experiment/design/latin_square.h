/// Latin squares: each level once in every row, and once in every column over a round of rows.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "experiment/protocol/design_settings.h"

namespace overt {

/// The square that an order of levels goes by; it must be one of the squares.
SquareKind square_of(LevelOrder order);

/// Rows after which every level has stood in every column equally often: the size, or twice that for a
/// balanced square of odd size.
int rows_of_square(SquareKind kind, int size);

/// A row, counted from 0 without end: the levels 0 … size-1 in the order in which they come.
///
/// Cyclic: row r is r, r+1, … modulo the size. Balanced: over rows_of_square() rows each level also follows
/// each other level directly equally often (E. J. Williams, "Experimental designs balanced for the
/// estimation of residual effects of treatments", Australian Journal of Scientific Research A 2, 1949): the
/// first row is 0, n-1, 1, n-2, …, the others are shifted, and for an odd size all come once more, backwards.
/// Random: the cyclic square with its rows, columns and levels shuffled, a new one for every `size` rows.
/// `seed` and `purpose` are of random squares only.
std::vector<int> row_of_square(SquareKind kind, int size, int row, std::uint64_t seed,
                               std::string_view purpose);

} // namespace overt
