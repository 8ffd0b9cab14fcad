/// A trial's fixations on the surface, found while its samples pass by: memory does not grow with the trial.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "experiment/study/fixations/surface_fixations.h"

namespace overt {

/// Of both eyes; each fixation has the samples of its own.
class PassingFixations {
  public:
    /// `context` with everything but samples; what it refers to, and `events`, must outlive this. Those of
    /// the events that are no fixations have no place. A fixation that names no eye is of `unnamed`. `reach`:
    /// see placed_sample().
    PassingFixations(const FixationContext& context, std::span<const GazeEvent> events, Eye unnamed,
                     Degrees reach);

    /// From now on this eye's gaze is looked up here, where it had a picture of its own.
    void look_up(Eye eye, const SurfaceLookup* lookup) {
        eyes_[static_cast<std::size_t>(eye)].lookup = lookup;
    }

    /// What take() is to be given. May be called from any thread.
    PlacedSample place(const GazeSample& sample, const JoinedSample& joined) const;

    /// In the order of time.
    void take(Eye eye, const PlacedSample& sample);

    /// After the last sample: by event, as surface_fixation() finds it.
    std::vector<std::optional<StudyFixation>> finish();

  private:
    struct OfEye {
        const SurfaceLookup* lookup = nullptr;
        std::vector<std::size_t> events;   ///< indices of its fixations, by begin
        std::size_t next = 0;              ///< of these: the first that is not settled
        std::vector<PlacedSample> samples; ///< from its begin on
    };
    void settle(OfEye& eye);

    FixationContext context_;
    std::span<const GazeEvent> events_;
    Degrees reach_;
    std::array<OfEye, 2> eyes_;
    std::vector<std::optional<StudyFixation>> found_; ///< by event
};

} // namespace overt
