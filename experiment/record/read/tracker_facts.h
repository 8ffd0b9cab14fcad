/// What is known of an eye tracker by the name that its driver gives it: who makes it, how it tracks, and
/// what it calls the size of a pupil. Records of all ages have the name.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "experiment/record/read/session_record.h"

namespace overt {

enum class PupilMeasure : std::uint8_t {
    unknown,     ///< the tracker, or the stream that gaze came by, does not say
    area,        ///< in the tracker's own unit
    diameter,    ///< the same
    diameter_mm, ///< in millimetres
    none         ///< there is no pupil: a pointer stands in for the eye
};

struct TrackerFacts {
    std::string_view manufacturer; ///< empty: not known
    std::string_view method; ///< as BIDS has EyeTrackingMethod: "P-CR", or other words; empty: not known
    PupilMeasure pupil = PupilMeasure::unknown;
};

/// By a TrackerDescription's name. Gaze that was played back is of the tracker that measured it, which the
/// model of a "replay" names at its end.
TrackerFacts tracker_facts(const TrackerDescription& tracker);

/// Of a sitting: its gaze may have been imported from another tracker's file.
TrackerFacts tracker_facts(const SessionRecord& record, int sitting);

/// What a column of pupils is called, means, and is counted in.
struct PupilWords {
    std::string column, meaning, unit;
};
PupilWords pupil_words(PupilMeasure pupil);
/// Of a whole session, or of one sitting. Where its trials differ, as those of an imported file may, it is a
/// size, and the meaning says in which trials it is what. Throws RecordError.
PupilWords pupil_words(const SessionRecord& record, std::optional<int> sitting = {});

/// How many targets a calibration had, by RecordedCalibration::method: "tracker, 9 points". Nothing where the
/// tracker does not tell.
std::optional<int> calibration_points(std::string_view method);

} // namespace overt
