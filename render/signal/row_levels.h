/// The levels of a row of light, as the output modes pack them.
#pragma once

#include <array>
#include <vector>

#include <glm/glm.hpp>

#include "render/signal/level_table.h"

namespace overt {

/// From a display's curves, one for each channel or one for all.
struct LevelTables {
    std::vector<LevelTable> of_channel;
    glm::dvec3 luminance{0.0}; ///< share of each channel in the light of a grey mode
    const std::array<double, 12>* pair_filter =
        nullptr; ///< weights of a pair's neighbourhood; null: the mean of the two

    const LevelTable& at(int channel) const {
        return of_channel[of_channel.size() == 1 ? 0 : static_cast<std::size_t>(channel)];
    }
};

class RowLevels {
  public:
    /// `light`: of the row's first pixel; with a pair filter, five more must lie before and behind the row.
    /// Both must outlive this.
    RowLevels(const LevelTables& tables, const glm::dvec3* light) : tables_(&tables), light_(light) {}

    /// Of red, green and blue at a pixel.
    glm::ivec3 colour(int x) const { return levels_of(light_[x]); }

    /// Of the one colour of the pair that begins at x.
    glm::ivec3 pair(int x) const {
        const glm::dvec3* left = light_ + x;
        if (!tables_->pair_filter)
            return levels_of(0.5 * (left[0] + left[1]));
        glm::dvec3 sum(0.0);
        for (int i = 0; i < 12; ++i)
            sum += (*tables_->pair_filter)[static_cast<std::size_t>(i)] * left[i - 5];
        return levels_of(sum);
    }

    /// Of a pixel's luminance.
    int grey(int x) const {
        const glm::dvec3 &light = light_[x], &luminance = tables_->luminance;
        return tables_->at(0).level_of(luminance.r * light.r + luminance.g * light.g + luminance.b * light.b);
    }

  private:
    glm::ivec3 levels_of(const glm::dvec3& light) const {
        return {tables_->at(0).level_of(light.r), tables_->at(1).level_of(light.g),
                tables_->at(2).level_of(light.b)};
    }

    const LevelTables* tables_;
    const glm::dvec3* light_;
};

} // namespace overt
