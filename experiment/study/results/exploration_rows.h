/// How observers turned objects.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiment/statistics/estimate.h"

namespace overt {

/// One show of an object that the observer turned, in a trial that gives results.
struct ExplorationRow {
    std::string observer;
    int session = 0; ///< index into StudyResults::sessions
    int trial = 0;   ///< from 1, in the observer's order
    int step = 0;    ///< as ObserverTurns has it
    /// By column: the task, and of each list of which there are several the entry that was turned.
    std::vector<std::pair<std::string, std::string>> levels;
    double seconds = 0.0;   ///< how long it was shown
    double turning_s = 0.0; ///< how long of that it turned
    double path_deg = 0.0, net_deg = 0.0;
    int reversals = 0, poses = 0;
};

/// Means over observers of their own means over shows.
struct ExplorationSummaryRow {
    std::string observer;      ///< empty: over all observers
    std::string column, level; ///< empty: all shows
    int shows = 0, observers = 0;
    Estimate path_deg, turned_share, speed_deg_s, reversals, poses;
};

struct StudyExplorations {
    std::vector<ExplorationRow> shows;
    std::vector<ExplorationSummaryRow> summaries;
};

} // namespace overt
