/// What gaze does with areas: visits, dwell, first arrival, and the ways from one to another. It does not
/// matter what the areas are of.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace overt {

/// A fixation, and the areas that it is in.
struct AreaLook {
    double onset_s = 0.0, duration_s = 0.0;
    std::vector<std::size_t> areas; ///< each once, in rising order
};

/// Of one area.
struct AreaVisits {
    int fixations = 0;
    int visits = 0;        ///< runs of fixations in the area, one after the other
    double dwell_s = 0.0;  ///< time of these fixations
    double visits_s = 0.0; ///< from the begin of the first to the end of the last fixation of each visit
    std::optional<double> first_arrival_s; ///< onset of the first fixation in it; nothing: none is
    std::optional<double> first_visit_s;   ///< time of the fixations of the first visit
};

/// By area. `looks` in the order of their onsets; indices of areas are below `areas`.
std::vector<AreaVisits> area_visits(std::span<const AreaLook> looks, std::size_t areas);

/// How often gaze went from one area straight to another: of two successive fixations the first is in `from`
/// and not in `to`, the second in `to` and not in `from`. By from * areas + to; 0 from an area to itself.
std::vector<int> area_transitions(std::span<const AreaLook> looks, std::size_t areas);

} // namespace overt
