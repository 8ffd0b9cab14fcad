#include "experiment/study/gaze_motion.h"

namespace overt {

namespace {

/// Mean square way of the point on the screen in a fixation: a thousandth of a degree is far below what any
/// tracker tells. What is less is the rounding of a point that stands.
constexpr double least_surface_way_deg2 = 1e-6;

GazeMotionRow motion_of(const StudyResults& results, const StudyGroup& group, const StudyOptions& options) {
    GazeMotionRow row;
    row.keys = group.keys;
    std::vector<double> gains, speeds;
    for (const auto& [observer, trials] : by_observer(results, group.trials)) {
        double products = 0.0, squares = 0.0, ways = 0.0, seconds = 0.0;
        for (const int trial : trials) {
            for_each_counted(results, trial, [&](const StudyFixation& fixation) {
                if (!(fixation.surface_way_deg2 > least_surface_way_deg2))
                    return;
                products += fixation.duration_s * fixation.gaze_with_surface_deg2;
                squares += fixation.duration_s * fixation.surface_way_deg2;
                ways += fixation.duration_s * fixation.surface_deg_s;
                seconds += fixation.duration_s;
                ++row.fixations;
            });
        }
        if (!(squares > 0.0))
            continue;
        gains.push_back(products / squares);
        speeds.push_back(ways / seconds);
    }
    row.observers = static_cast<int>(gains.size());
    const std::string absent = "no counted fixation saw the surface move";
    row.surface_gain = estimated_mean(gains, options.bootstrap(), absent);
    row.surface_speed_deg_s = estimated_mean(speeds, options.bootstrap(), absent);
    return row;
}

} // namespace

std::vector<GazeMotionRow> gaze_motions(const StudyResults& results, const LevelLists& levels,
                                        const StudyOptions& options) {
    std::vector<GazeMotionRow> rows;
    for (const StudyGroup& group : all_and_levels(results, options.by, levels))
        rows.push_back(motion_of(results, group, options));
    return rows;
}

} // namespace overt
