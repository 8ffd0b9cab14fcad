#include "experiment/maps/light_pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/pictures/picture_file.h"

namespace overt {

namespace {

constexpr const char* width_name = "overt:image_width_px";
constexpr const char* height_name = "overt:image_height_px";
constexpr const char* square_name = "overt:square_px";
constexpr const char* pictures_name = "overt:poses"; // as the first programs called them

/// CIE 1976 L* of a luminance relative to white (ISO/CIE 11664-4). The display shows nothing brighter than
/// its white.
double lightness(double luminance) {
    constexpr double delta = 6.0 / 29.0;
    const double y = std::clamp(luminance, 0.0, 1.0);
    return 116.0 * (y > delta * delta * delta ? std::cbrt(y) : y / (3.0 * delta * delta) + 4.0 / 29.0) - 16.0;
}

} // namespace

int light_square_px(glm::ivec2 image_px) {
    constexpr int most_squares = 128;
    return std::max(1, (std::max(image_px.x, image_px.y) + most_squares - 1) / most_squares);
}

void write_light_pictures(const std::filesystem::path& file, const LightPictures& light) {
    OVERT_EXPECTS(light.luminance.size() == light.squares() * static_cast<std::size_t>(light.pictures));
    OVERT_EXPECTS(light.coverage.size() == light.luminance.size());
    const PictureHeader header{{light.size().x, light.size().y * light.pictures},
                               {"Y", "A"},
                               PixelType::float16,
                               1,
                               {{"compression", "zip"},
                                {width_name, light.image_px.x},
                                {height_name, light.image_px.y},
                                {square_name, light.square_px},
                                {pictures_name, light.pictures}}};
    std::vector<float> values;
    values.reserve(2 * light.luminance.size());
    constexpr float largest_half = 65504.0f;
    for (std::size_t i = 0; i < light.luminance.size(); ++i)
        values.insert(values.end(), {std::min(light.luminance[i], largest_half), light.coverage[i]});
    write_picture(file, header, PixelType::float32, values.data());
}

LightPictures read_light_pictures(const std::filesystem::path& file, glm::ivec2 image_px, int pictures) {
    PictureFile picture(file, "picture of light");
    const PictureHeader& header = picture.header();
    const auto number = [&](const char* name) {
        const int* const found = header.attribute<int>(name);
        return found ? *found : 0;
    };
    LightPictures light{image_px, number(square_name), pictures, {}, {}};
    if (light.square_px < 1 || glm::ivec2(number(width_name), number(height_name)) != image_px ||
        number(pictures_name) != pictures || header.channels.size() != 2 ||
        header.size_px != glm::ivec2(light.size().x, light.size().y * pictures))
        throw InputError(fmt::format("{}: is not the light of {} pictures of {} x {} pixels", file.string(),
                                     pictures, image_px.x, image_px.y));
    const auto y = static_cast<std::size_t>(std::max(header.channel("Y"), 0)), alpha = 1 - y;
    std::vector<float> values(2 * light.squares() * static_cast<std::size_t>(pictures));
    picture.read(2, PixelType::float32, values.data());
    for (std::size_t i = 0; i < values.size(); i += 2) {
        light.luminance.push_back(values[i + y]);
        light.coverage.push_back(values[i + alpha]);
    }
    return light;
}

LightScores::LightScores(const LightPictures& light)
    : image_px_(light.image_px), size_(light.size()), square_px_(light.square_px),
      scores_(light.luminance.size(), std::numeric_limits<float>::quiet_NaN()) {
    const std::size_t squares = light.squares();
    for (std::size_t begin = 0; begin < scores_.size(); begin += squares) {
        double weights = 0.0, sum = 0.0, sum_of_squares = 0.0;
        for (std::size_t i = begin; i < begin + squares; ++i) {
            const auto weight = static_cast<double>(light.coverage[i]);
            const double value = lightness(static_cast<double>(light.luminance[i]));
            weights += weight;
            sum += weight * value;
            sum_of_squares += weight * value * value;
        }
        const double mean = weights > 0.0 ? sum / weights : 0.0;
        const double variance = weights > 0.0 ? sum_of_squares / weights - mean * mean : 0.0;
        // Differences of rounding are none of light.
        constexpr double least_sd = 1e-3;
        if (!(variance > least_sd * least_sd))
            continue;
        for (std::size_t i = begin; i < begin + squares; ++i) {
            if (light.coverage[i] >= 0.5f)
                scores_[i] = static_cast<float>((lightness(static_cast<double>(light.luminance[i])) - mean) /
                                                std::sqrt(variance));
        }
    }
}

std::optional<double> LightScores::at(int picture, glm::dvec2 image_point_px) const {
    if (!(image_point_px.x >= 0.0 && image_point_px.y >= 0.0 && image_point_px.x < image_px_.x &&
          image_point_px.y < image_px_.y))
        return std::nullopt;
    const glm::ivec2 square = glm::ivec2(image_point_px) / square_px_;
    const auto width = static_cast<std::size_t>(size_.x), height = static_cast<std::size_t>(size_.y);
    const std::size_t index = static_cast<std::size_t>(picture) * width * height +
                              static_cast<std::size_t>(square.y) * width + static_cast<std::size_t>(square.x);
    if (index >= scores_.size() || std::isnan(scores_[index]))
        return std::nullopt;
    return static_cast<double>(scores_[index]);
}

} // namespace overt
