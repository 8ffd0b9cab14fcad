#include "experiment/maps/pose_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "experiment/base/error.h"
#include "experiment/maps/nearest_pixel.h"

namespace overt {

namespace {

std::size_t area_of(glm::ivec2 size) {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
}

} // namespace

PoseCells::PoseCells(const TriangleMap& map, const PixelFlags& contested)
    : size_px_(map.size_px), cells_size_(map.size_px) {
    OVERT_EXPECTS(map.codes.size() == area_of(size_px_) && contested.size() == map.codes.size());
    PixelFlags covered(map.codes.size());
    std::transform(map.codes.begin(), map.codes.end(), covered.begin(),
                   [](std::uint32_t code) { return static_cast<std::uint8_t>(code != 0); });
    const std::vector<glm::i16vec2> nearest_covered = nearest_pixels(covered, size_px_);
    cells_.reserve(map.codes.size());
    for (int y = 0; y < size_px_.y; ++y) {
        for (int x = 0; x < size_px_.x; ++x) {
            const std::size_t i = cells_.size();
            cells_.push_back(
                map.codes[i] != 0
                    ? PixelCell::covered(map.codes[i] - 1, contested[i])
                    : PixelCell::uncovered(glm::ivec2(nearest_covered[i]) - glm::ivec2(x, y), contested[i]));
        }
    }
    measure_extents(map);
    if (any_covered_ && any_uncovered_)
        find_outline_from_inside(map);
}

PoseCells::PoseCells(const TriangleMap& map) : size_px_(map.size_px) {
    OVERT_EXPECTS(map.codes.size() == area_of(size_px_));
    measure_extents(map);
    if (!any_covered_)
        return;
    cells_begin_ = box_begin_;
    cells_size_ = box_end_ - box_begin_;
    cells_.reserve(area_of(cells_size_));
    for (int y = box_begin_.y; y < box_end_.y; ++y) {
        for (int x = box_begin_.x; x < box_end_.x; ++x) {
            const std::uint32_t code = map.code_at(x, y);
            cells_.push_back(code != 0 ? PixelCell::covered(code - 1, true) : beside_cells_);
        }
    }
    if (any_uncovered_)
        find_column_borders(map);
}

void PoseCells::measure_extents(const TriangleMap& map) {
    row_extents_.resize(static_cast<std::size_t>(size_px_.y));
    column_extents_.resize(static_cast<std::size_t>(size_px_.x));
    box_begin_ = size_px_;
    box_end_ = {0, 0};
    const auto widen = [](Extent& extent, int to) {
        extent.first = std::min(extent.first, static_cast<std::int16_t>(to));
        extent.last = std::max(extent.last, static_cast<std::int16_t>(to));
    };
    for (int y = 0; y < size_px_.y; ++y) {
        const auto row = map.codes.begin() + static_cast<std::ptrdiff_t>(y) * size_px_.x;
        const auto row_end = row + size_px_.x;
        const auto is_covered = [](std::uint32_t code) { return code != 0; };
        const auto first = std::find_if(row, row_end, is_covered);
        any_uncovered_ = any_uncovered_ || first != row || std::find(row, row_end, 0u) != row_end;
        if (first == row_end)
            continue;
        any_covered_ = true;
        for (auto at = first; at != row_end; ++at) {
            if (*at == 0)
                continue;
            const int x = static_cast<int>(at - row);
            widen(row_extents_[static_cast<std::size_t>(y)], x);
            widen(column_extents_[static_cast<std::size_t>(x)], y);
        }
        const Extent extent = row_extents_[static_cast<std::size_t>(y)];
        box_begin_ = glm::min(box_begin_, glm::ivec2(extent.first, y));
        box_end_ = glm::max(box_end_, glm::ivec2(extent.last + 1, y + 1));
    }
}

void PoseCells::find_outline_from_inside(const TriangleMap& map) {
    // The box with a frame of one pixel, where the image has one, holds all of the rim.
    const glm::ivec2 begin = glm::max(box_begin_ - 1, 0), size = glm::min(box_end_ + 1, size_px_) - begin;
    PixelFlags uncovered(area_of(size));
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x)
            uncovered[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                      static_cast<std::size_t>(x)] = map.code_at(begin.x + x, begin.y + y) == 0;
    }
    const std::vector<glm::i16vec2> nearest = nearest_pixels(uncovered, size);
    std::vector<std::uint32_t> number_of(nearest.size(), 0); // in rim_, from 1
    nearest_rim_.resize(area_of(box_end_ - box_begin_));
    for (int y = box_begin_.y; y < box_end_.y; ++y) {
        for (int x = box_begin_.x; x < box_end_.x; ++x) {
            if (!cell({x, y}).is_covered())
                continue;
            const auto in_frame = [&](glm::ivec2 at) {
                return static_cast<std::size_t>(at.y) * static_cast<std::size_t>(size.x) +
                       static_cast<std::size_t>(at.x);
            };
            const glm::ivec2 pixel(nearest[in_frame(glm::ivec2(x, y) - begin)]);
            std::uint32_t& number = number_of[in_frame(pixel)];
            if (number == 0) {
                rim_.emplace_back(pixel + begin);
                number = static_cast<std::uint32_t>(rim_.size());
            }
            const std::size_t place = place_in_box({x, y});
            nearest_rim_[place] = static_cast<std::uint16_t>((number - 1) & 0xffffu);
            if (number - 1 > 0xffffu) {
                nearest_rim_high_.resize(nearest_rim_.size(), 0);
                nearest_rim_high_[place] = static_cast<std::uint8_t>((number - 1) >> 16);
            }
        }
    }
    OVERT_EXPECTS(rim_.size() <= 1u << 24);
}

