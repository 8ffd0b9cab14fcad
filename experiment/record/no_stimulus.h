/// What stands in the header of a session whose record knows of no stimulus, such as an imported recording.
#pragma once

#include "experiment/record/session_header.h"

namespace overt {

/// One frame that is shown for no time.
inline const Animation no_animation = [] {
    Animation none;
    none.frame_count = 1;
    none.frame_rate_hz = 30.0;
    none.amplitude = {0.0};
    none.duration_s = 0.0;
    return none;
}();

/// Whether nothing was shown, as far as the session knows: it has neither stimuli nor maps nor meshes.
inline bool knows_no_stimulus(const SessionHeader& header) {
    for (const RecordedObject& object : header.objects)
        if (!object.mesh_file.empty())
            return false;
    return header.stimuli.empty() && header.maps.empty();
}

} // namespace overt
