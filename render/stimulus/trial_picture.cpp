#include "render/stimulus/trial_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "experiment/analysis/voxel_density.h"
#include "experiment/base/parallel.h"
#include "render/image/text_layout.h"

namespace overt {

namespace {

constexpr float paper = 0.012f; ///< grey behind the panels
constexpr int margin_px = 24;
constexpr int caption_px = 34;

/// Calls draw(point, pixel) for each pixel whose centre is on the object.
template <class Draw>
LinearImage picture_of_surface(const CoordinateMaps& maps, PoseIndex pose, const Draw& draw) {
    LinearImage image(maps.image_px());
    parallel_for(image.size_px.y, [&](int y) {
        for (int x = 0; x < image.size_px.x; ++x) {
            if (!maps.cells(pose).cell({x, y}).is_covered())
                continue;
            const auto surface = maps.surface_at(pose, {x + 0.5, y + 0.5});
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
    VoxelDensity density(content.mesh->bounds(), content.kernel_sigma);
    for (const glm::dvec3& point : content.gaze_on_surface)
        density.add(point);
    density.blur();
    double highest = 0.0;
    for (const glm::dvec3& point : content.gaze_on_surface)
        highest = std::max(highest, density.at(point));
    return picture_of_surface(*content.maps, content.pose, [&](const SurfacePoint& surface) {
        const float facing = static_cast<float>(std::cos(to_radians(surface.incidence).value));
        const glm::vec3 clay = glm::vec3(0.02f + 0.33f * facing * facing);
        if (highest <= 0.0)
            return clay;
        const float heat = static_cast<float>(density.at(surface.position) / highest);
        // Transparent where nobody looked; the shape stays readable below.
        return glm::mix(clay, heat_colour(heat) * (0.45f + 0.55f * facing), std::min(1.0f, 6.0f * heat));
    });
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

void write_caption(LinearImage& onto, const std::string& text, int left, int top, int width) {
    TextStyle style;
    style.line_height_px = caption_px;
    style.wrap_width_px = width;
    style.grey = 0.75f;
    style.background = paper;
    LinearImage caption = draw_text(text, style);
    for (glm::vec4& pixel : caption.pixels)
        pixel.w = 1.0f;
    paste(onto, caption, {left + (width - caption.size_px.x) / 2, top});
}

} // namespace

LinearImage map_as_colours(const CoordinateMaps& maps, const Mesh& mesh, PoseIndex pose) {
    const Bounds bounds = mesh.bounds();
    const glm::dvec3 extent = glm::max(bounds.extent(), glm::dvec3(1e-300));
    return picture_of_surface(maps, pose, [&](const SurfacePoint& surface) {
        return glm::vec3((surface.position - bounds.min) / extent);
    });
}

LinearImage draw_trial_picture(const TrialPictureContent& content) {
    const glm::ivec2 panel = content.frame.size_px;
    LinearImage picture({3 * panel.x + 4 * margin_px, panel.y + 2 * margin_px + 2 * caption_px});
    std::fill(picture.pixels.begin(), picture.pixels.end(), glm::vec4(glm::vec3(paper), 1.0f));
    LinearImage frame = content.frame;
    for (glm::vec4& pixel : frame.pixels)
        pixel.w = 1.0f; // on black, as on the display
    const std::array<LinearImage, 3> panels{frame, map_as_colours(*content.maps, *content.mesh, content.pose),
                                            gaze_panel(content)};
    const std::array<const std::string*, 3> captions{&content.frame_caption, &content.map_caption,
                                                     &content.gaze_caption};
    LinearImage black(panel);
    for (glm::vec4& pixel : black.pixels)
        pixel.w = 1.0f;
    for (int i = 0; i < 3; ++i) {
        const glm::ivec2 origin(margin_px + i * (panel.x + margin_px), margin_px);
        paste(picture, black, origin);
        paste(picture, panels[static_cast<std::size_t>(i)], origin);
        write_caption(picture, *captions[static_cast<std::size_t>(i)], origin.x,
                      origin.y + panel.y + margin_px / 2, panel.x);
    }
    return picture;
}

} // namespace overt
