/// Marks of probes and gauges in pictures of a recorded trial.
#pragma once

#include <optional>
#include <vector>

#include "experiment/analysis/flip_history.h"
#include "experiment/maps/coordinate_maps.h"
#include "experiment/ports/stimulus_mark.h"
#include "experiment/protocol/protocol.h"
#include "experiment/record/read/session_record.h"
#include "render/image/linear_image.h"

namespace overt {

/// Draws a mark into a picture of linear light, as it is drawn over what is shown: pixels that lie no farther
/// than half a width from its lines get its light, the rims below all lines; none is blended. Places of the
/// mark are of the picture.
void draw_mark(LinearImage& picture, const StimulusMark& mark);

/// Of one presentation, by its record alone: the places that the session has written down, seen through its
/// maps, and the sizes and lights of the recorded protocol.
class PictureMarks {
  public:
    /// `seen` as TrialRecord::seen_in gives it; `surface`: the maps of what it shows, or null. Both outlive
    /// this. Without probes there is nothing to draw, and the protocol is not read. Throws InputError for a
    /// recorded protocol that this version cannot read.
    PictureMarks(const SessionRecord& record, const TrialRecord& seen, const SurfaceLookup* surface);

    /// All that a frame has at such a refresh: the marks of the step that lit it whose places are seen in it,
    /// and a gauge with the last input before it. Into a picture of the slot's image.
    void draw_lit(LinearImage& picture, const LitFrame& lit) const;

    /// Those of the first step that has any, in this frame, and gauges as they were set in the end.
    void draw_set(LinearImage& picture, AnimationFrameIndex frame) const;

  private:
    struct Placed {
        const ProbeSettings* settings = nullptr;
        const ShownProbe* shown = nullptr;
        glm::dvec3 position{0.0}; ///< on the object
    };
    /// What is drawn in a step: gauges as they stood at a time; nothing: in the end.
    void draw(LinearImage& picture, AnimationFrameIndex frame, int step, std::optional<SessionTime> at) const;
    void draw_gauges(LinearImage& picture, const Placed& probe, const glm::dvec3& seen,
                     std::optional<SessionTime> at) const;
    bool is_visible(PoseIndex pose, const glm::dvec3& seen) const;

    const SessionRecord* record_;
    const TrialRecord* seen_;
    const CoordinateMaps* maps_ = nullptr;
    std::optional<Protocol> protocol_;
    std::vector<Placed> probes_;
    std::vector<FlipRecord> flips_;
};

} // namespace overt