void PoseCells::find_column_borders(const TriangleMap& map) {
    const auto for_borders = [&](const auto& take) {
        // The first row has no pixels above it, and the last none below.
        for (int y = std::max(box_begin_.y, 1); y < std::min(box_end_.y + 1, size_px_.y); ++y)
            for (int x = box_begin_.x; x < box_end_.x; ++x)
                if ((map.code_at(x, y - 1) != 0) != (map.code_at(x, y) != 0))
                    take(static_cast<std::size_t>(x - box_begin_.x), y);
    };
    first_border_.assign(static_cast<std::size_t>(cells_size_.x) + 1, 0);
    for_borders([&](std::size_t column, int) { ++first_border_[column + 1]; });
    std::partial_sum(first_border_.begin(), first_border_.end(), first_border_.begin());
    borders_.resize(first_border_.back());
    std::vector<std::uint32_t> next(first_border_);
    for_borders(
        [&](std::size_t column, int row) { borders_[next[column]++] = static_cast<std::int16_t>(row); });
}

/// The row of a column's pixel that is nearest to a row and covered, or not; -1 if there is none. Uncovered
/// ones are only asked for from within the box.
int PoseCells::nearest_row_in_column(int column, int row, bool covered) const {
    if (is_in_box({column, row})) {
        if (cells_[place_in_box({column, row})].is_covered() == covered)
            return row;
        const auto number = static_cast<std::size_t>(column - box_begin_.x);
        const auto begin = borders_.begin() + first_border_[number],
                   end = borders_.begin() + first_border_[number + 1];
        const auto next = std::upper_bound(begin, end, row);
        const int above = next == begin ? -1 : *(next - 1) - 1, below = next == end ? -1 : *next;
        return below < 0 || (above >= 0 && row - above <= below - row) ? above : below;
    }
    if (!covered)
        return row;
    const Extent extent = column_extents_[static_cast<std::size_t>(column)];
    return extent.first > extent.last ? -1 : row < box_begin_.y ? extent.first : extent.last;
}

