#include "render/bake/light_aim.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace overt {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

double luminance(const glm::vec4& light) {
    return 0.2126 * static_cast<double>(light.r) + 0.7152 * static_cast<double>(light.g) +
           0.0722 * static_cast<double>(light.b);
}

/// Mean luminance that a texel shows when light is bilinear between the texels' middles.
double shown_luminance(const LinearImage& radiance, int column, int row) {
    const glm::ivec2 size = radiance.size_px;
    double sum = 0.0;
    for (int down = -1; down <= 1; ++down) {
        for (int right = -1; right <= 1; ++right) {
            const double weight = (down == 0 ? 0.75 : 0.125) * (right == 0 ? 0.75 : 0.125);
            sum += weight * luminance(radiance.at((column + right + size.x) % size.x,
                                                  std::clamp(row + down, 0, size.y - 1)));
        }
    }
    return sum;
}

/// Number of the interval of rising ends that holds `share`, and how far into it that is; one of no width is
/// never chosen.
struct Choice {
    int number;
    float within;
};

Choice chosen(const float* ends, int count, float share) {
    const float* const found = std::upper_bound(ends, ends + count - 1, share);
    const float begin = found == ends ? 0.0f : *(found - 1), width = *found - begin;
    const float within = width > 0.0f ? (share - begin) / width : 0.5f;
    return {static_cast<int>(found - ends), std::clamp(within, 0.0f, 1.0f - 0x1p-24f)};
}

/// Sums of weights, as shares of their whole.
void write_ends(const std::vector<double>& weights, float* ends) {
    double all = 0.0, sum = 0.0;
    for (const double weight : weights)
        all += weight;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        sum += weights[i];
        ends[i] = all > 0.0 ? static_cast<float>(sum / all)
                            : static_cast<float>(i + 1) / static_cast<float>(weights.size());
    }
    ends[weights.size() - 1] = 1.0f;
}

} // namespace

LightAim::LightAim(const LightProbe& probe) {
    const glm::ivec2 size = probe.radiance.size_px;
    const int block = (size.x + 1023) / 1024;
    columns_ = (size.x + block - 1) / block;
    rows_ = (size.y + block - 1) / block;
    std::vector<double> light(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0);
    for (int row = 0; row < size.y; ++row) {
        for (int column = 0; column < size.x; ++column)
            light[cell(column / block, row / block)] += shown_luminance(probe.radiance, column, row);
    }
    // A last block may stand out beyond the picture; its edge is where the picture's is.
    const auto edge_of = [&](int number, int all) {
        return std::min(1.0, static_cast<double>(number) * block / all);
    };
    column_width_ = static_cast<float>(static_cast<double>(block) / size.x);
    row_width_ = static_cast<float>(static_cast<double>(block) / size.y);
    for (int row = 0; row <= rows_; ++row)
        height_.push_back(static_cast<float>(std::cos(std::numbers::pi * edge_of(row, size.y))));
    height_.back() = -1.0f;

    row_end_.resize(static_cast<std::size_t>(rows_));
    column_end_.resize(light.size());
    density_.resize(light.size());
    std::vector<double> of_rows, of_columns(static_cast<std::size_t>(columns_));
    double squares = 0.0, whole = 0.0;
    for (int row = 0; row < rows_; ++row) {
        const auto number = static_cast<std::size_t>(row);
        const int texels_down = std::min(block, size.y - row * block);
        const double band =
            full_turn * (static_cast<double>(height_[number]) - static_cast<double>(height_[number + 1]));
        for (int column = 0; column < columns_; ++column) {
            const int texels = texels_down * std::min(block, size.x - column * block);
            const double angle = band * (edge_of(column + 1, size.x) - edge_of(column, size.x));
            const double mean = light[cell(column, row)] / texels;
            of_columns[static_cast<std::size_t>(column)] = mean * angle;
            whole += mean * angle;
            squares += mean * mean * angle;
        }
        double sum = 0.0;
        for (const double weight : of_columns)
            sum += weight;
        of_rows.push_back(sum);
        write_ends(of_columns, &column_end_[cell(0, row)]);
    }
    write_ends(of_rows, row_end_.data());
    // The densities are those of the shares as they were rounded: what is drawn is what is told.
    for (int row = 0; row < rows_; ++row) {
        const auto number = static_cast<std::size_t>(row);
        const double of_row = static_cast<double>(row_end_[number]) -
                              (row == 0 ? 0.0 : static_cast<double>(row_end_[number - 1]));
        const double band =
            full_turn * (static_cast<double>(height_[number]) - static_cast<double>(height_[number + 1]));
        for (int column = 0; column < columns_; ++column) {
            const std::size_t place = cell(column, row);
            const double of_column = static_cast<double>(column_end_[place]) -
                                     (column == 0 ? 0.0 : static_cast<double>(column_end_[place - 1]));
            const double angle = band * (edge_of(column + 1, size.x) - edge_of(column, size.x));
            density_[place] = static_cast<float>(of_row * of_column / angle);
        }
    }
    const double mean = whole / (2.0 * full_turn);
    unevenness_ = mean > 0.0 ? squares / (2.0 * full_turn) / (mean * mean) : 1.0;
}

glm::vec3 LightAim::direction(glm::vec2 place, float turn) const {
    const Choice row = chosen(row_end_.data(), rows_, place.y);
    const Choice column = chosen(&column_end_[cell(0, row.number)], columns_, place.x);
    const auto number = static_cast<std::size_t>(row.number);
    const float z = height_[number] + row.within * (height_[number + 1] - height_[number]);
    const float left = static_cast<float>(column.number) * column_width_;
    const float around = left + column.within * (std::min(1.0f, left + column_width_) - left);
    const float azimuth = static_cast<float>(full_turn) * (around - turn);
    const float sine = std::sqrt(std::max(0.0f, 1.0f - z * z));
    return {sine * std::sin(azimuth), sine * std::cos(azimuth), z};
}

float LightAim::density(glm::vec3 direction, float turn) const {
    float around = std::atan2(direction.x, direction.y) / static_cast<float>(full_turn) + turn;
    around -= std::floor(around);
    const float down = std::acos(glm::clamp(direction.z, -1.0f, 1.0f)) / std::numbers::pi_v<float>;
    const int column = std::min(static_cast<int>(around / column_width_), columns_ - 1);
    const int row = std::min(static_cast<int>(down / row_width_), rows_ - 1);
    return density_[cell(column, row)];
}

} // namespace overt
