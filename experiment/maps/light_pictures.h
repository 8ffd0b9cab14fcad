/// How bright a stimulus is in each of its pictures: small pictures of its luminance, kept with a session so
/// that an analysis can ask what gaze met.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

namespace overt {

/// The luminance of a stimulus in squares of its image, for each picture of its motion (Animation::pictures).
struct LightPictures {
    glm::ivec2 image_px{0}; ///< of the stimulus image
    int square_px = 1;      ///< side of a square; those at the right and lower edge may be smaller
    int pictures = 0;
    /// By picture, then by row from the top: the mean luminance of what the object covers of the square, 1
    /// the display's white.
    std::vector<float> luminance{};
    std::vector<float> coverage{}; ///< likewise: share of the square that the object covers, 0 … 1

    glm::ivec2 size() const { return (image_px + (square_px - 1)) / square_px; }
    std::size_t squares() const {
        return static_cast<std::size_t>(size().x) * static_cast<std::size_t>(size().y);
    }
};

/// A side of squares that leaves 128 of them at most along the longer side of an image.
int light_square_px(glm::ivec2 image_px);

/// Writes an EXR of half floats: the channels Y (luminance) and A (coverage), pictures one below the other.
/// At once or not at all. Throws RecordError.
void write_light_pictures(const std::filesystem::path& file, const LightPictures& light);

/// Reads what write_light_pictures wrote. Throws InputError that names the file, also if it is of another
/// number of pictures or of another image than said.
LightPictures read_light_pictures(const std::filesystem::path& file, glm::ivec2 image_px, int pictures);

/// How bright places of a stimulus are against the rest of the object in the same picture: CIE 1976 lightness
/// (ISO/CIE 11664-4) in standard deviations from its mean over the object, each square weighted by its
/// coverage. Light beyond the display's white is taken for white, as it was shown.
class LightScores {
  public:
    explicit LightScores(const LightPictures& light);

    /// Nothing outside of the image, in squares of which the object covers less than half, and in pictures
    /// whose object has one lightness throughout.
    std::optional<double> at(int picture, glm::dvec2 image_point_px) const;

  private:
    glm::ivec2 image_px_, size_;
    int square_px_;
    std::vector<float> scores_; ///< not a number where there is none
};

} // namespace overt
