/// How observers of earlier sessions turned objects, for motions of kind "recorded".
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/animation.h"
#include "experiment/stimulus_lists.h"

namespace overt {

/// The poses of an object over one show of an earlier session.
struct RecordedCourse {
    std::string whose; ///< observer and session: "P01 session 2"
    int trial = 1;     ///< from 1
    std::string slot;
    /// Ids by row of stimulus_lists; empty: the table does not say.
    std::array<std::string, stimulus_lists.size()> stimulus;
    /// From a time since the show's onset on, which frame of the motion.
    struct Turn {
        double t_s = 0.0;
        AnimationFrameIndex frame;
    };
    std::vector<Turn> turns; ///< the first at 0, times rising, and at least one
    double lasts_s = 0.0;

    /// "P01 session 2 trial 3": of all shows of that trial the same.
    std::string name() const;

    /// At a refresh since the show's onset, from 0: the pose that stood at that time; after its end the last.
    /// Allocates and throws nothing.
    AnimationFrameIndex frame_at(int refresh, double refresh_hz) const noexcept;
};

/// Whose courses there are, each once, in their order.
std::vector<std::string_view> whose_courses(const std::vector<RecordedCourse>& courses);

} // namespace overt
