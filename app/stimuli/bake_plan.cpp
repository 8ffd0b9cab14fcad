#include "app/stimuli/bake_plan.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

FrameRange frame_range_called(const std::string& text, const Protocol& protocol,
                              std::span<const Stimulus> stimuli) {
    int last = 0;
    for (const Stimulus& stimulus : stimuli)
        last = std::max(last, protocol.motion_of(stimulus).frame_count - 1);
    if (text == "all")
        return {0, last};
    const std::size_t dash = text.find('-');
    const auto from = digits_in(std::string_view(text).substr(0, dash));
    const auto to = dash == std::string::npos ? from : digits_in(std::string_view(text).substr(dash + 1));
    if (!from || !to || *from > *to)
        throw InputError(fmt::format("--frames {}: write a number, a range such as 0-30, or all", text));
    if (*to > last)
        throw InputError(fmt::format("--frames {}: the animation has frames 0 to {}", text, last));
    return {*from, *to};
}

std::vector<BakeUnit> bake_units(const std::vector<Stimulus>& stimuli, const FrameRange& frames,
                                 const StimulusCache& cache, const FrameQuality& quality,
                                 bool is_each_its_own) {
    std::set<std::filesystem::path> files;
    std::vector<BakeUnit> units;
    std::vector<std::pair<Stimulus, bool>> in_order; // and whether it is a part
    for (const Stimulus& stimulus : stimuli) {
        for (const Stimulus& part : cache.parts_of(stimulus))
            if (std::ranges::find(stimuli, part) == stimuli.end())
                in_order.emplace_back(part, true);
    }
    const auto is_sum = [&](const Stimulus& stimulus) {
        return !cache.protocol().light_of(stimulus).sum.empty();
    };
    for (const bool are_sums : {false, true})
        for (const Stimulus& stimulus : stimuli)
            if (is_sum(stimulus) == are_sums)
                in_order.emplace_back(stimulus, false);
    for (const auto& [stimulus, is_part] : in_order) {
        const double cost = is_sum(stimulus)
                                ? 0.0
                                : expected_cost(quality, cache.protocol(), cache.material_of(stimulus).kind);
        const std::span<const Pose> pictures = cache.pictures_of(stimulus);
        const std::span<const int> picture_of = cache.picture_of_frame(stimulus);
        std::vector<bool> is_shown(pictures.size());
        for (int frame = frames.first;
             frame <= std::min(frames.last, static_cast<int>(picture_of.size()) - 1); ++frame)
            is_shown[static_cast<std::size_t>(picture_of[static_cast<std::size_t>(frame)])] = true;
        for (std::size_t picture = 0; picture < pictures.size(); ++picture) {
            if (is_shown[picture] &&
                (files.insert(cache.frame_file_of(stimulus, quality, pictures[picture])).second ||
                 (is_each_its_own && !is_part)))
                units.push_back({stimulus, pictures[picture], cost, is_part});
        }
    }
    return units;
}

std::vector<BakeUnit> dealt_to(const Shard& shard, const std::vector<BakeUnit>& units) {
    std::vector<std::size_t> dearest_first(units.size());
    std::iota(dearest_first.begin(), dearest_first.end(), std::size_t{0});
    std::stable_sort(dearest_first.begin(), dearest_first.end(),
                     [&](std::size_t a, std::size_t b) { return units[a].cost > units[b].cost; });
    std::vector<double> load(static_cast<std::size_t>(shard.count));
    std::vector<std::size_t> mine;
    for (const std::size_t unit : dearest_first) {
        const auto least = std::min_element(load.begin(), load.end());
        *least += units[unit].cost;
        if (least - load.begin() == shard.number - 1)
            mine.push_back(unit);
    }
    std::sort(mine.begin(), mine.end());
    std::vector<BakeUnit> dealt;
    for (const std::size_t unit : mine)
        dealt.push_back(units[unit]);
    return dealt;
}

} // namespace overt
