/// Recordings with events that somebody else found: the tracker itself, or people who labelled samples.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiment/events/event_thresholds.h"
#include "experiment/events/gaze_angles.h"
#include "experiment/gaze_event.h"

namespace overt {

/// One eye's samples, and what was found in them.
struct ReferenceRecording {
    GazeAngles angles;
    std::vector<GazeSample> samples;
    std::vector<GazeEvent> events; ///< the reference's, in order of their begins
    std::vector<GazeEvent> found;  ///< the program's, the same
    std::vector<int> labels;       ///< a person's, by sample; empty for a tracker's
};

/// What a person labels the swing of the lens after a saccade with.
inline constexpr int swing_label = 3;

/// A file's eyes by one reference.
struct ReferenceGaze {
    std::string name; ///< of the file, and of the person
    std::vector<ReferenceRecording> recordings;
    EventSettings settings; ///< by which the program found them
};

/// Of an ASC file with the tracker's own fixations and saccades: it is imported as `overt import` does, into
/// a folder that is removed again, and the program's are found in that session as for an export. Throws
/// InputError if it cannot be read, has no events, or says nothing of angles.
ReferenceGaze read_asc_reference(const std::filesystem::path& file, const ChosenThresholds& thresholds);

/// Of a table whose samples people labelled: a line "# sampFreq=Hz viewDist_m=m screenW_m=m screenH_m=m
/// resX=px resY=px …", a line of column names (sample, t_ms, x_px, y_px, then one column for each person),
/// and the samples; 0, 0 is a lost one. Labels: 1 fixation, 2 saccade, 3 swing after a saccade, 4 pursuit, 5
/// blink, 6 undefined. Pursuit is taken for fixation, as the detector does. Throws InputError.
std::vector<ReferenceGaze> read_labelled_reference(const std::filesystem::path& file,
                                                   const ChosenThresholds& thresholds);
/// Whether the file begins as such a table does.
bool is_labelled_table(const std::filesystem::path& file);

/// Of samples of one eye whose events are known: the program's are found as in a recording.
ReferenceGaze reference_gaze(std::string name, const GazeAngles& angles, std::vector<GazeSample> samples,
                             std::vector<GazeEvent> events, const ChosenThresholds& thresholds);

} // namespace overt
