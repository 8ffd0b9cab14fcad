#include "experiment/statistics/area_visits.h"

#include <algorithm>

namespace overt {

namespace {

bool is_in(const AreaLook& look, std::size_t area) { return std::ranges::binary_search(look.areas, area); }

} // namespace

std::vector<AreaVisits> area_visits(std::span<const AreaLook> looks, std::size_t areas) {
    std::vector<AreaVisits> all(areas);
    for (std::size_t area = 0; area < areas; ++area) {
        AreaVisits& of = all[area];
        double visit_began_s = 0.0;
        for (std::size_t i = 0; i < looks.size(); ++i) {
            const AreaLook& look = looks[i];
            if (!is_in(look, area))
                continue;
            if (i == 0 || !is_in(looks[i - 1], area)) {
                ++of.visits;
                visit_began_s = look.onset_s;
            }
            ++of.fixations;
            of.dwell_s += look.duration_s;
            if (!of.first_arrival_s)
                of.first_arrival_s = look.onset_s;
            if (of.visits == 1)
                of.first_visit_s = of.first_visit_s.value_or(0.0) + look.duration_s;
            if (i + 1 == looks.size() || !is_in(looks[i + 1], area))
                of.visits_s += look.onset_s + look.duration_s - visit_began_s;
        }
    }
    return all;
}

std::vector<int> area_transitions(std::span<const AreaLook> looks, std::size_t areas) {
    std::vector<int> counts(areas * areas, 0);
    for (std::size_t i = 1; i < looks.size(); ++i) {
        for (const std::size_t from : looks[i - 1].areas) {
            for (const std::size_t to : looks[i].areas) {
                if (!is_in(looks[i - 1], to) && !is_in(looks[i], from))
                    ++counts[from * areas + to];
            }
        }
    }
    return counts;
}

} // namespace overt
