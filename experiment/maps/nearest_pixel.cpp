#include "experiment/maps/nearest_pixel.h"

#include <algorithm>
#include <limits>

#include "experiment/base/error.h"

namespace overt {

namespace {

constexpr std::int16_t none = -1;

/// The parabola (x - column)² + height², which a column's nearest pixel of the set raises over a row.
struct Parabola {
    int column;
    std::int64_t height_squared;
    int from; ///< first x at which it is the lowest
};

/// By pixel, the row of the nearest pixel of the set in the same column, of two at the same distance the
/// upper one; -1 if the column has none.
std::vector<std::int16_t> nearest_rows(const std::vector<std::uint8_t>& in_set, glm::ivec2 size) {
    const auto width = static_cast<std::size_t>(size.x), height = static_cast<std::size_t>(size.y);
    std::vector<std::int16_t> rows(in_set.size());
    // Row by row and not column by column, for the sake of the cache.
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t i = y * width + x;
            rows[i] = in_set[i] ? static_cast<std::int16_t>(y) : (y > 0 ? rows[i - width] : none);
        }
    }
    for (std::size_t y = height - 1; y-- > 0;) {
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t i = y * width + x;
            const int above = rows[i], below = rows[i + width], here = static_cast<int>(y);
            if (below != none && (above == none || below - here < here - above))
                rows[i] = static_cast<std::int16_t>(below);
        }
    }
    return rows;
}

} // namespace

std::vector<glm::i16vec2> nearest_pixels(const std::vector<std::uint8_t>& in_set, glm::ivec2 size) {
    OVERT_EXPECTS(size.x > 0 && size.y > 0 && size.x <= 16384 && size.y <= 16384);
    const std::vector<std::int16_t> rows = nearest_rows(in_set, size);
    std::vector<glm::i16vec2> nearest(in_set.size(), glm::i16vec2(none));
    std::vector<Parabola> lowest;
    lowest.reserve(static_cast<std::size_t>(size.x));
    for (int y = 0; y < size.y; ++y) {
        const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x);
        lowest.clear();
        for (int x = 0; x < size.x; ++x) {
            const int nearest_row = rows[row + static_cast<std::size_t>(x)];
            if (nearest_row == none)
                continue;
            const std::int64_t height = nearest_row - y;
            Parabola parabola{x, height * height, 0};
            // From where on it lies below the last one; those that it undercuts altogether go.
            while (!lowest.empty()) {
                const Parabola& last = lowest.back();
                const std::int64_t rise = static_cast<std::int64_t>(x) * x -
                                          static_cast<std::int64_t>(last.column) * last.column +
                                          parabola.height_squared - last.height_squared;
                const std::int64_t twice = 2 * static_cast<std::int64_t>(x - last.column);
                // Floor of rise / twice, plus one: the first whole x at which it is strictly lower.
                const std::int64_t quotient = rise >= 0 ? rise / twice : -((-rise + twice - 1) / twice);
                const std::int64_t from = quotient + 1;
                if (from > last.from) {
                    parabola.from = static_cast<int>(std::min<std::int64_t>(from, size.x));
                    break;
                }
                lowest.pop_back();
            }
            if (lowest.empty())
                parabola.from = 0;
            if (parabola.from < size.x)
                lowest.push_back(parabola);
        }
        for (std::size_t k = 0; k < lowest.size(); ++k) {
            const int end = k + 1 < lowest.size() ? lowest[k + 1].from : size.x;
            const auto column = static_cast<std::size_t>(lowest[k].column);
            const glm::i16vec2 pixel(lowest[k].column, rows[row + column]);
            std::fill(nearest.begin() + static_cast<std::ptrdiff_t>(row) + lowest[k].from,
                      nearest.begin() + static_cast<std::ptrdiff_t>(row) + end, pixel);
        }
    }
    return nearest;
}

} // namespace overt
