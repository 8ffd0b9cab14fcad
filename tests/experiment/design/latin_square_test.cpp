#include "experiment/design/latin_square.h"

#include <map>
#include <set>

#include <catch2/catch.hpp>

using namespace overt;

namespace {

constexpr SquareKind square_kinds[] = {SquareKind::cyclic, SquareKind::balanced, SquareKind::random_square};

std::vector<int> row_of(SquareKind kind, int size, int row, std::uint64_t seed = 1) {
    return row_of_square(kind, size, row, seed, "a square");
}

} // namespace

TEST_CASE("each row of a square has every level once, and so has each column over a round of rows",
          "[unit]") {
    for (const SquareKind kind : square_kinds) {
        for (int size = 1; size <= 12; ++size) {
            for (int round = 0; round < 3; ++round) {
                const int rows = rows_of_square(kind, size);
                std::map<std::pair<int, int>, int> places; // by column and level
                for (int row = round * rows; row < (round + 1) * rows; ++row) {
                    const std::vector<int> levels = row_of(kind, size, row);
                    REQUIRE(std::set<int>(levels.begin(), levels.end()).size() ==
                            static_cast<std::size_t>(size));
                    for (int column = 0; column < size; ++column)
                        ++places[{column, levels[static_cast<std::size_t>(column)]}];
                }
                REQUIRE(places.size() == static_cast<std::size_t>(size * size));
                for (const auto& [place, count] : places)
                    REQUIRE(count == rows / size);
            }
        }
    }
}

TEST_CASE("in a balanced square each level follows each other one equally often", "[unit]") {
    for (int size = 2; size <= 12; ++size) {
        std::map<std::pair<int, int>, int> pairs;
        const int rows = rows_of_square(SquareKind::balanced, size);
        CHECK(rows == (size % 2 == 0 ? size : 2 * size));
        for (int row = 0; row < rows; ++row) {
            const std::vector<int> levels = row_of(SquareKind::balanced, size, row);
            for (std::size_t i = 1; i < levels.size(); ++i)
                ++pairs[{levels[i - 1], levels[i]}];
        }
        CHECK(pairs.size() == static_cast<std::size_t>(size * (size - 1)));
        for (const auto& [pair, count] : pairs)
            CHECK(count == (size % 2 == 0 ? 1 : 2));
    }
}

TEST_CASE("random squares differ from round to round and with their seed, and repeat with it", "[unit]") {
    std::set<std::vector<int>> first_rows;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        CHECK(row_of(SquareKind::random_square, 5, 7, seed) == row_of(SquareKind::random_square, 5, 7, seed));
        first_rows.insert(row_of(SquareKind::random_square, 5, 0, seed));
    }
    CHECK(first_rows.size() > 50); // of 120
    std::set<std::vector<int>> rounds;
    for (int round = 0; round < 100; ++round)
        rounds.insert(row_of(SquareKind::random_square, 5, 5 * round));
    CHECK(rounds.size() > 50);
}
