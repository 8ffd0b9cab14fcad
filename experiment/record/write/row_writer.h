/// The session file as the writer's thread sees it: rows in, transactions out.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <SQLiteCpp/SQLiteCpp.h>

#include "experiment/record/resumption.h"
#include "experiment/record/seal_chain.h"
#include "experiment/record/session_lock.h"
#include "experiment/record/write/row_kinds.h"
#include "experiment/record/write/sitting_events.h"

namespace overt {

/// Inserts the rows of one sitting. One thread. All but the constructor throw SQLite::Exception; the caller
/// then rolls back and writes no more.
class RowWriter {
  public:
    /// Opens the file, locks it and notes a new sitting. A session of an earlier version is brought to this
    /// one; an attempt that was running when the program was killed is noted as interrupted. Throws
    /// RecordError.
    RowWriter(const std::filesystem::path& session_file, const Sitting& sitting);

    // The transaction begins by itself with the first row.
    void write(const FlipRecord& flip);
    void write(const SlotFlip& flip);
    void write(const SteeredFlip& flip);
    void write(const MissedRefresh& refresh);
    void write(const SampleRow& row);
    void write(const TrackerItemRow& row);
    void write(const std::vector<RecordedButton>& buttons);
    void write(const std::vector<RecordedMarker>& markers);
    void write(const std::vector<RecordedKeyPress>& presses);
    void write(const GazeYield& gaze);
    void write(const RecordedCalibration& calibration);
    void write(const ClockPair& pair);
    void write(const EventRow& event);
    void write(const RecordedMap& map);
    void write(const RecordedBox& box);
    void write(const std::vector<BoxClockPair>& readings);
    void write(const RecordedConsent& consent);
    void write(const RecordedAnswer& answer);
    void write(const std::vector<RecordedObserverField>& fields);
    void write(const TrialStart& start);

    /// Commits what is open, then the outcome and the seal over the trial's rows in a transaction of their
    /// own that is on the disk, with everything before it, when this returns.
    void write(const TrialFinish& finish);

    /// Ends the open transaction, if there is one, without waiting for the disk.
    void commit();
    void roll_back() noexcept;

    /// Moves the write-ahead log's pages to the file and empties the log, so that a log only ever grows: what
    /// does not fit in it is damage, and no remnant. The next transaction notes the file's hash
    /// (file_hash.h). A failure does no harm: the log stays the truth.
    void checkpoint() noexcept;

    /// Commits, syncs, notes that the sitting ended in order, and leaves one file without a log.
    void close();

  private:
    void note_refreshes_of_presentations();
    void write_answers(const TrialOutcome& outcome);
    void write_matches(const TrialOutcome& outcome);
    /// Of what happened in a trial: the attempt that is running or ended last; nothing outside of trials.
    std::optional<std::int64_t> attempt_of(int trial) const;
    /// The attempt at a trial that was under way at that time. What became of a marker is known a while
    /// after, when the next trial may have begun.
    std::optional<std::int64_t> attempt_at(int trial, SessionTime at) const;
    struct Counts {
        std::int64_t trial_id = 0;
        std::int64_t flips = 0;
        std::int64_t samples = 0;
    };
    void begin();
    /// For rows of tables that may be replaced: the transaction will end with a seal over them.
    void begin_sealed() {
        begin();
        needs_seal_ = true;
    }
    void begin_sitting(const Sitting& sitting);
    void write_options(const std::vector<RecordedOption>& options);
    void commit_to_disk();
    Counts& counts_of(int trial) {
        return trial >= 0 && trial == open_trial_ ? trial_counts_ : outside_counts_;
    }
    Counts counts_so_far(std::int64_t trial_id);

    SessionLock lock_;
    SQLite::Database database_;
    SQLite::Statement insert_flip_, insert_slot_flip_, insert_steered_flip_, insert_missed_, insert_sample_, insert_clock_pair_,
        insert_event_, insert_map_, insert_trial_, finish_trial_;
    int sitting_ = 0;
    int open_trial_ = -1; ///< index of the trial whose rows come in
    Counts trial_counts_;
    struct StartedAttempt {
        int trial = 0;
        SessionTime at;
        std::int64_t trial_id = 0;
    };
    std::vector<StartedAttempt> attempts_; ///< of this sitting, in their order
    Counts outside_counts_;                ///< of rows that belong to no started trial: trial_id 0
    SealWriter seals_;
    GazeRows gaze_rows_;                  ///< all but samples
    std::optional<SittingEvents> events_; ///< nothing: nobody looks for them
    bool in_transaction_ = false;
    bool needs_seal_ = false;
    ContentHash file_hash_; ///< to be noted by the next transaction; empty: none
};

} // namespace overt
