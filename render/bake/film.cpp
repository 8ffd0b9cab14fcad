#include "render/bake/film.h"

#include <algorithm>
#include <cmath>

#include "experiment/base/parallel.h"
#include "render/bake/light_colour.h"

namespace overt {

namespace {

constexpr std::uint32_t untraced = ~0u;

std::size_t at_place(glm::ivec2 place, glm::ivec2 size) {
    return static_cast<std::size_t>(place.y) * static_cast<std::size_t>(size.x) +
           static_cast<std::size_t>(place.x);
}

bool is_inside(glm::ivec2 place, glm::ivec2 size) {
    return place.x >= 0 && place.y >= 0 && place.x < size.x && place.y < size.y;
}

/// Which pixels of the film hold a covered pixel of the picture.
std::vector<std::uint8_t> reduced(std::span<const std::uint8_t> covered, glm::ivec2 picture_px, int step,
                                  glm::ivec2 size) {
    std::vector<std::uint8_t> any(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), 0);
    for (int y = 0; y < picture_px.y; ++y) {
        for (int x = 0; x < picture_px.x; ++x)
            any[at_place({x / step, y / step}, size)] |= covered[at_place({x, y}, picture_px)];
    }
    return any;
}

bool is_near_one(const std::vector<std::uint8_t>& any, glm::ivec2 place, glm::ivec2 size) {
    for (int y = std::max(place.y - 1, 0); y <= std::min(place.y + 1, size.y - 1); ++y) {
        for (int x = std::max(place.x - 1, 0); x <= std::min(place.x + 1, size.x - 1); ++x) {
            if (any[at_place({x, y}, size)] != 0)
                return true;
        }
    }
    return false;
}

glm::dvec3 xyz_of(const Bins& light) {
    return xyz_of_light(std::span<const float, spectral_bins>(light.value.data(), spectral_bins));
}

/// Alpha on the side of 1/2 that the map of triangles asks for. Just below is 1/2 - 2^-12, which even a half
/// float can hold.
float lawful(float alpha, bool is_covered) {
    return is_covered ? std::max(alpha, 0.5f) : std::min(alpha, 0.5f - 0x1p-12f);
}

} // namespace

Film::Film(glm::ivec2 picture_px, int step, std::span<const std::uint8_t> covered)
    : picture_px_(picture_px), size_((picture_px + (step - 1)) / step), step_(step) {
    const std::vector<std::uint8_t> any = reduced(covered, picture_px, step, size_);
    index_.assign(any.size(), untraced);
    constexpr int tile = 16;
    for (int top = 0; top < size_.y; top += tile) {
        for (int left = 0; left < size_.x; left += tile) {
            for (int y = top; y < std::min(top + tile, size_.y); ++y) {
                for (int x = left; x < std::min(left + tile, size_.x); ++x) {
                    if (!is_near_one(any, {x, y}, size_))
                        continue;
                    index_[at_place({x, y}, size_)] = static_cast<std::uint32_t>(places_.size());
                    places_.emplace_back(x, y);
                }
            }
        }
    }
    pixels_.resize(places_.size());
}

const FilmPixel* Film::at(glm::ivec2 place) const {
    if (!is_inside(place, size_))
        return nullptr;
    const std::uint32_t index = index_[at_place(place, size_)];
    return index == untraced ? nullptr : &pixels_[index];
}

void Film::begin_round(std::span<const std::uint32_t> active) {
    for (const std::uint32_t index : active) {
        FilmPixel& pixel = pixels_[index];
        pixel.xyz_before = glm::vec3(xyz_of(pixel.light));
        pixel.samples_before = pixel.samples;
    }
}

std::vector<float> Film::evened_errors(double exposure) const {
    std::vector<float> squared(count(), 0.0f);
    for (std::size_t i = 0; i < count(); ++i) {
        const FilmPixel& pixel = pixels_[i];
        if (pixel.samples == pixel.samples_before || pixel.samples_before == 0)
            continue;
        // Two means of independent samples: their difference, times the root of the product of their shares,
        // is the error of the mean of all.
        const double all = pixel.samples, share = pixel.samples_before / all;
        const glm::dvec3 before(pixel.xyz_before), both = xyz_of(pixel.light);
        const glm::dvec3 lab_before = lab_of_xyz(exposure / (share * all) * before);
        const glm::dvec3 lab_after = lab_of_xyz(exposure / ((1.0 - share) * all) * (both - before));
        const double error = glm::distance(lab_before, lab_after) * std::sqrt(share * (1.0 - share));
        squared[i] = static_cast<float>(error * error);
    }
    std::vector<float> errors(count());
    for (std::size_t i = 0; i < count(); ++i) {
        float sum = 0.0f;
        int neighbours = 0;
        for (int y = -2; y <= 2; ++y) {
            for (int x = -2; x <= 2; ++x) {
                if (const FilmPixel* other = at(places_[i] + glm::ivec2(x, y))) {
                    sum += squared[static_cast<std::size_t>(other - pixels_.data())];
                    ++neighbours;
                }
            }
        }
        errors[i] = std::sqrt(sum / static_cast<float>(neighbours));
    }
    return errors;
}

