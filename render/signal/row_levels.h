/// The levels of a row of light, as the output modes pack them.
#pragma once

#include <array>
#include <span>
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

/// So many pixels or pairs are turned into levels at a time.
constexpr int level_run = 256;

/// Light of a run, channel by channel, and its levels.
struct ColourRun {
    std::array<std::array<double, level_run>, 3> light;
    std::array<std::array<int, level_run>, 3> levels;

    void put(int i, const glm::dvec3& colour) {
        const auto place = static_cast<std::size_t>(i);
        light[0][place] = colour.r;
        light[1][place] = colour.g;
        light[2][place] = colour.b;
    }
    void find_levels(const LevelTables& tables, int count, int channels = 3) {
        for (int channel = 0; channel < channels; ++channel) {
            const auto number = static_cast<std::size_t>(channel);
            tables.at(channel).levels_of({light[number].data(), static_cast<std::size_t>(count)},
                                         levels[number].data());
        }
    }
};

/// Calls work(begin, count) for runs that make up 0 … `all` - 1.
template <class Work> void for_runs(int all, const Work& work) {
    for (int begin = 0; begin < all; begin += level_run)
        work(begin, all - begin < level_run ? all - begin : level_run);
}

class RowLevels {
  public:
    /// `light`: of the row's first pixel; with a pair filter, five more must lie before and behind the row.
    /// Both must outlive this.
    RowLevels(const LevelTables& tables, const glm::dvec3* light) : tables_(&tables), light_(light) {}

    /// Calls put(begin, count, run) for runs of pixels that make up 0 … width - 1, with the levels of each.
    template <class Put> void for_colours(int width, const Put& put) const {
        ColourRun run;
        for_runs(width, [&](int begin, int count) {
            for (int i = 0; i < count; ++i)
                run.put(i, light_[begin + i]);
            run.find_levels(*tables_, count);
            put(begin, count, run);
        });
    }

    /// The same of the one colour of each pair, 0 … pairs - 1.
    template <class Put> void for_pairs(int pairs, const Put& put) const {
        ColourRun run;
        for_runs(pairs, [&](int begin, int count) {
            for (int i = 0; i < count; ++i)
                run.put(i, light_of_pair(light_ + 2 * (begin + i)));
            run.find_levels(*tables_, count);
            put(begin, count, run);
        });
    }

    /// The same of the luminance of pixels 0 … width - 1, in the first channel.
    template <class Put> void for_greys(int width, const Put& put) const {
        ColourRun run;
        const glm::dvec3& luminance = tables_->luminance;
        for_runs(width, [&](int begin, int count) {
            for (int i = 0; i < count; ++i) {
                const glm::dvec3& light = light_[begin + i];
                run.light[0][static_cast<std::size_t>(i)] =
                    luminance.r * light.r + luminance.g * light.g + luminance.b * light.b;
            }
            run.find_levels(*tables_, count, 1);
            put(begin, count, run);
        });
    }

  private:
    glm::dvec3 light_of_pair(const glm::dvec3* left) const {
        if (!tables_->pair_filter)
            return 0.5 * (left[0] + left[1]);
        glm::dvec3 sum(0.0);
        for (int i = 0; i < 12; ++i)
            sum += (*tables_->pair_filter)[static_cast<std::size_t>(i)] * left[i - 5];
        return sum;
    }

    const LevelTables* tables_;
    const glm::dvec3* light_;
};

} // namespace overt
