/// Objects that turn as observers of earlier sessions turned them: the frame of each refresh.
#pragma once

#include <optional>
#include <vector>

#include "experiment/protocol/protocol.h"
#include "experiment/trial.h"

namespace overt {

/// Of one attempt at a trial. One thread; frame_of() allocates and throws nothing.
class RecordedTurning {
  public:
    /// The protocol must outlive the trial, whose level `yoked_to` says what it shows again. Where it has
    /// none the object stands in the motion's first frame.
    void begin_trial(const Protocol& protocol, const Trial& trial);

    /// A show begins in which these places move. What is shown further in the trial goes on with what was
    /// recorded of the next show.
    void begin_show(const std::vector<int>& places);

    /// At a refresh of the show's plan, from 0. Nothing: the place has another motion, or does not move in
    /// this show.
    std::optional<AnimationFrameIndex> frame_of(int place, int refresh) const noexcept;

  private:
    struct Yoked {
        int place = 0;
        int shows = 0;
        bool is_moving = false;
        const RecordedCourse* course = nullptr;
    };
    const Protocol* protocol_ = nullptr;
    Trial trial_;
    std::vector<Yoked> yoked_;
};

} // namespace overt
