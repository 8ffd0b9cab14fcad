/// Writes a session down while it runs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiment/ports/observer_field.h"
#include "experiment/ports/recorded_answer.h"
#include "experiment/ports/recorded_consent.h"
#include "experiment/ports/session_log.h"
#include "experiment/ports/trial_outcome.h"
#include "experiment/record/recorded_box.h"
#include "experiment/record/resumption.h"
#include "experiment/record/session_header.h"

namespace overt {

/// Rows that could not be kept: the ring was full, or writing had failed.
struct LostRows {
    std::int64_t flips = 0; ///< and missed refreshes
    std::int64_t samples = 0;

    LostRows& operator+=(const LostRows& more) {
        flips += more.flips;
        samples += more.samples;
        return *this;
    }
};

/// The session file's writer. A thread of its own does all that touches the disk: it empties a ring of rows
/// several times a second, one transaction each time, so that killing the program loses 250 ms at most; the
/// end of a trial also survives the machine's loss of power. Flushes of the disk fall between trials and
/// never into an animation.
///
/// All calls from one thread, the session's. An error of writing is kept and thrown by the next call that may
/// throw, and again by each further one: the session cannot go on, and what was committed stays readable.
class SessionStore final : public SessionLog {
  public:
    struct Options {
        /// A full ring: wait for the writer (right where time is virtual), or count the row as lost.
        bool wait_when_full = false;
        /// Rows that the ring holds: 65,536 last half a minute at 2000 samples a second.
        std::size_t ring_capacity = 65536;
        /// Wall clock at the beginning of this sitting, ISO 8601.
        std::string started_utc;
        std::string program_version = {}, program_sha256 = {}; ///< of the program that runs this sitting
        std::optional<Resumption> resumption = {};             ///< of an interrupted session
        std::optional<SittingDetection> detection = {}; ///< of fixations, saccades and blinks; nothing: none
        std::vector<RecordedOption> options = {};       ///< of the command, see Sitting
    };

    /// Opens a published session's file and begins a sitting: the first, or one that resumes the session. A
    /// file of an earlier version becomes one of this (schema_migration.h). Throws RecordError if it is no
    /// session file or one of a newer version, cannot be written to, or is being written by another program.
    SessionStore(const std::filesystem::path& session_file, const Options& options);

    /// As close(), without complaint.
    ~SessionStore() override;

    void flip(const FlipRecord& flip) noexcept override;
    void slot_flip(const SlotFlip& flip) noexcept override;
    void steered_flip(const SteeredFlip& flip) noexcept override;
    void missed(const MissedRefresh& refresh) noexcept override;
    void sample(int trial, const GazeSample& sample) noexcept override;
    void tracker_item(int trial, const TrackerItem& item) noexcept override;
    void clock_pair(const ClockPair& pair) noexcept override;
    void event(const SessionEvent& event) override;
    void calibration(const RecordedCalibration& calibration) override;
    void buttons(const std::vector<RecordedButton>& buttons) override;
    void key_presses(const std::vector<RecordedKeyPress>& presses) override;
    void gaze_came(const GazeYield& gaze) override;
    void markers(const std::vector<RecordedMarker>& markers) override;
    void consent(const RecordedConsent& consent) override;
    void answer_recorded(const RecordedAnswer& answer) override;
    void observer_fields(const std::vector<RecordedObserverField>& fields) override;
    void trial_started(const Trial& trial, SessionTime at) override;
    void trial_finished(const Trial& trial, const TrialOutcome& outcome) override;

    /// Notes a map made while the session runs, replacing one of the same object and pose.
    void map_made(const RecordedMap& map);

    /// Notes which display box this sitting has, or why none; replaces what was noted before.
    void display_box(const RecordedBox& box);

    /// Adds readings of the display box's clock and the session's. Readings of one sitting must come from one
    /// run of the box's clock.
    void box_clock(const std::vector<BoxClockPair>& readings);

    /// Since the store was opened. After a failure of writing, rows count as the writer comes to them: all of
    /// them do once close() has returned or thrown.
    LostRows lost() const noexcept;

    /// Writes all that is left, syncs it and folds the file into one that needs no companions. Throws
    /// RecordError if not everything is on disk. Nothing may be written afterwards.
    void close();

  private:
    class Writer;
    std::unique_ptr<Writer> writer_; ///< null once closed
    LostRows lost_in_all_;           ///< once closed
};

} // namespace overt
