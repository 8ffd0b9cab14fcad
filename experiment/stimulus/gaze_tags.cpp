#include "experiment/stimulus/gaze_tags.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "experiment/base/error.h"
#include "experiment/stimulus/photodiode_patch.h"

namespace overt {

namespace {

constexpr int code_modules = 6, code_begin = 2;

/// Row by row, the first module in the highest of 36 bits; white is 1. Of AprilTag 3.3.
constexpr std::array<std::uint64_t, most_tags> codes{0xD5D628584, 0xD97F18B49, 0xDD280910E,
                                                     0xE479E9C98, 0xEBCBCA822, 0xF31DAB3AC};

} // namespace

bool is_white_module(int id, int column, int row) {
    OVERT_EXPECTS(id >= 0 && id < most_tags && column >= 0 && column < tag_modules && row >= 0 &&
                  row < tag_modules);
    if (column == 0 || row == 0 || column == tag_modules - 1 || row == tag_modules - 1)
        return true;
    const int x = column - code_begin, y = row - code_begin;
    if (x < 0 || y < 0 || x >= code_modules || y >= code_modules)
        return false;
    const int bit = code_modules * code_modules - 1 - (y * code_modules + x);
    return (codes[static_cast<std::size_t>(id)] >> bit & 1U) != 0;
}

bool touches(const TagPlace& tag, glm::ivec2 origin_px, glm::ivec2 size_px) {
    const glm::ivec2 first = tag.origin_px - tag_distance_px, end = tag.end_px() + tag_distance_px,
                     other_end = origin_px + size_px;
    return first.x < other_end.x && end.x > origin_px.x && first.y < other_end.y && end.y > origin_px.y;
}

std::vector<TagPlace> gaze_tags_of(const ScreenGeometry& geometry, const DisplaySettings& display,
                                   std::span<const ImageBox> images) {
    if (display.tags_px == 0)
        return {};
    const glm::ivec2 size(display.tags_px), first(0, reserved_rows(display.output)),
        last = geometry.screen_px - size;
    const std::array<int, 2> columns{first.x, last.x};
    const std::array<int, 3> rows{first.y, (first.y + last.y) / 2, last.y};
    const std::optional<PatchPlace> patch = photodiode_patch_of(display);
    const ImageBox only = geometry.image_box();
    if (images.empty())
        images = {&only, 1};
    std::vector<TagPlace> tags;
    int id = 0;
    for (const int row : rows) {
        for (const int column : columns) {
            const TagPlace tag{id++, row != rows[1], {column, row}, size};
            bool is_free =
                std::ranges::none_of(images, [&](const ImageBox& image) { return touches(tag, image); }) &&
                !(patch && touches(tag, patch->origin_px, patch->size_px));
            for (const TagPlace& other : tags)
                is_free = is_free && !touches(tag, other.origin_px, other.size_px);
            if (is_free || tag.is_corner)
                tags.push_back(tag);
        }
    }
    return tags;
}

TaggedArea tagged_area(const std::vector<TagPlace>& tags) {
    OVERT_EXPECTS(tags.size() >= 4);
    const glm::dvec2 border = glm::dvec2(tags.front().size_px) / static_cast<double>(tag_modules);
    const glm::dvec2 first = glm::dvec2(tags.front().origin_px) + border,
                     end = glm::dvec2(tags.back().end_px()) - border;
    return {first, end - first};
}

} // namespace overt
