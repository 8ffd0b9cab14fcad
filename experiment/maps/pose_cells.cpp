#include "experiment/maps/pose_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiment/base/error.h"
#include "experiment/maps/nearest_pixel.h"

namespace overt {

namespace {

std::size_t area_of(glm::ivec2 size) {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
}

} // namespace

PoseCells::PoseCells(const TriangleMap& map, const PixelFlags& contested) : size_px_(map.size_px) {
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
    measure_extents();
    if (any_covered_ && any_uncovered_)
        find_outline_from_inside(map);
}

void PoseCells::measure_extents() {
    row_extents_.resize(static_cast<std::size_t>(size_px_.y));
    column_extents_.resize(static_cast<std::size_t>(size_px_.x));
    box_begin_ = size_px_;
    box_end_ = {0, 0};
    const auto widen = [](Extent& extent, int to) {
        extent.first = std::min(extent.first, static_cast<std::int16_t>(to));
        extent.last = std::max(extent.last, static_cast<std::int16_t>(to));
    };
    for (int y = 0; y < size_px_.y; ++y) {
        for (int x = 0; x < size_px_.x; ++x) {
            if (!cell({x, y}).is_covered()) {
                any_uncovered_ = true;
                continue;
            }
            any_covered_ = true;
            widen(row_extents_[static_cast<std::size_t>(y)], x);
            widen(column_extents_[static_cast<std::size_t>(x)], y);
            box_begin_ = glm::min(box_begin_, glm::ivec2(x, y));
            box_end_ = glm::max(box_end_, glm::ivec2(x + 1, y + 1));
        }
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
    return nearest_place_of(on_surface ? nearest_uncovered(pixel) : pixel + here.to_outline(), point);
}

void PoseCells::fetch_outline(glm::ivec2 pixel) const {
    if (pixel.x >= box_begin_.x && pixel.y >= box_begin_.y && pixel.x < box_end_.x && pixel.y < box_end_.y &&
        !nearest_rim_.empty())
        __builtin_prefetch(&nearest_rim_[place_in_box(pixel)]);
}

TriangleMap PoseCells::map() const {
    TriangleMap map{size_px_, std::vector<std::uint32_t>(cells_.size())};
    std::transform(cells_.begin(), cells_.end(), map.codes.begin(),
                   [](PixelCell cell) { return cell.is_covered() ? cell.triangle() + 1 : 0u; });
    return map;
}

std::size_t PoseCells::memory_bytes() const {
    return cells_.capacity() * sizeof(PixelCell) + rim_.capacity() * sizeof(glm::i16vec2) +
           nearest_rim_.capacity() * sizeof(std::uint16_t) + nearest_rim_high_.capacity() +
           (row_extents_.capacity() + column_extents_.capacity()) * sizeof(Extent);
}

} // namespace overt
