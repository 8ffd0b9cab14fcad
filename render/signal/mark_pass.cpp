#include "render/signal/mark_pass.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "signal_shaders.h"

namespace overt {

namespace {

constexpr std::array<double, 3> rim_light{0.0, 0.0, 0.0};
constexpr std::size_t most_inks = 16;

/// A patch that holds all of a line, and the pixels that share a colour with its edge.
ScreenPatch around(const MarkLine& line, double reach_px, const ScreenPatch& within) {
    glm::dvec2 first(1e9), last(-1e9);
    for (std::size_t i = 0; i < line.count; ++i) {
        const glm::dvec2 point(line.points[i].x_px, line.points[i].y_px);
        first = glm::min(first, point);
        last = glm::max(last, point);
    }
    const glm::ivec2 begin = glm::max(glm::ivec2(glm::floor(first - reach_px)) - 2, within.origin_px),
                     end = glm::min(glm::ivec2(glm::ceil(last + reach_px)) + 2,
                                    within.origin_px + within.size_px);
    return {begin, glm::max(end - begin, glm::ivec2(0))};
}

} // namespace

MarkPass::MarkPass(const GlContext& context, const DisplaySettings& display)
    : context_(&context), encoder_(display),
      program_(context, "marks", embedded::encode_vert, embedded::mark_frag), no_attributes_(context),
      joined_px_(joins_pixels_in_pairs(display.output) ? 2 : 1), rim_(encoded(rim_light)) {}

/// As the middle of a wide patch of this light, where no filter reaches its edge.
MarkPass::Ink MarkPass::encoded(const std::array<double, 3>& light) const {
    constexpr int width = 64, begin = 64, column = begin + width / 2;
    LinearImage picture(glm::ivec2(width, 1));
    std::ranges::fill(picture.pixels, glm::vec4(light[0], light[1], light[2], 1.0));
    const glm::ivec2 origin(begin, begin);
    const ScreenPatch patch = encoder_.patch_of(origin, picture.size_px);
    std::vector<std::byte> bytes(bytes_in(patch.size_px, encoder_.format()));
    encoder_.encode(picture, origin, bytes);
    Ink ink{};
    for (std::size_t i = 0; i < ink.size(); ++i)
        for (int channel = 0; channel < 4; ++channel) {
            const auto at =
                static_cast<std::size_t>(4 * (column - patch.origin_px.x + static_cast<int>(i)) + channel);
            if (encoder_.format() == PixelFormat::rgba16) {
                std::uint16_t code = 0;
                std::memcpy(&code, bytes.data() + 2 * at, sizeof code);
                ink[i][channel] = static_cast<float>(code) / 65535.0f;
            } else {
                ink[i][channel] = static_cast<float>(std::to_integer<int>(bytes[at])) / 255.0f;
            }
        }
    return ink;
}

const MarkPass::Ink* MarkPass::ink_of(const std::array<double, 3>& light) const noexcept {
    const auto known = std::ranges::find(inks_, light, &KnownInk::light);
    return known == inks_.end() ? nullptr : &known->ink;
}

void MarkPass::prepare(const std::array<double, 3>& light) {
    if (ink_of(light))
        return;
    if (inks_.size() == most_inks)
        inks_.erase(inks_.begin());
    inks_.push_back({light, encoded(light)});
}

void MarkPass::draw_line(const MarkLine& line, double reach_px, const Ink& ink) noexcept {
    std::array<glm::vec2, MarkLine::most_points> points{};
    for (std::size_t i = 0; i < line.count; ++i)
        points[i] = glm::vec2(line.points[i].x_px, line.points[i].y_px);
    program_.set("points", std::span<const glm::vec2>(points.data(), line.count));
    program_.set("count", static_cast<int>(line.count));
    program_.set("reach", static_cast<float>(reach_px));
    program_.set("inks", std::span<const glm::vec4>(ink));
    context_->gl().DrawArrays(GL_TRIANGLES, 0, 3);
}

void MarkPass::draw(const StimulusMark& mark, const Framebuffer& target, const ScreenPatch& within) noexcept {
    const Ink* const ink = ink_of(mark.light);
    if (!ink)
        return;
    const GladGLContext& gl = context_->gl();
    target.bind();
    for (const GLenum state : {GL_BLEND, GL_DITHER, GL_MULTISAMPLE, GL_DEPTH_TEST, GL_CULL_FACE})
        gl.Disable(state);
    gl.Enable(GL_SCISSOR_TEST);
    program_.use();
    program_.set("joined", joined_px_);
    no_attributes_.bind();
    // The rims of all lines below all lines.
    for (const bool is_rim : {true, false}) {
        if (is_rim && !(mark.rim_px > 0.0))
            continue;
        for (std::size_t i = 0; i < mark.count; ++i) {
            const MarkLine& line = mark.lines[i];
            const double reach = 0.5 * line.width_px + (is_rim ? mark.rim_px : 0.0);
            const ScreenPatch patch = around(line, reach, within);
            if (line.count == 0 || patch.size_px.x == 0 || patch.size_px.y == 0)
                continue;
            gl.Scissor(patch.origin_px.x, patch.origin_px.y, patch.size_px.x, patch.size_px.y);
            draw_line(line, reach, is_rim ? rim_ : *ink);
        }
    }
    gl.Disable(GL_SCISSOR_TEST);
}

} // namespace overt
