/// What a sitting is recorded in: the session's folder, its file, and those of further eye trackers.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/session/further_records.h"
#include "app/session/session_equipment.h"

namespace overt {

/// Main thread. Closed by close(); else as a session that was killed.
class SittingRecord {
  public:
    /// Puts a new session's folder together, or takes up that of the plan; writes down the equipment.
    /// `again`: null for a session that is recorded for the first time. All references must outlive this.
    /// Throws InputError for what is not as the session was begun with, and RecordError.
    SittingRecord(const Experiment& experiment, const RunOptions& options, const SessionPlace& place,
                  const SessionPlan& plan, SessionEquipment& equipment, const PresentingAgain* again);

    const std::filesystem::path& folder() const { return folder_.path; }
    const SessionHeader& header() const { return folder_.header; }
    /// The session's own record, and all of them.
    SessionStore& own() { return *store_; }
    SharedLog& shared() { return *shared_; }
    std::vector<FurtherTracker> further_ports() { return further_->ports(); }

    /// After an attempt: the maps that were drawn in it, the faults that struck, and whether the box is as it
    /// was.
    void attempt_ended(const Trial& trial);

    /// The last rows, the trackers' own files and the manifests. False: a manifest is not finished, for
    /// another program has a file open. Throws RecordError.
    bool close();
    /// The trackers' own files alone, of a session that has failed.
    void rescue_tracker_files();
    LostRows lost() const;

  private:
    /// With all that is recorded before the first trial; a resumed session has it already.
    struct Folder {
        std::filesystem::path path;
        SessionHeader header;
        std::string started_utc; ///< of this sitting
    };
    static Folder open_folder(const RunOptions& options, const SessionPlace& place,
                              const Experiment& experiment, const SessionPlan& plan, Rig& rig);
    void open_files(const RunOptions& options, const SessionPlan& plan, const PresentingAgain* again);
    void write_beginning(const RunOptions& options, const SessionPlan& plan, bool is_again);
    RigFacts facts_of_rig();
    RecordedTracker own_tracker();

    const Protocol& protocol_;
    SessionEquipment& equipment_;
    Folder folder_;
    std::optional<SessionStore> store_;
    std::optional<FurtherRecords> further_;
    std::optional<SharedLog> shared_;
};

} // namespace overt
