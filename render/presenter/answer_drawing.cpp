#include "render/presenter/answer_drawing.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "render/image/linear_image.h"

namespace overt {

namespace {

/// Colours of one luminance (Rec. 709), 1: what is good or bad is no brighter than what is neither.
glm::vec3 tint_of(AnswerItem::Colour colour) {
    constexpr glm::vec3 luminance(0.2126f, 0.7152f, 0.0722f);
    const glm::vec3 tint = colour == AnswerItem::Colour::good  ? glm::vec3(0.35f, 1.2f, 0.45f)
                           : colour == AnswerItem::Colour::bad ? glm::vec3(2.6f, 0.55f, 0.45f)
                                                               : glm::vec3(1.0f);
    return tint / glm::dot(tint, luminance);
}

/// The mean of the pixels that each pixel of a smaller picture covers; a larger one repeats them.
glm::vec3 mean_at(const LinearImage& picture, glm::ivec2 at, glm::ivec2 of) {
    const glm::ivec2 first = at * picture.size_px / of,
                     end = glm::max((at + 1) * picture.size_px / of, first + 1);
    glm::vec3 sum(0.0f);
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x)
            sum += glm::vec3(picture.at(x, y));
    return sum / static_cast<float>((end.x - first.x) * (end.y - first.y));
}

/// The same of its alpha.
float coverage_at(const LinearImage& picture, glm::ivec2 at, glm::ivec2 of) {
    return picture.at(at.x * picture.size_px.x / of.x, at.y * picture.size_px.y / of.y).w;
}

} // namespace

const LinearImage& AnswerPictures::of(const std::string& file) {
    const auto known = read_.find(file);
    if (known != read_.end())
        return known->second;
    const bool is_linear = file.ends_with(".exr") || file.ends_with(".hdr");
    return read_
        .emplace(file, read_linear_image(file, is_linear ? FrameEncoding::linear : FrameEncoding::srgb))
        .first->second;
}

AnswerPlace place_among(std::span<const AnswerTarget> targets, glm::dvec2 at_px) noexcept {
    for (std::size_t i = targets.size(); i-- > 0;) {
        const AnswerTarget& target = targets[i];
        const InkBox& box = target.box;
        if (at_px.x < box.x || at_px.y < box.y || at_px.x >= box.x + box.width ||
            at_px.y >= box.y + box.height)
            continue;
        AnswerPlace place = target.place;
        if (target.from && target.over && *target.over > 0.0)
            place.along = std::clamp((at_px.x - *target.from) / *target.over, 0.0, 1.0);
        return place;
    }
    return {};
}

void AnswerDrawing::add(AnswerDrawing part, glm::ivec2 at_px) {
    const glm::dvec2 by(at_px);
    const auto move = [&](InkBox& box) {
        box.x += by.x;
        box.y += by.y;
    };
    for (Shape& shape : part.shapes)
        move(shape.box);
    for (Text& text : part.texts)
        text.origin_px += at_px;
    for (Picture& picture : part.pictures)
        picture.origin_px += at_px;
    for (AnswerTarget& target : part.targets) {
        move(target.box);
        if (target.from)
            *target.from += by.x;
    }
    const auto append = [](auto& to, auto& from) {
        to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
    };
    append(shapes, part.shapes);
    append(texts, part.texts);
    append(pictures, part.pictures);
    append(targets, part.targets);
    unknown_glyphs += part.unknown_glyphs;
}

glm::ivec2 AnswerDrawing::write(const std::string& text, const TextStyle& style, glm::ivec2 at_px,
                                double strength) {
    const TextMeasure measure = measure_text(text, style);
    texts.push_back({text, style, at_px, measure.size_px, strength});
    unknown_glyphs += measure.unknown_glyphs;
    return measure.size_px;
}

void AnswerDrawing::put_on(InkCanvas& canvas, glm::ivec2 corner_px) const {
    const glm::dvec2 by(corner_px);
    for (const Shape& shape : shapes) {
        const InkBox box{shape.box.x + by.x, shape.box.y + by.y, shape.box.width, shape.box.height};
        const glm::dvec2 middle(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
        switch (shape.kind) {
        case Shape::Kind::fill:
            canvas.fill(box, shape.strength, shape.radius_px);
            break;
        case Shape::Kind::outline:
            canvas.outline(box, shape.strength, shape.line_px, shape.radius_px);
            break;
        case Shape::Kind::line:
            canvas.line({box.x, box.y}, {box.x + box.width, box.y + box.height}, shape.strength,
                        shape.line_px);
            break;
        case Shape::Kind::ring:
            canvas.ring(middle, 0.5 * box.width, shape.strength, shape.line_px);
            break;
        case Shape::Kind::disc:
            canvas.fill(box, shape.strength, 0.5 * box.width);
            break;
        }
    }
    for (const Text& text : texts) {
        const glm::ivec2 at = text.origin_px + corner_px;
        if (!text.text.empty())
            put_text(canvas, text.text, text.style, at, text.strength);
        if (text.caret)
            put_caret(canvas, text.text, text.style, at, *text.caret);
    }
}

void AnswerDrawing::colour(LinearImage& drawn, glm::ivec2 origin_px, glm::ivec2 corner_px, float grey,
                           float background, AnswerPictures& read) const {
    const auto in_drawn = [&](glm::ivec2 at) {
        return at.x >= 0 && at.y >= 0 && at.x < drawn.size_px.x && at.y < drawn.size_px.y;
    };
    for (const Text& text : texts) {
        if (text.colour == AnswerItem::Colour::plain)
            continue;
        const glm::vec3 ink = grey * tint_of(text.colour);
        for (int y = 0; y < text.size_px.y; ++y)
            for (int x = 0; x < text.size_px.x; ++x)
                if (const glm::ivec2 at = text.origin_px + corner_px - origin_px + glm::ivec2(x, y);
                    in_drawn(at)) {
                    glm::vec4& pixel = drawn.at(at.x, at.y);
                    pixel = glm::vec4(background + pixel.w * (glm::min(ink, 1.0f) - background), pixel.w);
                }
    }
    for (const Picture& picture : pictures) {
        const LinearImage& from = read.of(picture.file);
        for (int y = 0; y < picture.size_px.y; ++y)
            for (int x = 0; x < picture.size_px.x; ++x)
                if (const glm::ivec2 at = picture.origin_px + corner_px - origin_px + glm::ivec2(x, y);
                    in_drawn(at)) {
                    glm::vec4& pixel = drawn.at(at.x, at.y);
                    const float through = 1.0f - coverage_at(from, {x, y}, picture.size_px);
                    pixel =
                        glm::vec4(mean_at(from, {x, y}, picture.size_px) + through * glm::vec3(pixel), 1.0f);
                }
    }
}

} // namespace overt