/// The pixel that is covered, or not, whose centre is nearest; of several the one farthest to the left.
glm::ivec2 PoseCells::nearest_along_row(glm::ivec2 pixel, bool covered) const {
    // Beside the box nothing is covered, and the first column beside it is uncovered all along.
    const int margin = covered ? 0 : 1;
    const int first = std::max(box_begin_.x - margin, 0), end = std::min(box_end_.x + margin, size_px_.x);
    glm::ivec2 nearest(-1);
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    const auto try_column = [&](int column) {
        if (column < first || column >= end)
            return;
        const int row = nearest_row_in_column(column, pixel.y, covered);
        if (row < 0)
            return;
        const std::int64_t across = column - pixel.x, along = row - pixel.y;
        const std::int64_t squared = across * across + along * along;
        if (squared < least || (squared == least && column < nearest.x)) {
            least = squared;
            nearest = {column, row};
        }
    };
    const int begin = std::max({0, first - pixel.x, pixel.x - (end - 1)});
    for (std::int64_t step = begin; step <= size_px_.x && step * step <= least; ++step) {
        try_column(pixel.x - static_cast<int>(step));
        if (step > 0)
            try_column(pixel.x + static_cast<int>(step));
    }
    return nearest;
}

glm::dvec2 PoseCells::outline_from_beyond_the_image(glm::dvec2 point) const {
    // From beside the image, the nearest pixel of each row is the row's first or last; from above and below,
    // the nearest of each column.
    const bool beside = point.x < 0.0 || point.x >= size_px_.x;
    const std::vector<Extent>& extents = beside ? row_extents_ : column_extents_;
    const double along = beside ? point.y : point.x, across = beside ? point.x : point.y;
    const int middle =
        static_cast<int>(std::clamp(std::floor(along), 0.0, static_cast<double>(extents.size() - 1)));
    glm::dvec2 nearest = point;
    double least = std::numeric_limits<double>::infinity();
    for (int step = 0; step < static_cast<int>(extents.size()); ++step) {
        if (static_cast<double>(step - 1) * (step - 1) > least)
            break; // all further lines lie farther away than that
        for (const int line : {middle - step, middle + step}) {
            if (line < 0 || line >= static_cast<int>(extents.size()))
                continue;
            const Extent extent = extents[static_cast<std::size_t>(line)];
            if (extent.first > extent.last)
                continue;
            const int end = across < 0.0 ? extent.first : extent.last;
            const glm::dvec2 place =
                nearest_place_of(beside ? glm::ivec2(end, line) : glm::ivec2(line, end), point);
            const glm::dvec2 offset = place - point;
            if (glm::dot(offset, offset) < least) {
                least = glm::dot(offset, offset);
                nearest = place;
            }
        }
    }
    return nearest;
}

std::optional<glm::dvec2> PoseCells::outline_near(glm::dvec2 point, bool on_surface) const {
    if (!any_covered_ || !any_uncovered_ || !std::isfinite(point.x) || !std::isfinite(point.y))
        return std::nullopt;
    if (point.x < 0.0 || point.y < 0.0 || point.x >= size_px_.x || point.y >= size_px_.y)
        return outline_from_beyond_the_image(point);
    const glm::ivec2 pixel(point);
    const PixelCell here = cell(pixel);
    if (here.is_covered() != on_surface)
        return point;
    if (!first_border_.empty())
        return nearest_place_of(nearest_along_row(pixel, !on_surface), point);
    return nearest_place_of(on_surface ? nearest_uncovered(pixel) : pixel + here.to_outline(), point);
}

void PoseCells::fetch(glm::ivec2 pixel) const {
    const glm::ivec2 at = pixel - cells_begin_;
    if (at.x >= 0 && at.y >= 0 && at.x < cells_size_.x && at.y < cells_size_.y)
        __builtin_prefetch(&cells_[cell_index(at)]);
    if (!is_in_box(pixel))
        return;
    if (!nearest_rim_.empty())
        __builtin_prefetch(&nearest_rim_[place_in_box(pixel)]);
}

TriangleMap PoseCells::map() const {
    TriangleMap map{size_px_, {}};
    map.codes.reserve(area_of(size_px_));
    for (int y = 0; y < size_px_.y; ++y) {
        for (int x = 0; x < size_px_.x; ++x) {
            const PixelCell here = cell({x, y});
            map.codes.push_back(here.is_covered() ? here.triangle() + 1 : 0u);
        }
    }
    return map;
}

} // namespace overt
