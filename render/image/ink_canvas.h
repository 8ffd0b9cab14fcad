/// A surface that letters, boxes and lines are drawn on, for screens between animations. Only coverage is
/// drawn, by Cairo; the two greys are put in afterwards, in linear light.
#pragma once

#include <memory>
#include <vector>

#include "render/image/linear_image.h"

using cairo_t = struct _cairo;                 // NOLINT(bugprone-reserved-identifier): cairo.h calls it so
using cairo_surface_t = struct _cairo_surface; // NOLINT(bugprone-reserved-identifier)

namespace overt {

/// A rectangle in pixels of a canvas.
struct InkBox {
    double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
};

class InkCanvas {
  public:
    explicit InkCanvas(glm::ivec2 size_px);

    cairo_t* cairo() { return cairo_.get(); }
    glm::ivec2 size_px() const { return size_px_; }

    /// `strength`: of the ink, 0 … 1, 1 being the colour of the letters. `radius`: of the corners.
    void fill(const InkBox& box, double strength, double radius = 0.0);
    void outline(const InkBox& box, double strength, double line_px, double radius = 0.0);

    void line(glm::dvec2 from, glm::dvec2 to, double strength, double line_px);
    void ring(glm::dvec2 middle, double radius, double strength, double line_px);

    /// A text was put there: who lays out a screen can be asked whether its texts meet.
    void note_text(const InkBox& box) { texts_.push_back(box); }
    const std::vector<InkBox>& texts() const { return texts_; }

    /// Whether what follows takes ink away, instead of putting it on.
    void takes_away(bool now);

    /// What has ink, as a picture of two linear greys; alpha is the coverage. The rest is left out: `origin`
    /// is where the picture lies on the canvas. Its place and width are even. Nothing, if there is no ink.
    LinearImage tinted_ink(float grey, float background, glm::ivec2& origin) const;
    /// The same of all of it.
    LinearImage tinted(float grey, float background) const;

  private:
    struct Release {
        void operator()(cairo_surface_t* surface) const;
        void operator()(cairo_t* cairo) const;
    };
    LinearImage tinted_part(float grey, float background, glm::ivec2 first, glm::ivec2 end) const;

    glm::ivec2 size_px_;
    std::unique_ptr<cairo_surface_t, Release> surface_;
    std::unique_ptr<cairo_t, Release> cairo_;
    std::vector<InkBox> texts_;
};

} // namespace overt
