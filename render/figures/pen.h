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

/// The colours of Okabe and Ito (2008), which colour-blind readers tell apart, by number; they repeat.
FigureColour figure_colour(std::size_t number);

enum class TextAlign { left, centre, right };

class FigurePen {
  public:
    virtual ~FigurePen() = default;
    virtual void line(glm::dvec2 from, glm::dvec2 to, FigureColour colour = figure_ink,
                      double width_mm = 0.2) = 0;
    virtual void path(const std::vector<glm::dvec2>& points, FigureColour colour, double width_mm) = 0;
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

/// Draws the same figure as `name`.svg and `name`.pdf. Lines and text are vectors in both: the PDF embeds the
/// fonts, the SVG has the letters as outlines, so that it looks the same wherever it is opened. Throws
/// RecordError.
void save_figure(const std::filesystem::path& folder, const std::string& name, glm::dvec2 size_mm,
                 const std::function<void(FigurePen&)>& draw);

} // namespace overt
