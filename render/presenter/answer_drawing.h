/// What is drawn of answers, as data: first laid out, then drawn, then asked what lies under a place.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/ports/answer_view.h"
#include "render/image/linear_image.h"
#include "render/image/text_layout.h"

namespace overt {

/// Pictures of choices, each read once.
class AnswerPictures {
  public:
    /// In linear light; files that are not of linear light by their kind (EXR, Radiance) are taken for sRGB.
    /// Throws InputError if it cannot be read.
    const LinearImage& of(const std::string& file);

  private:
    std::map<std::string, LinearImage> read_;
};

/// A part of what can be touched, and what it is.
struct AnswerTarget {
    InkBox box;
    AnswerPlace place;                ///< without `along`
    std::optional<double> from, over; ///< of a line: its left end, and how far it reaches, in pixels
};

/// What lies at a place: of targets that lie on each other, the one that was put last.
AnswerPlace place_among(std::span<const AnswerTarget> targets, glm::dvec2 at_px) noexcept;

/// Things at their places, in pixels from the top left corner. Its size has room for whatever may be
/// answered, so that nothing moves while it is.
struct AnswerDrawing {
    struct Shape {
        enum class Kind : std::uint8_t { fill, outline, line, ring, disc };
        Kind kind = Kind::fill;
        InkBox box; ///< of a line, from its corner to the opposite one
        double strength = 1.0, line_px = 1.0, radius_px = 0.0;
    };
    struct Text {
        std::string text;
        TextStyle style;
        glm::ivec2 origin_px{0}, size_px{0};
        double strength = 1.0;
        AnswerItem::Colour colour = AnswerItem::Colour::plain;
        std::optional<std::size_t> caret = {}; ///< drawn before this byte
    };
    struct Picture {
        std::string file;
        glm::ivec2 origin_px{0}, size_px{0};
    };

    glm::ivec2 size_px{0};
    std::vector<Shape> shapes; ///< below everything else
    std::vector<Text> texts;
    std::vector<Picture> pictures;
    std::vector<AnswerTarget> targets;
    int unknown_glyphs = 0;

    /// Puts another one on this. Its size stays.
    void add(AnswerDrawing part, glm::ivec2 at_px);
    /// Puts a text there, and gives its size. Its unknown glyphs are counted.
    glm::ivec2 write(const std::string& text, const TextStyle& style, glm::ivec2 at_px,
                     double strength = 1.0);

    /// All but colours and pictures.
    void put_on(InkCanvas& canvas, glm::ivec2 corner_px) const;
    /// Those: onto what the canvas came out as, which begins at `origin_px` of the canvas. `grey` is that of
    /// the letters; colours are as bright.
    void colour(LinearImage& drawn, glm::ivec2 origin_px, glm::ivec2 corner_px, float grey, float background,
                AnswerPictures& pictures) const;
};

} // namespace overt
