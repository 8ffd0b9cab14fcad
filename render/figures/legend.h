/// Curves that are told apart by more than their colour, and the legend that says which is which.
#pragma once

#include <string>
#include <vector>

#include "render/figures/pen.h"

namespace overt {

/// How the curve with a number is drawn: colours repeat after eight, markers after seven, and dashes change
/// with each round of colours, so that 56 curves are unlike each other even to who sees no colours in the
/// first seven.
class CurveStyle {
  public:
    explicit CurveStyle(std::size_t number) : number_(number) {}
    FigureColour colour() const { return figure_colour(number_); }
    void draw_curve(FigurePen& pen, const std::vector<glm::dvec2>& points) const;
    void draw_marker(FigurePen& pen, glm::dvec2 centre) const;

  private:
    std::size_t number_;
};

/// Names beside pieces of their curves, in columns as wide as the longest name needs; a name that is wider
/// than the legend gets several lines.
class FigureLegend {
  public:
    FigureLegend(std::vector<std::string> names, double width_mm);
    double height_mm() const { return height_mm_; }
    /// From the top left corner.
    void draw(FigurePen& pen, glm::dvec2 corner) const;

  private:
    struct Item {
        std::vector<std::string> lines;
        glm::dvec2 place; ///< of its top left corner in the legend
    };
    std::vector<Item> items_;
    double height_mm_ = 0.0;
};

} // namespace overt
