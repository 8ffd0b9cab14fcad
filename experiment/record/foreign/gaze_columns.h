/// Which columns of a table hold gaze, and what they mean: all that tells the tables of one program from
/// those of another.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiment/gaze.h"
#include "experiment/record/foreign/foreign_table.h"

namespace overt {

/// Names of columns; empty: there is none.
struct GazeColumns {
    struct OfEye {
        std::string x, y;
        std::string pupil;
        std::string validity;
        bool is_there() const { return !x.empty(); }
    };
    std::string program; ///< that wrote the table, as the record names its tracker
    std::string time;
    std::string time_unit; ///< "s", "ms", "us" or "ns"; empty: found by the spacing of the samples
    /// Of samples, in us: the tracker's own clock, where `time`, which marks share, is coarser. Samples keep
    /// its spacing, and lie on `time` in the mean. Empty: `time` alone.
    std::string fine_time = {};
    OfEye left, right;
    OfEye single; ///< of one eye, or of both as one
    Eye single_eye = Eye::right;
    std::string eye; ///< whose cells say of `single` which eye it is: left or right, L or R, 0 (right) or 1
    std::string unit =
        "px"; ///< of places: "px", "normalised" (0 … 1 of the screen) or "degrees" (from its middle)
    bool y_goes_up = false;
    std::string valid; ///< the word of a valid sample; empty: "valid", "true", or least_validity and more
    double least_validity = 0.5; ///< of validities and confidences that are numbers
    /// Of validities that are codes from 0, the best, up; then `least_validity` says nothing.
    std::optional<double> greatest_validity = {};
    bool zero_is_lost = false; ///< a place of 0, 0 is lost gaze
    std::string mark;          ///< whose cells, where they are not empty, are marks
    std::string mark_value;    ///< of marks whose name alone says little: is put behind it, after a blank
    std::string trial;         ///< whose changes begin trials
    /// Rows of samples have `samples_word` in this column, and rows of messages `messages_word`, whose text
    /// is in their fourth cell.
    std::string kind, samples_word, messages_word;
    std::vector<std::string> names = {};           ///< of a file without a line of names
    std::vector<std::string> remarks = {};         ///< on what was taken for what
    std::filesystem::path other_eye = {};          ///< a further file, of the other eye
    std::vector<std::filesystem::path> marks = {}; ///< further files, of marks
    std::filesystem::path trials = {};             ///< a log of trials that lies beside it
    double start_s = 0.0; ///< of BIDS (StartTime): the first sample's time in that log
    bool is_of_marks_alone() const { return !left.is_there() && !right.is_there() && !single.is_there(); }
};

/// What `--columns` says: time, x, y, pupil, validity, left_x … right_validity, eye, mark, trial, time_unit,
/// unit, valid, least_validity, y_up. Throws InputError.
GazeColumns gaze_columns_of(const std::vector<std::string>& words);

/// The columns of a file by the names that it has: of Tobii Pro Lab and Studio, Gazepoint Analysis, Pupil
/// Player (surfaces and annotations), SMI's IDF Converter, and BIDS (physio, physioevents). Throws
/// InputError, with the remedy, for a file whose program nobody knows, and for places that are not gaze on a
/// screen (Pupil's gaze_positions.csv), unless `takes_any_gaze`.
GazeColumns known_gaze_columns(const std::filesystem::path& file, bool takes_any_gaze);

} // namespace overt
