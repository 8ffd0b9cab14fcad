/// Room that a session's record takes on the disk, told before anything is drawn or recorded.
#pragma once

#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "experiment/protocol/protocol.h"
#include "experiment/stimulus/object.h"

namespace overt {

/// In bytes, of one session.
struct RecordingSize {
    double rows = 0.0;     ///< session.sqlite: gaze samples and flips, and the log of the trial in progress
    double maps = 0.0;     ///< one of each object in each pose
    double meshes = 0.0;   ///< copies of all
    double pictures = 0.0; ///< of each stimulus: one, and its light in each pose
    double answers = 0.0;  ///< spoken ones, where the protocol records them
    double total() const { return rows + maps + meshes + pictures + answers; }
};

/// Of so many trials with answers of `answer_s`, which the protocol's limits shorten or lengthen. What a
/// compressed picture takes is not known before it is drawn: half a byte for each pixel, or square of its
/// light, is assumed.
RecordingSize recording_size(const Protocol& protocol, std::span<const Object> objects, int trials,
                             double answer_s);

/// "93 MB: gaze and flips 22 MB, maps 33 MB, …"
std::string to_text(const RecordingSize& size);

nlohmann::ordered_json to_json(const RecordingSize& size);

} // namespace overt