std::vector<std::uint32_t> Film::noisier_than(double target_de, double exposure, std::uint32_t samples) {
    const std::vector<float> errors = evened_errors(exposure);
    std::vector<std::uint32_t> noisy;
    for (std::size_t i = 0; i < count(); ++i) {
        pixels_[i].error_de = errors[i];
        bool is_noisy = false;
        for (int y = -1; y <= 1; ++y) {
            for (int x = -1; x <= 1; ++x) {
                const FilmPixel* other = at(places_[i] + glm::ivec2(x, y));
                is_noisy |=
                    other != nullptr &&
                    static_cast<double>(errors[static_cast<std::size_t>(other - pixels_.data())]) > target_de;
            }
        }
        // Who has stopped stays so: its next samples would not follow on its last.
        if (is_noisy && pixels_[i].samples == samples)
            noisy.push_back(static_cast<std::uint32_t>(i));
    }
    return noisy;
}

SpectralFrame Film::develop(std::span<const std::uint8_t> covered) const {
    SpectralFrame frame;
    frame.size_px = picture_px_;
    const std::size_t pixels = covered.size();
    frame.radiance.assign(pixels * spectral_bins, 0.0f);
    frame.alpha.assign(pixels, 0.0f);
    frame.samples.assign(pixels, 0);
    const bool has_errors = !pixels_.empty() && pixels_.front().error_de >= 0.0f;
    if (has_errors)
        frame.error_de.assign(pixels, 0.0f);
    std::vector<std::size_t> moved(static_cast<std::size_t>(picture_px_.y), 0);
    parallel_for(picture_px_.y, [&](int row) {
        for (int column = 0; column < picture_px_.x; ++column) {
            const std::size_t pixel = at_place({column, row}, picture_px_);
            // Between the middles of the film's pixels; with a step of 1 that is one of them.
            const glm::vec2 place = (glm::vec2(column, row) + 0.5f) / static_cast<float>(step_) - 0.5f;
            const glm::vec2 corner = glm::floor(place), share = place - corner;
            Bins light{};
            float weight = 0.0f, alpha = 0.0f;
            const FilmPixel* own = at(glm::ivec2(column, row) / step_);
            for (int neighbour = 0; neighbour < 4; ++neighbour) {
                const int right = neighbour & 1, down = neighbour >> 1;
                const float near =
                    (right != 0 ? share.x : 1.0f - share.x) * (down != 0 ? share.y : 1.0f - share.y);
                const FilmPixel* from = at(glm::ivec2(corner) + glm::ivec2(right, down));
                if (near == 0.0f || from == nullptr || from->met == 0)
                    continue;
                const float covers = static_cast<float>(from->met) / static_cast<float>(from->samples);
                Bins part = from->light;
                scale(part, near * covers / static_cast<float>(from->met));
                add(light, part);
                weight += near * covers;
                alpha += near * covers;
            }
            if (own == nullptr)
                continue; // neither covered nor beside a covered pixel
            frame.samples[pixel] = static_cast<std::uint16_t>(std::min(own->samples, 65535u));
            if (has_errors)
                frame.error_de[pixel] = own->error_de;
            const bool is_covered = covered[pixel] != 0;
            if (is_covered && weight == 0.0f) {
                // A sliver between the samples: the light of its neighbours.
                for (int y = -1; y <= 1; ++y) {
                    for (int x = -1; x <= 1; ++x) {
                        const FilmPixel* from = at(glm::ivec2(column, row) / step_ + glm::ivec2(x, y));
                        if (from == nullptr || from->met == 0)
                            continue;
                        Bins part = from->light;
                        scale(part, 1.0f / static_cast<float>(from->met));
                        add(light, part);
                        weight += 1.0f;
                    }
                }
            }
            frame.alpha[pixel] = lawful(alpha, is_covered);
            if (frame.alpha[pixel] != alpha)
                ++moved[static_cast<std::size_t>(row)];
            for (std::size_t bin = 0; bin < spectral_bins && weight > 0.0f; ++bin)
                frame.radiance[pixel * spectral_bins + bin] = light.value[bin] / weight;
        }
    });
    for (const std::size_t in_row : moved)
        frame.alphas_moved += in_row;
    return frame;
}

} // namespace overt
