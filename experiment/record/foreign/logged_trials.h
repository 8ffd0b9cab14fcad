/// What another presenter wrote down of its trials: when each was shown, what, and what was answered.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiment/record/foreign/foreign_gaze.h"

namespace overt {

/// The log's own time, in nanoseconds since its zero.
using LogTime = std::chrono::nanoseconds;

struct LoggedTrial {
    std::string place; ///< "FILE:LINE"
    LogTime onset{};
    std::optional<LogTime> end; ///< nothing: as long as the protocol says
    std::string key;            ///< by which other rows and a log of frames name it; may be empty
    std::map<std::string, std::string>
        words;                   ///< by factor ("material", "right.material", "stimulus"): what was shown
    std::string answer, correct; ///< empty: none
    std::optional<LogTime> response_time; ///< from the onset
};

/// A marker that was sent at a time of the log.
struct LoggedMarker {
    std::string place, text;
    LogTime at{};
};

struct TrialLog {
    std::vector<LoggedTrial> trials; ///< in the order of their onsets
    std::vector<LoggedMarker> markers;
    /// The log's clock is the tracker's less this; nothing: its own, or that of the gaze.
    std::optional<TrackerTime> zero;
    std::string program;                   ///< that wrote it, if that is known
    LogTime tick{1000};                    ///< half of it is how far a written time may be off
    std::vector<std::string> remarks = {}; ///< whole sentences
};

/// Names of columns of a log of trials; empty: there is none.
struct TrialColumns {
    std::string program;
    std::string onset, end, duration;
    std::string unit; ///< "s", "ms", "us" or "ns"
    std::string marker,
        marker_time;         ///< text and time of the marker that was sent; without a time: at the onset
    std::string marker_text; ///< of a marker that is the same for all trials, in place of a column
    std::string answer, response_time, correct, key;
    std::string only_column, only_word;       ///< rows of trials; others of the same key may hold the answer
    std::map<std::string, std::string> words; ///< column by factor
    /// Times count from the first sample, or so many seconds before it as GazeColumns::start_s says.
    bool from_first_sample = false;
};

/// Nanoseconds in a unit of time: "s", "ms", "us", "ns", or empty for seconds. Throws InputError that names
/// `option`.
double ns_of_unit(const std::string& unit, std::string_view option);

/// What `--trial-columns` says: onset, end, duration, unit, marker, marker_text, marker_time, answer,
/// response_time, correct, key, only (COLUMN:WORD), and any other key names a factor. Throws InputError.
TrialColumns trial_columns_of(const std::vector<std::string>& words);

/// By the names of the columns: of BIDS events (those of overt's own export with the tracker's time),
/// PsychoPy and OpenSesame. Throws InputError with the remedy where nobody can tell which column has the
/// onset. `given` is laid over it.
TrialColumns known_trial_columns(const std::filesystem::path& file, const TrialColumns& given);

/// Reads the log. `factors`: names of factors; columns that are called so, or SLOT.FACTOR, are read without
/// being named. Throws InputError at FILE:LINE.
TrialLog read_trial_log(const std::filesystem::path& file, const TrialColumns& columns,
                        const std::vector<std::string>& factors, const std::optional<GazeSurvey>& gaze);

/// Trials by the column of the gaze table itself that names what was shown, in the tracker's own time. Throws
/// InputError if there are none.
TrialLog trials_in_gaze(const GazeSurvey& gaze, const std::filesystem::path& file);

/// A row of a log of frames: from then on this frame, or pose, was lit.
struct LoggedFrame {
    std::string place, key;
    LogTime at{};
    std::optional<int> frame; ///< from 0
    std::optional<double> angle_deg;
};

/// What `--frame-columns` says: time, unit, frame or angle, key. Throws InputError.
std::vector<LoggedFrame> read_frame_log(const std::filesystem::path& file,
                                        const std::vector<std::string>& words);

} // namespace overt
