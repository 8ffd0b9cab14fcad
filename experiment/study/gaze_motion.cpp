#include "experiment/study/gaze_motion.h"

namespace overt {

namespace {

/// Mean square way of the point on the screen in a fixation: a thousandth of a degree is far below what any
/// tracker tells. What is less is the rounding of a point that stands.
constexpr double least_surface_way_deg2 = 1e-6;

/// An observer's sums over fixations, by duration.
struct MotionSums {
    double products = 0.0, squares = 0.0, ways = 0.0, seconds = 0.0;
    // Of fixations about which the tracker's error is known: their own, and those of displaced points.
    double own_products = 0.0, own_squares = 0.0, displaced_products = 0.0, displaced_squares = 0.0;

    void add(const StudyFixation& fixation) {
        products += fixation.duration_s * fixation.gaze_with_surface_deg2;
        squares += fixation.duration_s * fixation.surface_way_deg2;
        ways += fixation.duration_s * fixation.surface_deg_s;
        seconds += fixation.duration_s;
        if (const auto& displaced = fixation.displaced_motion) {
            own_products += fixation.duration_s * fixation.gaze_with_surface_deg2;
            own_squares += fixation.duration_s * fixation.surface_way_deg2;
            displaced_products += fixation.duration_s * displaced->gaze_with_surface_deg2;
            displaced_squares += fixation.duration_s * displaced->surface_way_deg2;
        }
    }

    /// Extrapolated from once and twice the tracker's error to none of it.
    std::optional<double> corrected_gain() const {
        const double with = 2.0 * own_products - displaced_products,
                     way = 2.0 * own_squares - displaced_squares;
        return own_squares > 0.0 && way > least_way_left * own_squares ? std::optional(with / way)
                                                                       : std::nullopt;
    }
};

GazeMotionRow motion_of(const StudyResults& results, const StudyGroup& group, const StudyOptions& options) {
    GazeMotionRow row;
    row.keys = group.keys;
    std::vector<double> gains, corrected, speeds;
    for (const auto& [observer, trials] : by_observer(results, group.trials)) {
        MotionSums sums;
        for (const int trial : trials) {
            for_each_counted(results, trial, [&](const StudyFixation& fixation) {
                if (!sees_surface_move(fixation))
                    return;
                sums.add(fixation);
                ++row.fixations;
            });
        }
        if (!(sums.squares > 0.0))
            continue;
        gains.push_back(sums.products / sums.squares);
        speeds.push_back(sums.ways / sums.seconds);
        if (const std::optional<double> gain = sums.corrected_gain())
            corrected.push_back(*gain);
    }
    row.observers = static_cast<int>(gains.size());
    const std::string absent = "no counted fixation saw the surface move";
    row.surface_gain = estimated_mean(gains, options.bootstrap(), absent);
    row.corrected_gain = estimated_mean(
        corrected, options.bootstrap(),
        gains.empty() ? absent : "the tracker's error is not known, or as large as the surface's way");
    row.surface_speed_deg_s = estimated_mean(speeds, options.bootstrap(), absent, from_zero_on);
    return row;
}

} // namespace

bool sees_surface_move(const StudyFixation& fixation) {
    return fixation.surface_way_deg2 > least_surface_way_deg2;
}

std::vector<GazeMotionRow> gaze_motions(const StudyResults& results, const LevelLists& levels,
                                        const StudyOptions& options) {
    std::vector<GazeMotionRow> rows;
    for (const StudyGroup& group : all_and_levels(results, options.by, levels))
        rows.push_back(motion_of(results, group, options));
    return rows;
}

} // namespace overt
