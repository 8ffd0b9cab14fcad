/// What probes and gauges look like: the marks at places of the surface, from the protocol's sizes and
/// lights.
#pragma once

#include "experiment/ports/probe_view.h"
#include "experiment/ports/stimulus_mark.h"
#include "experiment/protocol/point_settings.h"

namespace overt {

/// The mark of a probe about the place 0, 0 of the screen; without lines where the protocol has no mark.
StimulusMark probe_mark(const ProbeSettings& probe, double px_per_deg);

/// A mark about 0, 0, moved to a place. Allocates and throws nothing.
StimulusMark moved_to(const StimulusMark& mark, ScreenPoint at) noexcept;

/// A gauge as it is seen: its circle, which lies on the surface if it is set right, and its rod along the
/// normal, in the camera's perspective. `radius_px`: of the circle where it faces the eye; the rod is as
/// long. White, with a rim of 1 px, until it is given others.
/// `of_other_eye`: as that one has it, where the two have pictures of their own.
StimulusMark gauge_mark(const ProbeView& view, const SeenProbe& at, const Attitude& attitude,
                        double radius_px, double line_px, bool of_other_eye = false);

} // namespace overt
