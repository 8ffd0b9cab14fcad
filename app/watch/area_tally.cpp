#include "app/watch/area_tally.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace overt {

void AreaTally::add(int trial, PartIndex part, double seconds) {
    if (trial != trial_) {
        std::ranges::fill(of_trial_, 0.0);
        trial_ = trial;
    }
    of_all_[part] += seconds;
    of_trial_[part] += seconds;
}

std::vector<AreaTally::Share> AreaTally::shares(bool of_newest_trial) const {
    const std::vector<double>& seconds = of_newest_trial ? of_trial_ : of_all_;
    const double all = std::accumulate(seconds.begin(), seconds.end(), 0.0);
    std::vector<Share> found;
    for (std::size_t area = 0; area < areas_.size(); ++area) {
        double own = 0.0;
        for (std::size_t part = 0; part < seconds.size(); ++part)
            own += areas_.holds(area, static_cast<PartIndex>(part)) ? seconds[part] : 0.0;
        found.push_back({areas_.names()[area], all > 0.0 ? own / all : 0.0});
    }
    return found;
}

std::string words_of(std::span<const AreaTally::Share> shares) {
    std::string words;
    for (const AreaTally::Share& share : shares)
        words += fmt::format("{}{} {:.0f} %", words.empty() ? "" : ", ", share.area, 100.0 * share.share);
    return words;
}

} // namespace overt
