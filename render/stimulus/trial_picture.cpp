#include "render/stimulus/trial_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "experiment/base/parallel.h"
#include "experiment/surface/voxel_density.h"
#include "render/image/text_layout.h"

namespace overt {

namespace {

constexpr float paper = 0.012f; ///< grey behind the panels
constexpr int margin_px = 24;
/// Letters of a caption, by the width that it may have.
constexpr int largest_caption_px = 34, smallest_caption_px = 12;
constexpr int scale_px = 12; ///< height of the colour scale

/// Calls draw(point, pixel) for each pixel whose centre is on the object.
template <class Draw> LinearImage picture_of_surface(const TrialPictureContent& content, const Draw& draw) {
    LinearImage image(content.frame.size_px);
    parallel_for(image.size_px.y, [&](int y) {
        for (int x = 0; x < image.size_px.x; ++x) {
            const auto surface = content.surface->surface_at(content.pose, {x + 0.5, y + 0.5});
            if (surface)
                image.at(x, y) = glm::vec4(draw(*surface), 1.0f);
        }
    });
    return image;
}

/// Dark to light through purple, red and yellow, even in lightness; after the look of matplotlib's "inferno",
/// in linear light.
glm::vec3 heat_colour(float t) {
    constexpr std::array<glm::vec3, 6> stops{glm::vec3(0.02f, 0.01f, 0.08f), {0.14f, 0.01f, 0.18f},
                                             {0.46f, 0.03f, 0.13f},          {0.83f, 0.12f, 0.03f},
                                             {0.97f, 0.45f, 0.02f},          {0.98f, 0.96f, 0.40f}};
    const float place = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(stops.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    return glm::mix(stops[below], stops[below + 1], place - static_cast<float>(below));
}

LinearImage gaze_panel(const TrialPictureContent& content) {
    VoxelDensity density(content.bounds, content.kernel_sigma);
    for (const glm::dvec3& point : content.gaze_on_surface)
        density.add(point);
    density.blur();
    double highest = 0.0;
    for (const glm::dvec3& point : content.gaze_on_surface)
        highest = std::max(highest, density.at(point));
    return picture_of_surface(content, [&](const SurfacePoint& surface) {
        const float facing = static_cast<float>(std::cos(to_radians(surface.incidence).value));
        const glm::vec3 clay = glm::vec3(0.02f + 0.33f * facing * facing);
        if (highest <= 0.0)
            return clay;
        const auto heat = static_cast<float>(density.at(surface.position) / highest);
        // Transparent where no gaze fell; the shape stays readable below.
        return glm::mix(clay, heat_colour(heat) * (0.45f + 0.55f * facing), std::min(1.0f, 6.0f * heat));
    });
}

LinearImage opaque(LinearImage picture) {
    for (glm::vec4& pixel : picture.pixels)
        pixel.w = 1.0f;
    return picture;
}

void paste(LinearImage& onto, const LinearImage& picture, glm::ivec2 origin) {
    for (int y = 0; y < picture.size_px.y; ++y) {
        for (int x = 0; x < picture.size_px.x; ++x) {
            if (origin.x + x < 0 || origin.x + x >= onto.size_px.x || origin.y + y >= onto.size_px.y)
                continue;
            glm::vec4& pixel = onto.at(origin.x + x, origin.y + y);
            const glm::vec4& top = picture.at(x, y);
            pixel = glm::vec4(glm::vec3(top) + (1.0f - top.w) * glm::vec3(pixel), 1.0f);
        }
    }
}

TextStyle caption_style(int width) {
    TextStyle style;
    style.line_height_px = std::clamp(width / 15, smallest_caption_px, largest_caption_px);
    style.wrap_width_px = width;
    style.grey = 0.75f;
    style.background = paper;
    return style;
}

void write_caption(LinearImage& onto, const std::string& text, int left, int top, int width) {
    const LinearImage caption = opaque(draw_text(text, caption_style(width)));
    paste(onto, caption, {left + (width - caption.size_px.x) / 2, top});
}

/// Red, green and blue are the object's x, y and z within its bounding box, in linear light.
LinearImage map_panel(const TrialPictureContent& content) {
    const glm::dvec3 extent = glm::max(content.bounds.extent(), glm::dvec3(1e-300));
    return picture_of_surface(content, [&](const SurfacePoint& surface) {
        return glm::vec3((surface.position - content.bounds.min) / extent);
    });
}

/// From no gaze to the densest, with its ends named; in the middle three fifths of a width.
void draw_scale(LinearImage& onto, int left, int top, int width) {
    const int first = left + width / 5, end = left + width - width / 5;
    for (int x = first; x < end; ++x) {
        const float share = static_cast<float>(x - first) / static_cast<float>(end - 1 - first);
        for (int y = top; y < top + scale_px; ++y)
            onto.at(x, y) = glm::vec4(heat_colour(share), 1.0f);
    }
    TextStyle style = caption_style(width);
    style.line_height_px = smallest_caption_px;
    const LinearImage none = draw_text("0", style), most = draw_text("1", style);
    paste(onto, none, {first - none.size_px.x - 4, top + (scale_px - none.size_px.y) / 2});
    paste(onto, most, {end + 4, top + (scale_px - most.size_px.y) / 2});
}

} // namespace

LinearImage draw_trial_picture(const TrialPictureContent& content) {
    const glm::ivec2 panel = content.frame.size_px;
    const std::array<const std::string*, 3> captions{&content.frame_caption, &content.map_caption,
                                                     &content.gaze_caption};
    int caption_height = 0;
    for (const std::string* caption : captions)
        caption_height = std::max(caption_height, measure_text(*caption, caption_style(panel.x)).size_px.y);
    const int captions_top = margin_px + panel.y + margin_px / 2 + scale_px + margin_px / 2;
    LinearImage picture({3 * panel.x + 4 * margin_px, captions_top + caption_height + margin_px});
    std::fill(picture.pixels.begin(), picture.pixels.end(), glm::vec4(glm::vec3(paper), 1.0f));
    // The frame is there as the display shows it; the others stand on black.
    const std::array<LinearImage, 3> panels{opaque(content.frame), opaque(map_panel(content)),
                                            opaque(gaze_panel(content))};
    for (int i = 0; i < 3; ++i) {
        const int left = margin_px + i * (panel.x + margin_px);
        paste(picture, panels[static_cast<std::size_t>(i)], {left, margin_px});
        write_caption(picture, *captions[static_cast<std::size_t>(i)], left, captions_top, panel.x);
    }
    draw_scale(picture, margin_px + 2 * (panel.x + margin_px), margin_px + panel.y + margin_px / 2, panel.x);
    return picture;
}

} // namespace overt
