/// The pixels that a frame's samples are gathered in.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/bake/spectral_bins.h"
#include "render/bake/spectral_frame.h"

namespace overt {

/// Light gathered in one pixel.
struct FilmPixel {
    Bins light{}; ///< sum over the samples that met the mesh
    std::uint32_t samples = 0;
    std::uint32_t met = 0;
    // Before the last round.
    glm::vec3 xyz_before{0.0f}; ///< sum of the CIE XYZ
    std::uint32_t samples_before = 0;
    float error_de =
        -1.0f; ///< of the mean, estimated from how the last round differs from those before; < 0: not yet
};

/// The pixels of a picture that are traced, and only those, tile by tile. A pixel of the film may stand for a
/// square of pixels of the picture.
class Film {
  public:
    /// `covered` is of the picture; a pixel of the film is traced if its square or one of the eight around
    /// holds a 1.
    Film(glm::ivec2 picture_px, int step, std::span<const std::uint8_t> covered);

    int step() const { return step_; }
    std::size_t count() const { return places_.size(); }
    glm::ivec2 place(std::size_t index) const { return places_[index]; } ///< column and row in the film
    FilmPixel& pixel(std::size_t index) { return pixels_[index]; }
    /// By column and row; nullptr if it is not traced or outside.
    const FilmPixel* at(glm::ivec2 place) const;

    /// Notes what some pixels have gathered so far.
    void begin_round(std::span<const std::uint32_t> active);

    /// Estimates each pixel's error from its last round, evened out over 5 x 5 pixels since one alone may be
    /// lucky, and gives those with so many samples around which, within 3 x 3, one has an error above the
    /// target.
    std::vector<std::uint32_t> noisier_than(double target_de, double exposure, std::uint32_t samples);

    /// The picture, its alpha after the law of SpectralFrame.
    SpectralFrame develop(std::span<const std::uint8_t> covered) const;

  private:
    std::vector<float> evened_errors(double exposure) const;

    glm::ivec2 picture_px_, size_;
    int step_;
    std::vector<std::uint32_t> index_; ///< of each pixel of the film, into pixels_
    std::vector<glm::ivec2> places_;
    std::vector<FilmPixel> pixels_;
};

} // namespace overt
