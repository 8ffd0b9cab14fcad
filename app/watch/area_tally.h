/// How often gaze met each area of an object that is watched.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiment/scene/areas.h"

namespace overt {

/// Sums by part, of all that was added and of the newest trial. For one thread.
class AreaTally {
  public:
    explicit AreaTally(std::span<const std::string> part_names)
        : areas_(part_names), of_all_(part_names.size(), 0.0), of_trial_(part_names.size(), 0.0) {}

    /// Gaze rested on the part for a while, in a trial.
    void add(int trial, PartIndex part, double seconds);

    struct Share {
        std::string area;
        double share = 0.0; ///< of all gaze on the object; 0 without any. Areas that overlap both have it
    };
    std::vector<Share> shares(bool of_newest_trial) const;

  private:
    Areas areas_;
    std::vector<double> of_all_, of_trial_; ///< by PartIndex
    int trial_ = -1;
};

/// "rim 20 %, base 30 %"; empty without areas.
std::string words_of(std::span<const AreaTally::Share> shares);

} // namespace overt
