/// Recordings with events that somebody else found: the tracker itself, or people who labelled samples.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiment/events/gaze_angles.h"
#include "experiment/gaze_event.h"

namespace overt {

/// One eye's samples from one begin of recording to its end.
struct ReferenceRecording {
    GazeAngles angles;
    std::vector<GazeSample> samples;
    std::vector<GazeEvent> events; ///< the reference's, in order
};

/// A file's recordings by one reference.
struct ReferenceGaze {
    std::string name; ///< of the file, and of the person
    std::vector<ReferenceRecording> recordings;
};

/// Of an ASC file with the tracker's own fixations and saccades. Angles are those of the screen that the file
/// describes, else by its own resolution. Throws InputError if it cannot be read, has no events, or says
/// nothing of angles.
ReferenceGaze read_asc_reference(const std::filesystem::path& file);

/// Of a table whose samples people labelled: a line "# sampFreq=Hz viewDist_m=m screenW_m=m screenH_m=m
/// resX=px resY=px …", a line of column names (sample, t_ms, x_px, y_px, then one column for each person),
/// and the samples; 0, 0 is a lost one. Labels: 1 fixation, 2 saccade, 3 swing after a saccade, 4 pursuit, 5
/// blink, 6 undefined. Pursuit is taken for fixation, as the detector does. Throws InputError.
std::vector<ReferenceGaze> read_labelled_reference(const std::filesystem::path& file);
/// Whether the file begins as such a table does.
bool is_labelled_table(const std::filesystem::path& file);

} // namespace overt
