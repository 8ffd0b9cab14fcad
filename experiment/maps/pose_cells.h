/// The hidden map of one pose, made ready for questions: each pixel's cell says in 32 bits which triangle it
/// shows and whether that is the whole truth, or where the object's outline is nearest.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/base/large_pages.h"
#include "experiment/maps/contours.h"
#include "experiment/maps/triangle_map.h"

namespace overt {

/// One pixel.
class PixelCell {
  public:
    static constexpr std::uint32_t most_triangles = 1u << 30;

    static PixelCell covered(std::uint32_t triangle, bool contested) {
        return PixelCell(triangle | (contested ? contested_bit : 0u));
    }
    /// `outline`: offset to the nearest covered pixel, each within ± 16,383.
    static PixelCell uncovered(glm::ivec2 outline, bool contested) {
        return PixelCell(uncovered_bit | (contested ? contested_bit : 0u) |
                         static_cast<std::uint32_t>(outline.x + bias) << 15 |
                         static_cast<std::uint32_t>(outline.y + bias));
    }

    /// The object is seen at the pixel's centre.
    bool is_covered() const { return (bits_ & uncovered_bit) == 0; }
    /// More than one sheet of surface, or surface and background, may be seen within the pixel.
    bool is_contested() const { return (bits_ & contested_bit) != 0; }
    /// Only of a covered pixel.
    std::uint32_t triangle() const { return bits_ & (most_triangles - 1); }
    /// Only of one that is not covered.
    glm::ivec2 to_outline() const {
        return {static_cast<int>(bits_ >> 15 & 0x7fffu) - bias, static_cast<int>(bits_ & 0x7fffu) - bias};
    }

  private:
    explicit PixelCell(std::uint32_t bits) : bits_(bits) {}
    static constexpr std::uint32_t uncovered_bit = 1u << 31, contested_bit = 1u << 30;
    static constexpr int bias = 1 << 14;
    std::uint32_t bits_;
};

/// All pixels of a pose.
class PoseCells {
  public:
    /// For many questions: each finds its place of the outline ready. Takes 4 bytes for each pixel, and 2
    /// more (3 if the outline is longer than 65,536 pixels) within the box around those that are covered.
    /// `contested` has a flag for each pixel of the map.
    PoseCells(const TriangleMap& map, const PixelFlags& contested);

    /// For few questions, with the same answers: each looks for its place of the outline along a row, which
    /// takes some nanoseconds for each pixel of the distance. Takes 4 bytes for each pixel of the box
    /// around those that are covered, and is made in a small part of the time. All pixels are contested.
    explicit PoseCells(const TriangleMap& map);

    glm::ivec2 size_px() const { return size_px_; }
    bool is_inside(glm::ivec2 pixel) const {
        return pixel.x >= 0 && pixel.y >= 0 && pixel.x < size_px_.x && pixel.y < size_px_.y;
    }
    /// Of a pixel inside the image.
    PixelCell cell(glm::ivec2 pixel) const {
        const glm::ivec2 at = pixel - cells_begin_;
        return at.x >= 0 && at.y >= 0 && at.x < cells_size_.x && at.y < cells_size_.y ? cells_[cell_index(at)]
                                                                                      : beside_cells_;
    }

    /// The place of the outline that is nearest to a point, of which the caller knows whether the object is
    /// seen there. The outline is taken to run along the borders between covered and uncovered pixels, so its
    /// distance is right to within a pixel. Where the map has the point's pixel on the other side of the
    /// outline than it is, the point itself. Nothing if no pixel is covered, or all are.
    std::optional<glm::dvec2> outline_near(glm::dvec2 point_px, bool on_surface) const;

    /// Brings what cell() and outline_near() read for a pixel inside the image nearer to the processor.
    void fetch(glm::ivec2 pixel) const;

    TriangleMap map() const;

  private:
    /// First and last covered pixel of a row or column; first > last if there is none.
    struct Extent {
        std::int16_t first = std::numeric_limits<std::int16_t>::max();
        std::int16_t last = -1;
    };

    void measure_extents(const TriangleMap& map);
    void find_outline_from_inside(const TriangleMap& map);
    void find_column_borders(const TriangleMap& map);
    bool is_in_box(glm::ivec2 pixel) const {
        return pixel.x >= box_begin_.x && pixel.y >= box_begin_.y && pixel.x < box_end_.x &&
               pixel.y < box_end_.y;
    }
    std::size_t cell_index(glm::ivec2 in_cells) const {
        return static_cast<std::size_t>(in_cells.y) * static_cast<std::size_t>(cells_size_.x) +
               static_cast<std::size_t>(in_cells.x);
    }
    std::size_t place_in_box(glm::ivec2 pixel) const {
        const glm::ivec2 in_box = pixel - box_begin_;
        return static_cast<std::size_t>(in_box.y) * static_cast<std::size_t>(box_end_.x - box_begin_.x) +
               static_cast<std::size_t>(in_box.x);
    }
    glm::ivec2 nearest_uncovered(glm::ivec2 covered_pixel) const {
        const std::size_t place = place_in_box(covered_pixel);
        const std::size_t high = nearest_rim_high_.empty() ? 0u : nearest_rim_high_[place];
        return glm::ivec2(rim_[high << 16 | nearest_rim_[place]]);
    }
    int nearest_row_in_column(int column, int row, bool covered) const;
    glm::ivec2 nearest_along_row(glm::ivec2 pixel, bool covered) const;
    glm::dvec2 outline_from_beyond_the_image(glm::dvec2 point_px) const;

    glm::ivec2 size_px_;
    glm::ivec2 cells_begin_{0}, cells_size_{0}; ///< the pixels that have cells: all, or those of the box
    LargePageVector<PixelCell> cells_;
    PixelCell beside_cells_ = PixelCell::uncovered({0, 0}, true);
    std::vector<Extent> row_extents_, column_extents_;
    glm::ivec2 box_begin_{0}, box_end_{0}; ///< pixels around all that are covered
    std::vector<glm::i16vec2> rim_;        ///< uncovered pixels, each nearest to one that is covered
    /// By pixel of the box, index into rim_: its lower 16 bits, and where they do not suffice the next 8.
    LargePageVector<std::uint16_t> nearest_rim_;
    std::vector<std::uint8_t> nearest_rim_high_;
    /// For few questions: the rows, from top to bottom, at which a column of the box goes from covered to
    /// uncovered or back, and where each column's begin, with their number at the end.
    std::vector<std::int16_t> borders_;
    std::vector<std::uint32_t> first_border_;
    bool any_covered_ = false, any_uncovered_ = false;
};

} // namespace overt
