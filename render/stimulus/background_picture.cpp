#include "render/stimulus/background_picture.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "experiment/base/content_hash.h"
#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "render/signal/display_light.h"

namespace overt {

namespace {

/// EXR and HDR hold light; what other pictures hold is encoded.
FrameEncoding encoding_of_picture(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending == ".exr" || ending == ".hdr" ? FrameEncoding::linear : FrameEncoding::srgb;
}

/// What a row or column of the image takes of the picture: pixels with their shares, which sum to 1.
struct Footprint {
    int first = 0;
    std::vector<float> shares;
};

/// `scale`: pixels of the picture for each of the image.
std::vector<Footprint> footprints(int image_px, int picture_px, double scale) {
    std::vector<Footprint> all;
    // A triangle as wide as what is covered, or as two pixels of the picture where that is more.
    const double reach = std::max(0.5 * (1.0 + scale), 1.0);
    for (int i = 0; i < image_px; ++i) {
        const double middle = 0.5 * picture_px + (i + 0.5 - 0.5 * image_px) * scale - 0.5;
        Footprint taken;
        taken.first = static_cast<int>(std::ceil(middle - reach));
        double sum = 0.0;
        for (int pixel = taken.first; pixel <= static_cast<int>(std::floor(middle + reach)); ++pixel) {
            // How much of the pixel lies in the footprint; between large pixels, how near it is.
            const double distance = std::abs(pixel - middle);
            const double share = scale > 1.0 ? std::clamp(0.5 * (scale + 1.0) - distance, 0.0, 1.0)
                                             : std::max(0.0, 1.0 - distance);
            taken.shares.push_back(static_cast<float>(share));
            sum += share;
        }
        for (float& share : taken.shares)
            share = static_cast<float>(share / sum);
        all.push_back(std::move(taken));
    }
    return all;
}

LinearImage covering(const LinearImage& picture, glm::ivec2 image_px) {
    const double scale = std::min(static_cast<double>(picture.size_px.x) / image_px.x,
                                  static_cast<double>(picture.size_px.y) / image_px.y);
    const std::vector<Footprint> columns = footprints(image_px.x, picture.size_px.x, scale),
                                 rows = footprints(image_px.y, picture.size_px.y, scale);
    LinearImage image(image_px);
    parallel_for(image_px.y, [&](int y) {
        const Footprint& row = rows[static_cast<std::size_t>(y)];
        for (int x = 0; x < image_px.x; ++x) {
            const Footprint& column = columns[static_cast<std::size_t>(x)];
            glm::vec4 sum(0.0f);
            for (std::size_t j = 0; j < row.shares.size(); ++j) {
                const int from_y = std::clamp(row.first + static_cast<int>(j), 0, picture.size_px.y - 1);
                for (std::size_t i = 0; i < column.shares.size(); ++i) {
                    const int from_x =
                        std::clamp(column.first + static_cast<int>(i), 0, picture.size_px.x - 1);
                    sum += row.shares[j] * column.shares[i] * picture.at(from_x, from_y);
                }
            }
            image.at(x, y) = sum;
        }
    });
    return image;
}

} // namespace

LinearImage draw_background(const BackgroundSettings& background, glm::ivec2 image_px,
                            const DisplaySettings& display) {
    const glm::vec3 grey(static_cast<float>(background.grey.value_or(display.background)));
    const glm::vec3 even = background.colour ? glm::vec3(*background.colour) : grey;
    LinearImage image(image_px);
    if (!background.picture.empty()) {
        LinearImage picture = read_linear_image(background.picture, encoding_of_picture(background.picture),
                                                FileColours::as_rec709);
        transform(picture, display_from(PictureColours::rec709, display));
        image = covering(picture, image_px);
        // Where the picture has holes, the display's own grey shows.
        LinearImage behind(image_px);
        std::ranges::fill(behind.pixels, glm::vec4(grey, 1.0f));
        put_before(image, behind);
        return image;
    }
    std::ranges::fill(image.pixels, glm::vec4(even, 1.0f));
    return image;
}

void put_before(LinearImage& picture, const LinearImage& background) {
    OVERT_EXPECTS(picture.size_px == background.size_px);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        glm::vec4& pixel = picture.pixels[i];
        pixel = glm::vec4(glm::vec3(pixel) + (1.0f - pixel.w) * glm::vec3(background.pixels[i]), 1.0f);
    }
}

ContentHash hash_of_background(const BackgroundSettings& background) {
    ContentHasher hasher;
    const glm::dvec3 colour = background.colour.value_or(glm::dvec3(0.0));
    hasher.add(background.grey.value_or(-1.0)).add(background.colour.has_value());
    hasher.add(colour.x).add(colour.y).add(colour.z);
    hasher.add(std::string_view(background.picture.empty() ? "" : hash_of_file(background.picture)));
    return hasher.finish();
}

} // namespace overt
