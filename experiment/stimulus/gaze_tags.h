/// AprilTags around the stimulus, by which an eye tracker with a scene camera finds the screen.
#pragma once

#include <span>
#include <vector>

#include "experiment/protocol/protocol.h"
#include "experiment/screen_geometry.h"

namespace overt {

/// A tag is ten modules wide: a white border, a black one, and six by six modules of its code.
inline constexpr int tag_modules = 10;

/// How many tags there are, and so places for them.
inline constexpr int most_tags = 6;

/// So far must a tag be from the stimulus: no filter over pairs reaches farther.
inline constexpr int tag_distance_px = 12;

/// Whether a module of tag `id` (0 … 5 of the family tag36h11, AprilTag 3) is white; from the tag's top left.
bool is_white_module(int id, int column, int row);

struct TagPlace {
    int id = 0;
    bool is_corner = false;
    glm::ivec2 origin_px{0}, size_px{0};
    glm::ivec2 end_px() const { return origin_px + size_px; }
};

/// The places of the tags that [display] tags_px asks for: in the corners of the screen, below the rows that
/// carry messages, and in the middle of the left and the right edge where the stimulus and the square for a
/// photodiode leave room; texts stand between them. The ids are the same whichever are left out: row by row
/// from the top left. Corners are given in any case: whether they are free is for the check of protocols to
/// say.
/// `images`: where images stand in slots; none: there is one, as `geometry` has it.
std::vector<TagPlace> gaze_tags_of(const ScreenGeometry& geometry, const DisplaySettings& display,
                                   std::span<const ImageBox> images = {});

/// Whether a tag is closer than tag_distance_px to this rectangle of the screen.
bool touches(const TagPlace& tag, glm::ivec2 origin_px, glm::ivec2 size_px);
inline bool touches(const TagPlace& tag, const ImageBox& image) {
    return touches(tag, image.origin_px, image.size_px);
}

/// What the tags span, from the black border of the first to that of the last: the surface that a tracker
/// knows by them.
struct TaggedArea {
    glm::dvec2 origin_px{0.0}, size_px{0.0};
};

/// Of at least four tags, one in each corner.
TaggedArea tagged_area(const std::vector<TagPlace>& tags);

} // namespace overt
