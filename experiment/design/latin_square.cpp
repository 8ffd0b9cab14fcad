#include "experiment/design/latin_square.h"

#include <algorithm>
#include <numeric>

#include "experiment/base/error.h"
#include "experiment/base/random.h"

namespace overt {

namespace {

std::vector<int> balanced_row(int size, int row) {
    const int round = row % rows_of_square(SquareKind::balanced, size);
    const int shift = round % size;
    std::vector<int> levels;
    for (int column = 0; column < size; ++column) {
        const int first = column % 2 == 0 ? column / 2 : size - (column + 1) / 2;
        levels.push_back((first + shift) % size);
    }
    if (round >= size)
        std::reverse(levels.begin(), levels.end());
    return levels;
}

std::vector<int> random_row(int size, int row, std::uint64_t seed, std::string_view purpose) {
    RandomStream random(seed, purpose, static_cast<std::uint64_t>(row / size));
    const auto shuffled = [&] {
        std::vector<int> numbers(static_cast<std::size_t>(size));
        std::iota(numbers.begin(), numbers.end(), 0);
        random.shuffle(std::span(numbers));
        return numbers;
    };
    const std::vector<int> rows = shuffled(), columns = shuffled(), names = shuffled();
    std::vector<int> levels;
    levels.reserve(columns.size());
    for (const int column : columns)
        levels.push_back(
            names[static_cast<std::size_t>((rows[static_cast<std::size_t>(row % size)] + column) % size)]);
    return levels;
}

} // namespace

SquareKind square_of(LevelOrder order) {
    OVERT_EXPECTS(order >= LevelOrder::cyclic);
    return order == LevelOrder::cyclic     ? SquareKind::cyclic
           : order == LevelOrder::balanced ? SquareKind::balanced
                                           : SquareKind::random_square;
}

int rows_of_square(SquareKind kind, int size) {
    return kind == SquareKind::balanced && size % 2 == 1 && size > 1 ? 2 * size : size;
}

std::vector<int> row_of_square(SquareKind kind, int size, int row, std::uint64_t seed,
                               std::string_view purpose) {
    OVERT_EXPECTS(size >= 1 && row >= 0);
    if (kind == SquareKind::balanced)
        return balanced_row(size, row);
    if (kind == SquareKind::random_square)
        return random_row(size, row, seed, purpose);
    std::vector<int> levels(static_cast<std::size_t>(size));
    std::iota(levels.begin(), levels.end(), row % size);
    for (int& level : levels)
        level %= size;
    return levels;
}

} // namespace overt
