/// Two session files row by row: what was recorded, and what came out when it was presented again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiment/session_time.h"

namespace overt {

/// One value that differs, or one row that only one of the two has.
struct RecordDifference {
    std::string table;
    std::optional<int> trial;   ///< position in the order, from 0; nothing outside of trials
    std::optional<int> attempt; ///< at it, from 1
    std::string row;            ///< by its key, as "n 37"; empty where a table has one row
    std::string column;         ///< empty: the whole row; of a text of several lines with the line
    std::string recorded;       ///< empty: there is no such row
    std::string replayed;       ///< likewise
};

/// In one sentence.
std::string to_text(const RecordDifference& difference);

/// A session that was cut off has less than one that goes on.
struct RecordCut {
    std::int64_t attempt = 0; ///< the last that was recorded (TrialRecord::id); it is not complete
    /// What happened from here on is not compared; nothing: what was recorded of it is.
    std::optional<SessionTime> from = {};
};

struct RecordComparison {
    /// The first of each table, in the order of the session.
    std::vector<RecordDifference> differences;
    std::int64_t rows = 0; ///< that were compared
    std::int64_t flips = 0, samples = 0;
    int attempts = 0;
    std::int64_t unknown_frames = 0; ///< stimuli of whose frames one of the files does not know the pixels
    bool is_same() const { return differences.empty(); }
};

/// Compares all tables but those that follow from others (seals, the file's hash) and that of the options. Of
/// what tells when, on which machine and by which build the rows came about, nothing is compared:
/// see not_compared(). Columns that only one of the two files has are left out, as sessions of other versions
/// have them. Numbers are the same if all their bits are. Throws RecordError if a file cannot be read.
RecordComparison compare_records(const std::filesystem::path& recorded, const std::filesystem::path& replayed,
                                 const std::optional<RecordCut>& cut = {});

/// What compare_records() leaves out, in words, for people.
std::string not_compared();

/// Puts what is left out of the comparison into `replayed` as it was recorded, so that exports of both can be
/// compared byte for byte; with a cut, also takes out what goes beyond it, and what came of the attempt that
/// was cut off. Seals are not kept. Throws RecordError.
void take_circumstances(const std::filesystem::path& recorded, const std::filesystem::path& replayed,
                        const std::optional<RecordCut>& cut = {});

/// Puts what happened in a recorded session, all rows that came about after its header, into a session file
/// that has a header only. `with_frames`: what the header says of the frames, too. Throws RecordError.
void take_what_happened(const std::filesystem::path& recorded, const std::filesystem::path& into,
                        bool with_frames);

} // namespace overt
