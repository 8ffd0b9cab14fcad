#include "experiment/session/recorded_turning.h"

#include <algorithm>

#include "experiment/design/recorded_trials.h"

namespace overt {

void RecordedTurning::begin_trial(const Protocol& protocol, const Trial& trial) {
    protocol_ = &protocol;
    trial_ = trial;
    yoked_.clear();
    for (std::size_t i = 0; i < trial.shown_count(); ++i)
        if (protocol.motion_of(trial.shown(i).stimulus).kind == MotionKind::recorded)
            yoked_.push_back({.place = static_cast<int>(i)});
}

void RecordedTurning::begin_show(const std::vector<int>& places) {
    for (Yoked& yoked : yoked_) {
        yoked.is_moving = std::ranges::find(places, yoked.place) != places.end();
        if (yoked.is_moving)
            yoked.course =
                course_of(*protocol_, trial_, static_cast<std::size_t>(yoked.place), yoked.shows++);
    }
}

std::optional<AnimationFrameIndex> RecordedTurning::frame_of(int place, int refresh) const noexcept {
    const auto yoked = std::ranges::find(yoked_, place, &Yoked::place);
    if (yoked == yoked_.end() || !yoked->is_moving)
        return std::nullopt;
    return yoked->course ? yoked->course->frame_at(refresh, protocol_->display.refresh_hz)
                         : AnimationFrameIndex{0};
}

} // namespace overt
