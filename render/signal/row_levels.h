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

/// The light of a row of pixels, and the levels that make it.
class RowLevels {
  public:
    /// `light`: of the row's first pixel; with a pair filter, five more must lie before and behind the row.
    /// Both must outlive this.
    RowLevels(const LevelTables& tables, const glm::dvec3* light) : tables_(&tables), light_(light) {}

    /// The pixels of a picture, premultiplied by their alpha, over a grey background; of tables without a
    /// pair filter. This is what takes the time when stimuli are loaded. Both must outlive this.
    RowLevels(const LevelTables& tables, const glm::vec4* pixels, double background)
        : tables_(&tables), pixels_(pixels), background_(background) {}

    /// Calls put(begin, count, run) for runs of pixels that make up 0 … width - 1, with the levels of each.
    template <class Put> void for_colours(int width, const Put& put) const {
        for_each_run(width, put, 3, &RowLevels::take_colours);
    }
    /// The same of the one colour of each pair, 0 … pairs - 1.
    template <class Put> void for_pairs(int pairs, const Put& put) const {
        for_each_run(pairs, put, 3, &RowLevels::take_pairs);
    }
    /// The same of the luminance of pixels 0 … width - 1, in the first channel.
    template <class Put> void for_greys(int width, const Put& put) const {
        for_each_run(width, put, 1, &RowLevels::take_greys);
    }

  private:
    using Take = void (RowLevels::*)(int begin, int count, ColourRun& run) const;

    template <class Put> void for_each_run(int all, const Put& put, int channels, Take take) const {
        ColourRun run;
        for_runs(all, [&](int begin, int count) {
            (this->*take)(begin, count, run);
            run.find_levels(*tables_, count, channels);
            put(begin, count, run);
        });
    }
    void take_colours(int begin, int count, ColourRun& run) const;
    void take_pairs(int begin, int count, ColourRun& run) const;
    void take_greys(int begin, int count, ColourRun& run) const;
    glm::dvec3 light_of_pair(const glm::dvec3* left) const;

    const LevelTables* tables_;
    const glm::dvec3* light_ = nullptr;
    const glm::vec4* pixels_ = nullptr; ///< instead of it
    double background_ = 0.0;
};

} // namespace overt
