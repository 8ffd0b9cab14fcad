#include "experiment/record/sample_join.h"

namespace overt {

SampleJoin::SampleJoin(const SessionRecord& record, const TrialRecord& trial, const SurfaceLookup* lookup)
    : screen_(record.header().display.screen), clock_map_(record.clock_map(trial.sitting)),
      flip_history_(record.flip_history(trial)), lookup_(lookup) {}

JoinedSample SampleJoin::join(const GazeSample& sample) const {
    JoinedSample joined;
    if (clock_map_)
        joined.at = clock_map_->to_session(sample.sampled_at);
    if (!sample.gaze)
        return joined;
    joined.image_px = screen_.image_from_screen(*sample.gaze);
    if (!joined.at)
        return joined;
    joined.shown = flip_history_.frame_shown_at(joined.at->time, sample.gaze->y_px);
    joined.off_plan = flip_history_.is_off_plan(joined.at->time, sample.gaze->y_px);
    if (lookup_ && joined.shown && screen_.is_inside_image(*joined.image_px))
        joined.surface = lookup_->surface_at(joined.shown->pose, *joined.image_px);
    return joined;
}

} // namespace overt
