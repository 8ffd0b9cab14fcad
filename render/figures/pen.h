/// Draws vector figures: lines, boxes and text, in millimetres, with the origin at the top left.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace overt {

/// Red, green, blue, 0 … 1, as a screen has them.
using FigureColour = std::array<double, 3>;

inline constexpr FigureColour figure_ink{0.11, 0.14, 0.19};
inline constexpr FigureColour figure_grey{0.55, 0.58, 0.62};

/// Colours after Okabe and Ito (2008), which colour-blind readers tell apart, by number; they repeat after
/// `figure_colours`. Their yellow is darker here: on white paper a line of it is not seen.
FigureColour figure_colour(std::size_t number);
inline constexpr std::size_t figure_colours = 8;

enum class TextAlign { left, centre, right };

/// Room that a line of text takes, in millimetres: its width, and how far its letters' line reaches above and
/// below the baseline.
struct TextExtent {
    double width = 0.0, above = 0.0, below = 0.0;
    double height() const { return above + below; }
};

/// Of one line of text with letters of so many points, as every pen draws it. Bytes that are no UTF-8 are
/// drawn as marks of their own, line breaks as spaces.
TextExtent extent_of(std::string_view text, double points);

/// The text in lines no wider than `width_mm`: broken between words, and within a word that is wider than a
/// line. Nothing of it is left out. One empty line for an empty text.
std::vector<std::string> broken_into_lines(std::string_view text, double points, double width_mm);

/// The height of lines of these that are set one below the other, in millimetres.
double height_of(const std::vector<std::string>& lines, double points);

class FigurePen {
  public:
    virtual ~FigurePen() = default;
    virtual void line(glm::dvec2 from, glm::dvec2 to, FigureColour colour = figure_ink,
                      double width_mm = 0.2) = 0;
    /// `dash_mm`: lengths of strokes and gaps in turn; empty: one stroke.
    virtual void path(const std::vector<glm::dvec2>& points, FigureColour colour, double width_mm,
                      const std::vector<double>& dash_mm = {}) = 0;
    /// Filled.
    virtual void polygon(const std::vector<glm::dvec2>& corners, FigureColour colour) = 0;
    virtual void box(glm::dvec2 corner, glm::dvec2 size, FigureColour colour) = 0;
    virtual void dot(glm::dvec2 centre, double radius_mm, FigureColour colour, double opacity = 1.0) = 0;
    /// One line of text about its baseline's place; `points` is the size of its letters. Turned by 90 degrees
    /// counter-clockwise if `upwards`.
    virtual void text(glm::dvec2 at, std::string_view text, double points = 7.0,
                      TextAlign align = TextAlign::left, FigureColour colour = figure_ink,
                      bool upwards = false) = 0;
};

/// Widths of a column and of a page of most journals.
inline constexpr double column_mm = 85.0, page_mm = 170.0;

/// Lines one below the other, the first one's top at `at`. Gives the height that they took.
double draw_lines(FigurePen& pen, glm::dvec2 at, const std::vector<std::string>& lines, double points,
                  TextAlign align = TextAlign::left, FigureColour colour = figure_ink);

struct StudyFigure {
    std::string name; ///< of its files, without an ending
    glm::dvec2 size_mm{0.0};
    std::function<void(FigurePen&)> draw;
};

/// Draws the same figure as `name`.svg and `name`.pdf. Lines and text are vectors in both: the PDF embeds the
/// fonts, the SVG has the letters as outlines, so that it looks the same wherever it is opened. Throws
/// RecordError.
void save_figure(const std::filesystem::path& folder, const StudyFigure& figure);

} // namespace overt
